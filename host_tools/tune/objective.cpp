// SPDX-License-Identifier: MIT
#include "tune/objective.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/parallel.hpp"
#include "design/firmware_config.hpp"
#include "design/laws/laws.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/machine_points.hpp"
#include "design/noc_shaft/shaft_design.hpp"
#include "design/trip_levels.hpp"
#include "design/verdict.hpp"
#include "linalg/covariance.hpp"
#include "tune/load_step.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double noise_slope = 3.0;  // a limit: beyond it nothing else counts
constexpr double no_solution = 1e12; // of the Riccati equations: worse than any unstable loop

// Chosen: with twice the inertia's tolerance and all of the flux's. No motor within R, L, flux x0.7 .. 1.3 and J x0.5 .. 2
// accelerates as fast, and one near it has room for the delay of edges that the sampled model does not have.
constexpr double lively_flux    = 1.3;
constexpr double lively_inertia = 0.45;
// Chosen: the certificate looks at more points, and more finely.
constexpr double peak_share = 0.8;
// Chosen: where the noise fills the band, half of it stays for the load step, and the ripple is far from its goal.
constexpr double least_band_share = 0.5;
// The one parameter alone at which certificates of rare edges fail first.
constexpr double low_inductance = 0.5;

Motor believed_motor(Motor m, const RobustnessCase &c)
{
    m.inertia_kgm2 *= c.mechanical;
    m.viscous_friction_Nms *= c.mechanical;
    m.stator_resistance_Ohm *= c.electrical;
    m.d_axis_inductance_H *= c.electrical * c.inductance;
    m.q_axis_inductance_H *= c.electrical * c.inductance;
    m.pm_flux_Wb *= c.electrical;
    return m;
}

Motor lively(Motor m)
{
    m.pm_flux_Wb *= lively_flux;
    m.inertia_kgm2 *= lively_inertia;
    return m;
}

Motor of_low_inductance(Motor m)
{
    m.d_axis_inductance_H *= low_inductance;
    m.q_axis_inductance_H *= low_inductance;
    return m;
}

/// Laws without a loop of their own are judged as noc.
const LinearLoop &linear_loop(const Drive &drive)
{
    const auto &own = law_design(drive).loop;
    return own ? *own : *noc_design.loop;
}

/// One robustness case: the motor and its shaft, and the controller's model with its gains.
struct Loop {
    const LinearLoop *law;
    Design            believed;
    Drive             own;
    TrueMotor         motor;
    Shaft             shaft;
    LoopGains         gains;

    SampledModel at(const OperatingPoint &point, const TrueMotor &plant) const
    {
        return law->at(believed, plant, shaft, point, gains);
    }
    SampledModel at(const OperatingPoint &point) const
    {
        return at(point, motor);
    }
    double radius_at(const OperatingPoint &point) const
    {
        return spectral_radius(at(point).A);
    }
    /// With other values of [motor].
    double radius_with(const Motor &other, const OperatingPoint &point) const
    {
        return spectral_radius(at(point, plant_of(other)).A);
    }
    /// A law with a map has the motor of the map.
    TrueMotor plant_of(const Motor &m) const
    {
        return law->believe != nullptr ? true_motor(own, m) : TrueMotor(reduced_parameters(m));
    }
};

/// Only the gains of order 0: near the operating point the others do nothing.
Loop loop_of(const Drive &drive, const RobustnessCase &c)
{
    Loop loop{&linear_loop(drive), {}, drive, reduced_parameters(drive.motor), {}, {}};
    loop.believed.drive       = drive;
    loop.believed.drive.motor = believed_motor(drive.motor, c);
    loop.believed.l           = reduced_parameters(loop.believed.drive.motor);
    loop.believed.config      = common_config(loop.believed);
    if (loop.law->believe != nullptr) {
        loop.law->believe(loop.believed, drive.motor);
    }
    loop.gains = first_gains(loop.believed);
    loop.motor = loop.plant_of(drive.motor);
    loop.shaft = believed_shaft(drive);
    loop.shaft.resonance_Hz *= c.resonance;
    return loop;
}

