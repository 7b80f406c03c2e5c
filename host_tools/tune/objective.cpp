// SPDX-License-Identifier: MIT
#include "tune/objective.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/parallel.hpp"
#include "design/design.hpp"
#include "design/sampled_model.hpp"
#include "design/sampled_observer.hpp"
#include "design/trip_levels.hpp"
#include "design/verdict.hpp"
#include "linalg/covariance.hpp"
#include "tune/load_step.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double pi          = 3.14159265358979323846;
constexpr double noise_slope = 3.0;  // a limit: beyond it nothing else counts
constexpr double no_solution = 1e12; // of the Riccati equations: worse than any unstable loop

// Chosen: with twice the inertia's tolerance and all of the flux's. No motor within R, L, flux x0.7 .. 1.3 and J x0.5 .. 2
// accelerates as fast, and one near it has room for the delay of edges that the sampled model does not have.
constexpr double lively_flux    = 1.3;
constexpr double lively_inertia = 0.45;
// Chosen: the certificate looks at more points, and more finely.
constexpr double peak_share = 0.8;
// The one parameter alone at which certificates of rare edges fail first.
constexpr double low_inductance = 0.5;

enum Weight { speed_error, q_axis_error, load_drift, voltage_drift, speed_noise, current_noise };

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

/// The steady operating point that carries a load torque on the MTPA curve.
OperatingPoint operating_point(const ReducedParameters &l, double speed, double load_Nm)
{
    OperatingPoint at{speed, 0.0, l[0]};
    for (int i = 0; i < 50; i++) { // contraction factor below 0.5
        at.iq_A = (l[2] * speed + l[3] * load_Nm) / (l[1] + l[11] * at.id_A);
        at.id_A = mtpa_id_A(l, at.iq_A);
    }
    return at;
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

/// One robustness case: the motor, and the controller's model with its gains.
struct Loop {
    ReducedParameters motor;
    ReducedParameters model;
    LoopGains         gains;
    double            ts_s;

    SampledModel at(const OperatingPoint &point) const
    {
        return sampled_model(motor, model, gains, point, ts_s);
    }
    double radius_at(const OperatingPoint &point) const
    {
        return spectral_radius(at(point).A);
    }
};

/// Only the gains of order 0: near the operating point the others do nothing.
Loop loop_of(const Drive &drive, const RobustnessCase &c)
{
    const ReducedParameters model = reduced_parameters(believed_motor(drive.motor, c));
    const Eigen::Vector2d   T_nosc(drive.nosc.T[0], drive.nosc.T[1]);
    const SdreProblem       control = nosc_problem(at_rest(model), drive.nosc);
    const MatrixXd          X       = solve_care(control.A0, control.G, control.Q).X;
    const double            ts      = control_period_s(drive);
    return {reduced_parameters(drive.motor),
            model,
            {T_nosc.cwiseInverse().asDiagonal() * nosc_input_matrix(model).transpose() * X,
             solve_encoder_form(at_rest(model), drive.nodo, ts).gain[0]},
            ts};
}

double radius_with(const Motor &motor, const Loop &loop, const OperatingPoint &at)
{
    const ReducedParameters l = reduced_parameters(motor);
    return spectral_radius(sampled_model(l, loop.model, loop.gains, at, loop.ts_s).A);
}

/// The larger radius of a lively motor, and of one with little inductance at the largest speed.
double radius_with_others(const Loop &loop, const Drive &drive, const OperatingPoint &at)
{
    const OperatingPoint top{largest_command_e_radps(drive), 0.0, at.id_A};
    return std::max(radius_with(lively(drive.motor), loop, at),
                    radius_with(of_low_inductance(drive.motor), loop, top));
}

/// Rough peak of the sensitivity at the largest speed, with the largest q currents that can be held there.
double top_peak(const Loop &loop, const Drive &drive)
{
    Design design;
    design.drive = drive;
    design.l     = loop.motor;
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
        const double iq_A = 2.0 * drive.motor.max_current_A;
        const double radius =
            loop.radius_at({trip_speed_e_radps(drive), iq_A, mtpa_id_A(loop.motor, iq_A)});
        worst              = radius < 1.0 ? worst : std::max(1.0, radius);
        const double other = spec.rare_edges ? radius_with_others(loop, drive, at) : 0.0;
        worst              = other < 1.0 ? worst : std::max(other, worst);
        const double shaft = radius_with_shafts(drive, loop.gains);
        worst              = shaft < 1.0 ? worst : std::max(shaft, worst);
    }
    return worst;
}

