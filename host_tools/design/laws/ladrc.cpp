// SPDX-License-Identifier: MIT
#include <fmt/format.h>

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
        c.gains[mode]      = {speed_observer_gains(scale * spec.observer_radps, ts),
                              static_cast<float>(scale * spec.controller_radps)};
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

std::string report_rows(const Drive &drive)
{
    return fmt::format("speed loop {:g} rad/s, observer {:g} rad/s\n",
                       drive.cascade.controller_radps, drive.cascade.observer_radps);
}

void turn(Drive &drive, double factor)
{
    drive.cascade.controller_radps *= factor;
    drive.cascade.observer_radps *= factor;
}

std::string knob_text(const Drive &drive)
{
    return fmt::format("controller_radps = {:.4g} observer_radps = {:.4g}",
                       drive.cascade.controller_radps, drive.cascade.observer_radps);
}

} // namespace

const LawDesign ladrc_design = [] {
    LawDesign d{"law_ladrc", "law_ladrc_config_t", is_for, solve, summary, mismatches, layout};
    d.report_rows = report_rows;
    d.noise_knob  = NoiseKnob{"ladrc", turn, knob_text};
    d.rival =
        RivalLaw{"ladrc",
                 false,
                 [](Drive &drive) { drive.law = Law::ladrc; },
                 {{{"current_bandwidth_Hz", &CascadeSpec::current_bandwidth_Hz, start_bandwidth},
                   {"controller_radps", &CascadeSpec::controller_radps, 0.35 * start_1ps},
                   {"observer_radps", &CascadeSpec::observer_radps, 0.9 * start_1ps}}}};
    return d;
}();

} // namespace sdre