/// The steady operating point that carries a load torque on the MTPA curve.
OperatingPoint operating_point(const Loop &loop, double speed, double load_Nm)
{
    const ReducedParameters l = reduced_parameters(loop.own.motor);
    OperatingPoint          at{speed, loop.own.motor.max_current_A, l[0]};
    for (int i = 0; i < 50; i++) { // contraction factor below 0.5
        const double per_A = loop.motor.acceleration(at) / at.iq_A;
        at.iq_A            = (l[2] * speed + l[3] * load_Nm) / per_A;
        at.id_A            = mtpa_id_A(l, at.iq_A);
    }
    return at;
}

/// The larger radius of a lively motor, and of one with little inductance at the largest speed.
double radius_with_others(const Loop &loop, const Drive &drive, const OperatingPoint &at)
{
    const OperatingPoint top{largest_command_e_radps(drive), 0.0, at.id_A};
    return std::max(loop.radius_with(lively(drive.motor), at),
                    loop.radius_with(of_low_inductance(drive.motor), top));
}

/// Rough peak of the sensitivity at the largest speed, with the largest q currents that can be held there.
double top_peak(const Loop &loop, const Drive &drive)
{
    Design design;
    design.drive = drive;
    design.l     = reduced_parameters(drive.motor);
    double worst = 0.0;
    for (const double share : {-1.0, 0.0, 1.0}) {
        const SampledModel m = loop.at(
            held_point(design, largest_command_e_radps(drive), share * drive.motor.max_current_A));
        for (const BrokenLoop &b : broken_at_voltages(m.A, m.B_voltage, m.C_voltage, m.ts_s)) {
            worst = std::max(worst, rough_peak(b));
        }
    }
    return worst;
}

/// Largest value over speeds. The nominal case includes the speeds of the certificate, up to twice
/// the current limit at the trip speed.
double worst_radius(const Loop &loop, const Drive &drive, const RobustnessCase &c,
                    const OperatingPoint &at, const TuneSpec &spec)
{
    double worst = 0.0;
    for (const double speed : {0.0, spec.speed_e_radps, drive.motor.rated_speed_e_radps}) {
        worst = std::max(worst, loop.radius_at({speed, at.iq_A, at.id_A}));
    }
    if (is_nominal(c)) {
        const double beyond = loop.law->believe == nullptr ? 2.0 : 1.0; // of a map there is nothing
        const double iq_A   = beyond * drive.motor.max_current_A;
        const double id_A   = mtpa_id_A(reduced_parameters(drive.motor), iq_A);
        const double radius = loop.radius_at({trip_speed_e_radps(drive), iq_A, id_A});
        worst               = radius < 1.0 ? worst : std::max(1.0, radius);
        const double other  = spec.rare_edges ? radius_with_others(loop, drive, at) : 0.0;
        worst               = other < 1.0 ? worst : std::max(other, worst);
        const double shaft  = radius_with_shafts(drive, loop.gains);
        worst               = shaft < 1.0 ? worst : std::max(shaft, worst);
    }
    return worst;
}

/// With a shaft in its model, a speed is settled when noise leaves it in the band too.
TuneSpec settled_with_noise(TuneSpec spec, double ripple_e_radps)
{
    spec.band_e_radps =
        std::max(spec.band_e_radps - ripple_e_radps, least_band_share * spec.band_e_radps);
    return spec;
}

