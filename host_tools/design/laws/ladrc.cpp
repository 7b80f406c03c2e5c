// SPDX-License-Identifier: MIT
#include <cmath>

#include "design/foc/foc_design.hpp"
#include "design/laws/cascade.hpp"

namespace sdre {
namespace {

// Chosen by simulation of load steps: less lag than 1 ms, and the observer filters what the shorter mean lets through.
constexpr double window_s = 0.6e-3;

bool is_for(const Drive &drive)
{
    return drive.law == Law::ladrc;
}

void solve(Design &d)
{
    const CascadeSpec &spec = d.drive.cascade;
    const double       ts   = control_period_s(d.drive);
    law_ladrc_config_t c{};
    c.foc                  = foc_constants(d.drive, d.l);
    c.speed                = speed_difference_constants(d.drive, window_s);
    const double fastest_s = small_time_s(d.drive, c.speed, SPEED_DIFFERENCE_TIMED);
    for (const auto mode : {SPEED_DIFFERENCE_COUNTED, SPEED_DIFFERENCE_TIMED}) {
        const double scale = fastest_s / small_time_s(d.drive, c.speed, mode);
        const double beta  = std::exp(-scale * spec.observer_radps * ts);
        c.gains[mode]      = {static_cast<float>(1.0 - beta * beta),
                              static_cast<float>((1.0 - beta) * (1.0 - beta) / ts),
                              static_cast<float>(scale * spec.controller_radps)}; // EQ-LADRC-2
    }
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

Layout layout(const Design &d)
{
    return gains_layout(d.config);
}

} // namespace

const LawDesign ladrc_design = {"law_ladrc", "law_ladrc_config_t", is_for, solve,
                                summary,     mismatches,           layout};

} // namespace sdre
