// SPDX-License-Identifier: MIT
#include "sil/qualify/plan.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "design/laws/near_optimal.hpp"
#include "design/sampled_model.hpp"
#include "design/trip_levels.hpp"
#include "sil/setup/board_reader.hpp"
#include "tune/goals.hpp"
#include "tune/prediction.hpp"

namespace sdre {
namespace {

// Chosen: a tuned drive stays below half of these; beyond them a drive is not one that anybody would want.
constexpr double dip_ratio      = 3.0;   // of the physical bound
constexpr double settling_ratio = 30.0;  // reactions
constexpr double load_band      = 0.125; // of the bound of the dip
constexpr double noise_band =
    1.5; // of three standard deviations of the noise, where those are more
constexpr double speed_band = 0.02; // of the rated speed
// Chosen: a run lasts so many reactions before a step and after it, and so many periods at least.
constexpr double before_reactions = 30.0;
constexpr double after_reactions  = 60.0;
constexpr double least_periods    = 300.0;
// Chosen: a speed step takes at most this long at full torque in a trial of random motors.
constexpr double short_way_s = 0.08;
// A run begins with the speed between two edges of a disc, which are off by this much. The observer
// corrects it with some of the torque. With few lines and much inertia this takes long.
constexpr double start_error_cnt = 0.35;
constexpr double start_share     = 0.3;
// Chosen: of the current limit, for flux weakening that leaves some torque.
constexpr double weakening_share = 0.8;

// Chosen: counts of a wrong reading, and fewer of a coarse encoder. Beyond 0.45 rad a drive trips, as torque is then lost.
constexpr double off_cnt      = 5.0;
constexpr double most_off_rad = 0.35;

constexpr double weakening_times = 1.5; // chosen: there is less torque at higher speeds

struct Numbers {
    PhysicalBound bound;
    double        ts_s;
    double        start_s; ///< to correct the speed that a run begins with
    double        rated_e_radps;
    double        rated_Nm;
    double        circle_V;
    double        noise_V;
    double        accel; ///< of all the torque [rad/s^2]
    double        load_band_e_radps;

