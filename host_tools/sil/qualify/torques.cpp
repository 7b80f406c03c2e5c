// SPDX-License-Identifier: MIT
#include "sil/qualify/torques.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "design/torque_bound.hpp"
#include "sil/eval/seeds.hpp"
#include "sil/qualify/plan.hpp"
#include "sil/qualify/words.hpp"

namespace sdre {
namespace {

constexpr double tenth = 0.1;
// Chosen: the drives of docs/motors.md stay below two thirds of these. The last tenth of a small step is in the noise of the
// sensors, which costs periods.
constexpr double least_ratio       = 3.0; // of the least time
constexpr double tenth_periods     = 12.0;
constexpr double rated_periods     = 5.0;
constexpr double overshoot_percent = 25.0;
constexpr double error_percent     = 5.0;
constexpr double ripple_percent    = 5.0;
// Chosen: a torque lasts so many periods, and so many times the least time of the rated one.
constexpr double window_periods = 300.0;
constexpr double window_ratio   = 30.0;

double half_speed(const Drive &d)
{
    return 0.5 * d.motor.rated_speed_e_radps;
}

double least_rated_s(const Drive &d)
{
    const double rated_Nm = d.motor.rated_torque_Nm;
    return least_torque_time_s(d, half_speed(d), tenth * rated_Nm, rated_Nm);
}

double window_s(const Drive &d)
{
    const double least = least_rated_s(d);
    return std::max(window_periods * control_period_s(d),
                    std::isnan(least) ? 0.0 : window_ratio * least);
}

void judge_time(TorqueTrial &t, const char *what, const std::optional<double> &time_s,
                double least_s, double more_s)
{
    const double most_s = least_ratio * least_s + more_s;
    if (!time_s && t.faults == 0) {
        t.reasons.push_back(fmt::format("{} of the rated torque does not come", what));
    } else if (time_s && !(*time_s <= most_s)) {
        t.reasons.push_back(fmt::format("{} of the rated torque after {:.4g} ms, at most {:.4g}",
                                        what, 1e3 * *time_s, 1e3 * most_s));
    }
}

void judge(TorqueTrial &t, int seeds, const Drive &d)
{
    if (t.faults > 0) {
        t.reasons.push_back(fmt::format("trips in {} of {} seeds", t.faults, seeds));
    }
    judge_time(t, "a tenth", t.tenth_s, t.least_tenth_s, tenth_periods * control_period_s(d));
    judge_time(t, "all", t.rated_s, t.least_rated_s, rated_periods * control_period_s(d));
    beyond(t.reasons, "overshoot", t.overshoot_percent, overshoot_percent, "%");
    beyond(t.reasons, "error", t.error_percent, error_percent, "%");
    beyond(t.reasons, "ripple", t.ripple_percent, ripple_percent, "%");
    beyond(t.reasons, "peak current", t.peak_current_A, peak_ratio * d.motor.max_current_A, "A");
}

std::string time_words(const std::optional<double> &time_s)
{
    return time_s ? fmt::format("{:.2f} ms", 1e3 * *time_s) : "never";
}

} // namespace

Scenario torque_scenario(const Drive &d)
{
    const double window    = window_s(d);
    const double rated_Nm  = d.motor.rated_torque_Nm;
    const double shaft_mps = half_speed(d) / d.motor.pole_pairs;
    const double lost_Nm   = d.motor.viscous_friction_Nms * shaft_mps;
    Scenario     s         = at_speed(d, half_speed(d), -lost_Nm);
    const double first_s   = steady_after_s(d, 0.0);
    const char  *names[]   = {"zero", "tenth", "rated"};
    const double shares[]  = {0.0, tenth, 1.0};
    for (std::size_t k = 0; k < 3; k++) {
        const double time_s = first_s + static_cast<double>(k) * window;
        s.torque_reference.push_back({time_s, shares[k] * rated_Nm});
        s.load_torque.push_back({time_s, shares[k] * rated_Nm - lost_Nm});
        s.measures.push_back({names[k], time_s, 0.02 * d.motor.rated_speed_e_radps, {}});
    }
    s.duration_s = first_s + 3.0 * window;
    return s;
}

std::optional<TorqueTrial> torque_trial(const Drive &d, int seeds)
{
    if (!d.torque) {
        return std::nullopt;
    }
    const SeedRuns runs = run_seeds(torque_scenario(d), seeds);
    TorqueTrial    t;
    t.speed_e_radps = half_speed(d);
    t.least_tenth_s = least_torque_time_s(d, half_speed(d), 0.0, tenth * d.motor.rated_torque_Nm);
    t.least_rated_s = least_rated_s(d);
    t.faults        = runs.faults;
    t.tenth_s       = runs.measures[1].worst("torque_rise_s");
    t.rated_s       = runs.measures[2].worst("torque_rise_s");
    t.overshoot_percent = runs.measures[2].worst("torque_overshoot_percent").value_or(0.0);
    for (const SeedMeasure &m : runs.measures) {
        t.error_percent = std::max(t.error_percent, m.worst("torque_error_percent").value_or(0.0));
        t.ripple_percent =
            std::max(t.ripple_percent, m.worst("torque_ripple_percent").value_or(0.0));
        t.peak_current_A = std::max(t.peak_current_A, m.worst("peak_current_A").value_or(0.0));
    }
    judge(t, seeds, d);
    return t;
}

std::string torque_words(const TorqueTrial &t)
{
    return fmt::format(
        "torques at {:.4g} rad/s: a tenth of the rated one after {}, all of it after {} ({} at "
        "least); overshoot {:.1f} %, error {:.2f} %, ripple {:.2f} %: {}",
        t.speed_e_radps, time_words(t.tenth_s), time_words(t.rated_s),
        std::isnan(t.least_rated_s) ? "out of reach" : time_words(t.least_rated_s),
        t.overshoot_percent, t.error_percent, t.ripple_percent,
        t.reasons.empty() ? "good" : fmt::format("{}", fmt::join(t.reasons, ", ")));
}

} // namespace sdre
