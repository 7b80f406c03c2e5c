// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "design/foc/foc_design.hpp"
#include "design/laws/cascade.hpp"

namespace sdre {
namespace {

// Chosen: at 300 rad/s of the shipped encoder a count is 0.4 % of the angle turned in it.
constexpr double window_s = 1e-3;
// Chosen: where the symmetrical optimum has no phase left.
constexpr double smallest_a = 1.05;

bool is_for(const Drive &drive)
{
    return drive.law == Law::pi_foc;
}

/// Symmetrical optimum of an integrator with a small lag T_s. The corners of the PI and of the lag
/// are a factor a below and above the crossover 1 / (a T_s). The phase is largest there.
///
///     k_p = 1 / (a T_s),     T_i = a^2 T_s                                  EQ-PI-FOC-4
void solve(Design &d)
{
    const double        a    = d.drive.cascade.symmetrical_optimum_a;
    const double        load = d.drive.cascade.load_observer_radps;
    const double        ts   = control_period_s(d.drive);
    law_pi_foc_config_t c{};
    c.foc                  = foc_constants(d.drive, d.l);
    c.speed                = speed_difference_constants(d.drive, window_s);
    const double fastest_s = small_time_s(d.drive, c.speed, SPEED_DIFFERENCE_TIMED);
    for (const auto mode : {SPEED_DIFFERENCE_COUNTED, SPEED_DIFFERENCE_TIMED}) {
        const double lag_s = small_time_s(d.drive, c.speed, mode);
        c.gains[mode]      = {static_cast<float>(1.0 / (a * lag_s)),
                              static_cast<float>(ts / (a * a * lag_s)),
                              speed_observer_gains(load * fastest_s / lag_s, ts)};
    }
    keep_constants(d, c);
    certify_cascade(d);
}

std::string summary(const Design &d)
{
    return cascade_summary(d, "EQ-FOC-1 to 8, EQ-PI-FOC-1 to 6");
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
    const double load = drive.cascade.load_observer_radps;
    return fmt::format("symmetrical optimum with a = {:g}{}\n", drive.cascade.symmetrical_optimum_a,
                       load > 0.0 ? fmt::format(", load observer {:g} rad/s", load) : "");
}

void turn(Drive &drive, double factor)
{
    double &a = drive.cascade.symmetrical_optimum_a;
    a         = std::max(a / factor, smallest_a);
}

std::string knob_text(const Drive &drive)
{
    return fmt::format("symmetrical_optimum_a = {:.4g}", drive.cascade.symmetrical_optimum_a);
}

} // namespace

const LawDesign pi_foc_design = [] {
    LawDesign d{"law_pi_foc", "law_pi_foc_config_t", is_for, solve, summary, mismatches, layout};
    d.report_rows = report_rows;
    d.noise_knob  = NoiseKnob{"pi_foc", turn, knob_text};

    const RivalKey bandwidth{"current_bandwidth_Hz", &CascadeSpec::current_bandwidth_Hz,
                             start_bandwidth};
    const RivalKey optimum{"symmetrical_optimum_a", &CascadeSpec::symmetrical_optimum_a, 1.2, 1.0,
                           false};
    const RivalKey load{"load_observer_radps", &CascadeSpec::load_observer_radps, 0.3 * start_1ps};
    d.rival = RivalLaw{"pi_foc",
                       true,
                       [](Drive &drive) {
                           drive.law = Law::pi_foc;
                           drive.torque.reset();
                       },
                       {{bandwidth, optimum}, {bandwidth, optimum, load}}};
    return d;
}();

} // namespace sdre