    double before_s() const
    {
        return std::max(before_reactions * bound.reaction_s, least_periods * ts_s) + start_s;
    }
    double after_s() const
    {
        return std::max(after_reactions * bound.reaction_s, 2.0 * least_periods * ts_s);
    }
    /// Time for a change of speed with a load, and to settle.
    double way_s(double change_e_radps, double load_Nm, double most_Nm) const
    {
        const double share = std::max(1.0 - load_Nm / most_Nm, 0.2);
        return 1.5 * change_e_radps / (accel * share) + after_s();
    }
};

double largest_torque(const Drive &d, const ReducedParameters &l)
{
    const double iq_A = largest_iq_A(d.motor, l);
    return torque_Nm(d.motor, mtpa_id_A(l, iq_A), iq_A);
}

Trial load_step(const Drive &d, const Numbers &n, const std::string &what, double speed)
{
    Trial     t{what, at_speed(d, speed, 0.5 * n.rated_Nm)};
    Scenario &s = t.scenario;
    s.load_torque.push_back({n.before_s(), n.rated_Nm});
    s.measures         = {{"before", 0.5 * n.before_s(), n.load_band_e_radps, {}},
                          {"load step", n.before_s(), n.load_band_e_radps, {}}};
    s.duration_s       = n.before_s() + n.after_s();
    t.most_dip_e_radps = dip_ratio * n.bound.dip_e_radps;
    t.most_settling_s  = settling_ratio * n.bound.reaction_s;
    t.most_noise_V     = n.noise_V;
    return t;
}

Trial speed_step(const Drive &d, const Numbers &n, const std::string &what, double from, double to,
                 double load_Nm)
{
    const double most_Nm = largest_torque(d, reduced_parameters(d.motor));
    Trial        t{what, at_speed(d, from, load_Nm)};
    Scenario    &s = t.scenario;
    s.speed_reference.push_back({n.before_s(), to});
    s.measures   = {{what, n.before_s(), speed_band * n.rated_e_radps, {}}};
    s.duration_s = n.before_s() + n.way_s(std::abs(to - from), load_Nm, most_Nm);
    return t;
}

/// Highest speed that the voltage circle leaves to a motor that spends a part of its current on the d axis.
double weakened_e_radps(const Drive &d, const Numbers &n)
{
    const Motor &m    = d.motor;
    const double flux = m.pm_flux_Wb - weakening_share * m.max_current_A * m.d_axis_inductance_H;
    const double by_voltage = 0.85 * n.circle_V / std::max(flux, 0.2 * m.pm_flux_Wb + 1e-9);
    return std::min({0.9 * largest_command_e_radps(d), 1.6 * n.rated_e_radps, by_voltage});
}

/// The speed near this one at which so many counts come in a period. A coarse encoder has one count in so many periods.
double counts_per_period_e_radps(const Drive &d, double near_e_radps, double fraction)
{
    const double one   = count_e_rad(d) / control_period_s(d); // speed of one count a period
    const double share = near_e_radps / one;
    return share < 0.5 ? one / (std::round(1.0 / share) + fraction)
                       : (std::max(std::round(share), 1.0) + fraction) * one;
}

void add_speeds(const Drive &d, const Numbers &n, std::vector<Trial> &trials)
{
    const double w = n.rated_e_radps;
    trials.push_back(speed_step(d, n, "speed step", 0.2 * w, 0.8 * w, 0.1 * n.rated_Nm));
    const double weak = weakened_e_radps(d, n);
    if (weak > 1.05 * w) {
        const double light_Nm = 0.05 * n.rated_Nm;
        trials.push_back(speed_step(d, n, "flux weakening", 0.8 * w, weak, light_Nm));
        trials.back().scenario.duration_s *= weakening_times;
    }
    trials.push_back(speed_step(d, n, "reversal", -0.6 * w, 0.6 * w, 0.0));
    Trial start = speed_step(d, n, "start while turning", 0.5 * w, 0.3 * w, 0.3 * n.rated_Nm);
    start.scenario.speed_reference = {
        {0.0, 0.3 * w}}; // the run begins at another speed than wanted
    start.scenario.measures[0].time_s = 0.0;
    trials.push_back(start);
}

void add_slow(const Drive &d, const Numbers &n, std::vector<Trial> &trials)
{
    Trial hold{"hold at rest", at_speed(d, 0.0, 0.0)};
    hold.scenario.load_torque.push_back({n.before_s(), n.rated_Nm});
    hold.scenario.measures   = {{"hold", n.before_s(), speed_band * n.rated_e_radps, {}}};
    hold.scenario.duration_s = n.before_s() + 2.0 * n.after_s();
    trials.push_back(hold);
    const double slow = 0.004 * n.rated_e_radps;
    Trial        crawl{"crawl", at_speed(d, slow, 0.5 * n.rated_Nm)};
    crawl.scenario.measures   = {{"crawl", n.before_s(), speed_band * n.rated_e_radps, {}}};
    crawl.scenario.duration_s = n.before_s() + 2.0 * n.after_s();
    trials.push_back(crawl);
}

void add_faults(const Drive &d, const Numbers &n, std::vector<Trial> &trials)
{
    const double w = 0.5 * n.rated_e_radps;
    Trial        spike{"current sample at full scale", at_speed(d, w, 0.5 * n.rated_Nm)};
    spike.scenario.glitches   = {{n.before_s(), 1, 0, 2.0 * d.current_sensors.range_A, 0.0}};
    spike.scenario.measures   = {{"spike", n.before_s(), speed_band * n.rated_e_radps, {}}};
    spike.scenario.duration_s = n.before_s() + n.after_s();
    Trial     jump            = spike;
    const int off             = static_cast<int>(std::min(off_cnt, most_off_rad / count_e_rad(d)));
    jump.what                 = fmt::format("encoder read {} counts off", off);
    jump.scenario.glitches    = {{n.before_s(), 1, off, 0.0, 0.0}};
    Trial dead                = spike;
    dead.what                 = "encoder dies";
    dead.scenario.glitches.clear();
    PlantChange change;
    change.time_s                = n.before_s();
    change.changes_plant         = false;
    change.sensors               = dead.scenario.sensors;
    change.sensors->encoder_dead = true;
    dead.scenario.changes        = {change};
    dead.must_settle             = false;
    dead.may_trip                = true;
    trials.insert(trials.end(), {spike, jump, dead});
}

Scenario for_motors(const Drive &d, const Numbers &n, const MotorRanges &ranges, double load_Nm)
{
    const double most_Nm = largest_torque(d, reduced_parameters(d.motor));
    const double change =
        std::min(0.2 * n.rated_e_radps, short_way_s * n.accel * (1.0 - load_Nm / most_Nm));
    const double from   = 0.4 * n.rated_e_radps;
    const double step_s = 2.0 * n.before_s();
    // Twice the inertia and 0.7 of the flux, with the load: a quarter of the acceleration.
    const double load_s = step_s + 4.0 * n.way_s(change, load_Nm, most_Nm);
    Scenario     s      = at_speed(d, from, 0.5 * load_Nm);
    s.motor_ranges      = ranges;
    s.speed_reference.push_back({step_s, from + change});
    s.load_torque.push_back({load_s, load_Nm});
    s.measures   = {{"speed step", step_s, speed_band * n.rated_e_radps, {}},
                    {"load step", load_s, speed_band * n.rated_e_radps, {}}};
    s.duration_s = load_s + 4.0 * n.after_s();
    return s;
}

Numbers numbers_of(const Drive &d, double noise_share)
{
    const ReducedParameters l = reduced_parameters(d.motor);
    Numbers                 n{};
    n.bound         = physical_bound(d);
    n.ts_s          = control_period_s(d);
    n.rated_e_radps = d.motor.rated_speed_e_radps;
    n.rated_Nm      = d.motor.rated_torque_Nm;
    n.circle_V      = d.inverter.dc_link_V / std::sqrt(3.0);
    n.noise_V       = noise_share * n.circle_V;
    n.accel         = l[3] * largest_torque(d, l);

    const auto noise = predicted(d);
    n.load_band_e_radps =
        std::max(load_band * n.bound.dip_e_radps, noise ? noise_band * noise->ripple_e_radps : 0.0);
    n.start_s = start_error_cnt * count_e_rad(d) / n.ts_s / (start_share * n.accel);
    return n;
}

} // namespace

Scenario at_speed(const Drive &d, double speed_e_radps, double load_Nm)
{
    Scenario s;
    s.name                  = "qualify";
    s.drive                 = d;
    s.dc_link_V             = d.inverter.dc_link_V;
    s.sensors               = sensors_of_drive(d);
    s.motor_effects         = effects_of_drive(d);
    s.sensors.ideal         = false;
    s.initial_speed_e_radps = speed_e_radps;
    s.speed_reference       = {{0.0, speed_e_radps}};
    s.load_torque           = {{0.0, load_Nm}};
    return s;
}

double steady_after_s(const Drive &d, double change_e_radps)
{
    const Numbers n = numbers_of(d, 0.0);
    return weakening_times *
           n.way_s(change_e_radps, 0.0, largest_torque(d, reduced_parameters(d.motor)));
}

Plan qualification_plan(const Drive &d, double noise_share)
{
    const Numbers n = numbers_of(d, noise_share);
    Plan          plan;
    const double  half = 0.5 * n.rated_e_radps;
    plan.trials        = {
               load_step(d, n, "load step", half),
               load_step(d, n, "load step, whole counts a period",
                         counts_per_period_e_radps(d, half, 0.0)),
               load_step(d, n, "load step, half a count more", counts_per_period_e_radps(d, half, 0.5))};
    add_speeds(d, n, plan.trials);
    add_slow(d, n, plan.trials);
    add_faults(d, n, plan.trials);
    // The weakest magnet carries 0.7 (0.5) of the torque: loads that it can.
    const double carried =
        std::min(n.rated_Nm, 0.8 * largest_torque(d, reduced_parameters(d.motor)));
    plan.motors = for_motors(d, n, {{0.7, 1.3}, {0.7, 1.3}, {0.7, 1.3}, {0.5, 2.0}}, 0.7 * carried);
    plan.wide_motors =
        for_motors(d, n, {{0.5, 1.5}, {0.5, 1.5}, {0.5, 1.5}, {0.5, 3.0}}, 0.5 * carried);
    return plan;
}

} // namespace sdre
