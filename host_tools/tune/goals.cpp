// SPDX-License-Identifier: MIT
#include "tune/goals.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/law_design.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/machine_points.hpp"
#include "design/motor_model.hpp"
#include "design/noc_shaft/shaft_design.hpp"
#include "design/sampled_model.hpp"
#include "tune/shaft_cases.hpp"
#include "tune/start_weights.hpp"

namespace sdre {
namespace {

// Chosen: half of the rated speed and torque, where a drive is used; the other half of the torque is the step.
constexpr double speed_share = 0.5;
constexpr double load_share  = 0.5;
// The 390 W motor on edge times reaches 1.25 times its bound and settles after 4.6 reactions, within an eighth of the dip.
constexpr double dip_goal      = 1.25;
constexpr double settling_goal = 5.0;
constexpr double band_share    = 0.125;
constexpr double ripple_share =
    0.25; // three deviations of the noise, of the bound: below what is seen of a dip
// Chosen: what the ear and the losses forgive, in shares of the circle.
constexpr double noise_share = 0.03;
// Chosen: a step may ask for this much of the circle; what is beyond is cut.
constexpr double headroom_share = 2.5;
// Allowed factors on dip and settling time of other motors.
constexpr double robust_dip      = 2.0;
constexpr double robust_settling = 6.0;
// Chosen: voltage left for the current's way is never counted as less than this share of the circle.
constexpr double least_reserve = 0.3;

struct Steady {
    double iq_A;
    double id_A;
};

Steady carrying(const Drive &d, const ReducedParameters &l, double load_Nm)
{
    const double iq_A = mtpa_iq_A(d.motor, l, load_Nm, d.motor.max_current_A);
    return {iq_A, mtpa_id_A(l, iq_A)};
}

double hold_V(const Drive &d, const Steady &at, double speed_e_radps)
{
    return steady_voltage_V(d.motor, at.id_A, at.iq_A, speed_e_radps);
}

/// Believed over true: J, then all of R, L and flux, then L once more; how much deeper its dip may be.
RobustnessCase robust(double J, double electrical, double inductance, const TuneSpec &spec)
{
    RobustnessCase c = spec.cases.front();
    c.mechanical     = J;
    c.electrical     = electrical;
    c.inductance     = inductance;
    c.settling_time_s *= robust_settling;
    c.ripple_e_radps *= robust_settling;
    c.dip_e_radps *= robust_dip;
    return c;
}

} // namespace

PhysicalBound physical_bound(const Drive &d)
{
    const ReducedParameters l      = reduced_parameters(d.motor);
    const double            ts     = control_period_s(d);
    const double            circle = d.inverter.dc_link_V / std::sqrt(3.0);
    const double            rated  = d.motor.rated_torque_Nm;
    const Steady            before = carrying(d, l, load_share * rated);
    const Steady            after  = carrying(d, l, rated);
    const double            speed  = speed_share * d.motor.rated_speed_e_radps;
    const double reserve_V = std::max(circle - hold_V(d, before, speed), least_reserve * circle);
    const double way_s     = (after.iq_A - before.iq_A) * d.motor.q_axis_inductance_H / reserve_V;
    const double accel     = l[3] * (1.0 - load_share) * rated;
    const double seen_s    = std::sqrt(2.0 * sample_noise(d).angle_rad / accel);
    const double shaft_s =
        law_design(d).shaft_states ? 1.0 / resonance_radps(believed_shaft(d)) : 0.0;
    const double reaction_s = 1.5 * ts + 0.5 * way_s + seen_s + shaft_s;
    return {reaction_s, accel * reaction_s, shaft_s};
}

void require_torque(const Drive &d, double load_Nm, const std::string &what)
{
    const ReducedParameters l    = reduced_parameters(d.motor);
    const double            iq_A = largest_iq_A(d.motor, l);
    const double            most = torque_Nm(d.motor, mtpa_id_A(l, iq_A), iq_A);
    if (load_Nm > most) {
        throw InputError(fmt::format("{} = {:g} cannot be had: [motor] max_current_A = {:g} gives "
                                     "{:.3g} N m",
                                     what, load_Nm, d.motor.max_current_A, most));
    }
}

TuneSpec with_shaft_cases(TuneSpec spec, const Drive &d)
{
    if (!law_design(d).shaft_states || has_resonance(spec)) {
        return spec;
    }
    for (const double at_Hz : {d.mechanics.from_Hz, d.mechanics.to_Hz}) {
        spec.cases.push_back(RobustnessCase(spec.cases.front()));
        spec.cases.back().resonance = at_Hz / d.mechanics.resonance_Hz;
    }
    return spec;
}

TuneSpec goals_from_physics(const Drive &d)
{
    require_torque(d, d.motor.rated_torque_Nm, "[motor] rated_torque_Nm");
    const double circle = d.inverter.dc_link_V / std::sqrt(3.0);
    const double speed  = speed_share * d.motor.rated_speed_e_radps;
    const double emf_V  = speed * d.motor.pm_flux_Wb;
    if (emf_V > circle) {
        throw InputError(fmt::format("[motor] rated_speed_e_radps = {:g} cannot be had: at half of "
                                     "it the EMF is {:.4g} V, dc_link_V = {:g} gives {:.4g} V",
                                     d.motor.rated_speed_e_radps, emf_V, d.inverter.dc_link_V,
                                     circle));
    }
    const PhysicalBound   bound = physical_bound(d);
    const CurrentSensors &s     = d.current_sensors;
    const double          pace  = pace_of_sensors(d);

    TuneSpec spec;
    spec.speed_e_radps      = speed;
    spec.load_before_Nm     = load_share * d.motor.rated_torque_Nm;
    spec.load_step_Nm       = (1.0 - load_share) * d.motor.rated_torque_Nm;
    const double rigid      = 1.0 - bound.shaft_s / bound.reaction_s; // share of a rigid drive
    spec.band_e_radps       = band_share * rigid * bound.dip_e_radps;
    spec.voltage_headroom_V = headroom_share * circle;
    spec.voltage_noise_V    = noise_share * circle;
    spec.noise_is_a_limit   = true;
    spec.current_noise_A    = s.noise_rms_A;
    spec.current_lsb_A      = 2.0 * s.range_A / std::exp2(s.adc_bits);
    spec.angle_error_cnt    = sample_noise(d).angle_rad / count_e_rad(d);
    // The slowest mode of other motors may last as long as their settling time.
    const double ts   = control_period_s(d);
    spec.largest_pole = std::exp(-ts / (robust_settling * settling_goal * pace * bound.reaction_s));

    RobustnessCase nominal;
    nominal.dip_e_radps     = dip_goal * bound.dip_e_radps;
    nominal.settling_time_s = settling_goal * rigid * bound.reaction_s;
    if (law_design(d).shaft_states) {
        nominal.settling_time_s =
            shaft_settling_s(d.mechanics, nominal.settling_time_s, d.mechanics.resonance_Hz);
    }
    nominal.ripple_e_radps = ripple_share * bound.dip_e_radps;
    spec.cases.push_back(nominal);
    // Corners of R, L, flux x0.7 .. 1.3 and J x0.5 .. 2, those that accelerate fastest and slowest.
    spec.cases.push_back(robust(2.0, 1.0 / 1.3, 1.0, spec));
    spec.cases.push_back(robust(2.0, 1.0 / 1.3, 1.3 / 0.7, spec));
    spec.cases.push_back(robust(0.5, 1.0 / 0.7, 1.0, spec));
    spec.cases.push_back(robust(0.5, 1.0 / 0.7, 0.7 / 1.3, spec));
    spec.cases[1].dip_e_radps *= 2.0; // half the inertia
    spec.cases[2].dip_e_radps *= 2.0;
    return with_shaft_cases(spec, d);
}

} // namespace sdre