CaseResult evaluate_case(const Drive &drive, const TuneSpec &spec, const RobustnessCase &c)
{
    const Loop           loop = loop_of(drive, c);
    const OperatingPoint at   = operating_point(loop.motor, spec.speed_e_radps,
                                                spec.load_before_Nm + 0.5 * spec.load_step_Nm);
    CaseResult           result;
    result.spectral_radius = worst_radius(loop, drive, c, at, spec);
    if (result.spectral_radius < 1.0) {
        const SampledModel m    = loop.at(at);
        const LoadStep     step = load_step(m, spec);
        result.dip_e_radps      = step.dip_e_radps;
        result.settling_time_s  = step.settling_time_s;
        result.voltage_V        = step.voltage_V;
        const Sensors  sensors  = sensors_of(drive, spec);
        const double   i2       = sensors.current_A * sensors.current_A;
        const MatrixXd P        = covariance(
                   m.A, m.B_noise, Eigen::Vector3d(i2, i2, sensors.angle_rad * sensors.angle_rad));
        const MatrixXd V = m.C_voltage * P * m.C_voltage.transpose();
        result.voltage_V += 3.0 * std::sqrt(V.trace());
        result.voltage_noise_V = std::sqrt(V(0, 0));
        result.peak            = spec.rare_edges && is_nominal(c) ? top_peak(loop, drive) : 0.0;
        result.shaft = is_nominal(c) ? shaft_step(drive, spec, loop.gains, at) : ShaftStep{};
        result.ripple_e_radps = 3.0 * std::sqrt(std::max(P(0, 0), 0.0));
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

Sensors sensors_of(const Drive &drive, const TuneSpec &spec)
{
    const double count_rad = 2.0 * pi * drive.motor.pole_pairs / (4.0 * drive.encoder.lines);
    return {std::hypot(spec.current_noise_A, spec.current_lsb_A / std::sqrt(12.0)),
            count_rad * spec.angle_error_cnt};
}

double written(double weight)
{
    return std::strtod(fmt::format("{:.3g}", weight).c_str(), nullptr);
}

Drive with_weights(Drive drive, const TuneSpec &spec, const Point &x)
{
    const double  ts        = control_period_s(drive);
    const Sensors sensors   = sensors_of(drive, spec);
    const double  t_voltage = written(1.0 / (spec.voltage_V * spec.voltage_V));
    // A sampled sensor with standard deviation s is white noise of density s^2 Ts.
    const double t_current = written(sensors.current_A * sensors.current_A * ts);
    const double t_angle   = written(sensors.angle_rad * sensors.angle_rad * ts);
    const auto   value     = [&x](Weight w, double unit) {
        return written(std::pow(10.0, x[static_cast<std::size_t>(w)]) * unit);
    };
    const double voltage = value(voltage_drift, 1.0);
    const double current = value(current_noise, 1.0);

    drive.nosc.T    = {t_voltage, t_voltage};
    drive.nosc.Q    = {value(speed_error, 1e3 * t_voltage), value(q_axis_error, 1e3 * t_voltage),
                       written(1.0 / (spec.d_axis_error_A * spec.d_axis_error_A))};
    drive.nodo.form = NodoForm::encoder;
    drive.nodo.T    = {t_current, t_current, t_angle};
    drive.nodo.Q    = {
           value(load_drift, 1.0), voltage, voltage, value(speed_noise, 1.0), current, current, 0.0};
    return drive;
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
