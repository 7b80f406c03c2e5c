// SPDX-License-Identifier: MIT
#include <cmath>

#include "design/foc/foc_design.hpp"
#include "design/laws/cascade.hpp"

namespace sdre {
namespace {

// Chosen: the observer filters; a longer mean would only come later.
constexpr double window_s = 0.0;

bool is_for(const Drive &drive)
{
    return drive.law == Law::ladrc;
}

void solve(Design &d)
{
    const CascadeSpec &spec = d.drive.cascade;
    const double       ts   = control_period_s(d.drive);
    const double       beta = std::exp(-spec.observer_radps * ts);
    law_ladrc_config_t c{};
    c.foc        = foc_constants(d.drive, d.l);
    c.speed      = speed_difference_constants(d.drive, window_s);
    c.gain_w     = static_cast<float>(1.0 - beta * beta); // EQ-LADRC-2
    c.gain_f_1ps = static_cast<float>((1.0 - beta) * (1.0 - beta) / ts);
    c.w_c_1ps    = static_cast<float>(spec.controller_radps);
    keep_constants(d, c);
    certify_cascade(d);
}

std::string summary(const Design &d)
{
    return cascade_summary(d, "EQ-FOC-1 to 7, EQ-LADRC-1 to 3");
}

std::vector<std::string> mismatches(const Design &)
{
    return {};
}

std::string table(const Design &d)
{
    const auto &c = *constants_of<law_ladrc_config_t>(d.config);
    return cascade_blocks(c.foc, c.speed) + c_field("gain_w", c.gain_w) +
           c_field("gain_f_1ps", c.gain_f_1ps) + c_field("w_c_1ps", c.w_c_1ps);
}

} // namespace

const LawDesign ladrc_design = {"law_ladrc", "law_ladrc_config_t", is_for, solve,
                                summary,     mismatches,           table};

} // namespace sdre