CaseResult evaluate_case(const Drive &drive, const TuneSpec &spec, const RobustnessCase &c)
{
    const Loop           loop = loop_of(drive, c);
    const OperatingPoint at =
        operating_point(loop, spec.speed_e_radps, spec.load_before_Nm + 0.5 * spec.load_step_Nm);
    const bool shaft = law_design(drive).shaft_states;
    CaseResult result;
    result.spectral_radius = worst_radius(loop, drive, c, at, spec);
    if (result.spectral_radius < 1.0) {
        const SampledModel m       = loop.at(at);
        const Sensors      sensors = sensors_of(drive, spec);
        const double       i2      = sensors.current_A * sensors.current_A;
        const MatrixXd     P       = covariance(
                      m.A, m.B_noise, Eigen::Vector3d(i2, i2, sensors.angle_rad * sensors.angle_rad));
        const MatrixXd V      = m.C_voltage * P * m.C_voltage.transpose();
        result.ripple_e_radps = 3.0 * std::sqrt(std::max(P(0, 0), 0.0));
        const LoadStep step =
            load_step(m, shaft ? settled_with_noise(spec, result.ripple_e_radps) : spec);
        result.dip_e_radps     = step.dip_e_radps;
        result.settling_time_s = step.settling_time_s;
        result.voltage_V       = step.voltage_V + 3.0 * std::sqrt(V.trace());
        result.voltage_noise_V = std::sqrt(V(0, 0));
        result.peak            = spec.rare_edges && is_nominal(c) ? top_peak(loop, drive) : 0.0;
        result.shaft           = is_nominal(c) && !shaft ? shaft_step(drive, spec, loop.gains, at)
                                                         : ShaftStep{}; // its cases have it
    }
    return result;
}

/// Largest result / specification of one case; `unstable_score` and above when the loop is.
double ratio(const CaseResult &r, const RobustnessCase &c, const TuneSpec &spec)
{
    if (!(r.spectral_radius < 1.0)) {
        return unstable_score * r.spectral_radius;
    }
    double worst = 0.0;
    for (const GoalRatio &goal : goal_ratios(r, c, spec)) {
        worst = std::max(worst, goal.ratio);
    }
    return worst;
}

double six_digits(double x)
{
    return std::strtod(fmt::format("{:.5e}", x).c_str(), nullptr);
}

} // namespace

std::vector<GoalRatio> goal_ratios(const CaseResult &r, const RobustnessCase &c,
                                   const TuneSpec &spec)
{
    double noise = is_nominal(c) && spec.voltage_noise_V > 0.0
                       ? r.voltage_noise_V / spec.voltage_noise_V
                       : 0.0;
    if (spec.noise_is_a_limit && noise > 1.0) {
        noise *= noise_slope * noise * noise * noise;
    }
    double peak = r.peak / (peak_share * peak_sensitivity_limit);
    if (peak > 1.0) {
        peak *= noise_slope * peak * peak * peak; // as the noise: a limit
    }
    return {{"noise of v_q", noise},
            {"sensitivity", peak},
            {"dip", r.dip_e_radps / c.dip_e_radps},
            {"settling time", r.settling_time_s / c.settling_time_s},
            {"load step behind an elastic shaft", r.shaft.ratio},
            {"ripple", r.ripple_e_radps / c.ripple_e_radps},
            {"slowest mode", (1.0 - spec.largest_pole) / (1.0 - r.spectral_radius)},
            {"voltage", r.voltage_V / spec.voltage_headroom_V}};
}

Score score(const Drive &drive, const TuneSpec &spec)
{
    Score               s;
    std::vector<double> ratios(spec.cases.size(), no_solution);
    s.cases.resize(spec.cases.size());
    parallel_for(spec.cases.size(), [&](std::size_t i) {
        try {
            s.cases[i] = evaluate_case(drive, spec, spec.cases[i]);
            ratios[i]  = ratio(s.cases[i], spec.cases[i], spec);
        } catch (const DesignError &) { // no solution there: stay away
        }
    });
    for (const double r : ratios) {
        s.worst = std::max(s.worst, r);
        s.value += 0.1 * r / static_cast<double>(ratios.size());
    }
    s.value = six_digits(s.value + s.worst);
    s.worst = six_digits(s.worst);
    return s;
}

} // namespace sdre
