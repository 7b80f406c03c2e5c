// SPDX-License-Identifier: MIT
#include "design/laws/near_optimal.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "design/certificate.hpp"
#include "design/machine_points.hpp"
#include "design/noc_shaft/shaft_design.hpp"
#include "design/sampled_model.hpp"
#include "design/sampled_observer.hpp"
#include "design/speed_form_model.hpp"
#include "design/trip_levels.hpp"
#include "linalg/covariance.hpp"

namespace sdre {
namespace {

// Chosen: eight periods. Long against the limit cycle that a shorter one lets through with wrong
// parameters, short against the speed loop (docs/errata.md, d/dt of the current references).
constexpr double mtpa_filter_periods = 8.0;
// Chosen: a motor with half the inertia is then stable in a speed run, and v_d is as noisy as below flux weakening. With 48 that
// motor is at the edge of stability, with 32 unstable. A load step takes 8 ms more than with 8.
constexpr double weakening_filter_periods = 64.0;
// Chosen: where the d current makes the flux. A slower one leaves the voltage to iq when the speed reverses, and the currents are
// lost. None of 200 reluctance motors within 30 % trips with 16; 8 do with 24, 33 with 32. With 8, v_d is twice as noisy.
constexpr double flux_filter_periods = 16.0;
// Chosen: see chord_slope(). More would need a slower filter, less takes more d current than the circle.
constexpr double most_slope = 3.0;
// Chosen: with 1 the chord would be the whole circle.
constexpr double least_slope = 1.05;
// Chosen: half the nominal l1, reached at e_id = l1 / (2 |l11|).
constexpr double smallest_l1_ratio = 0.5;
// Chosen: twice the torque of the motor, so that a motor with half the nominal inertia does not
// trip. A shaft that stops faster than this has an encoder that stands still (EQ-ANGLE-GATE-2).
constexpr double trip_torque_ratio = 2.0;
// Chosen: what one count off does to the estimate of the load, once and a half, beside the whole torque. With much inertia
// or few lines that is more than the torque again.
constexpr double trip_kick_ratio = 1.5;
// Two edges of a disc are off by this at most, and so is the way between them. A run starts with the speed of that way.
constexpr double start_error_cnt = 0.35;
// Chosen: of the rated speed.
constexpr double coarse_share = 0.5;
// Chosen: an encoder wrong by this much turns a tenth of the torque into flux.
constexpr double trip_angle_rad = 0.45;
// Chosen: 0.5 % of the torque stays for the feedback while the reference accelerates.
constexpr double torque_share = 0.995;
// A surface magnet motor has no saliency; this many amperes stand for its infinite k of EQ-CURRENT-REF-2.
constexpr double largest_mtpa_A = 1e6;
// A motor without a magnet has k = 0; this share of the limit leaves the curve where it is.
constexpr double least_mtpa_ratio = 1e-3;
// Chosen: below this share of the voltage circle by back-EMF, no current of the shipped motors needs flux weakening. It also keeps
// every division by the speed away from zero.
constexpr double weakening_speed_share = 0.25;
// Chosen: flux weakening is active from nine tenths of the speed at which the largest current needs
// the whole circle.
constexpr double weakening_current_share = weakening_speed_share / 0.9;
// Chosen: 0.5 % of the voltage circle, and what the hexagon holds outside it, stay free for transients.
constexpr double voltage_share = 0.995;

GainSeries solve_nosc(const ReducedParameters &l, const Drive &drive, Precision precision)
{
    if (drive.law == Law::noc_shaft) {
        return solve_shaft_controller(l, drive, precision);
    }
    const NoscSpec       &spec = drive.nosc;
    const Eigen::Vector2d T_inverse(1.0 / spec.T[0], 1.0 / spec.T[1]);
    const SdreProblem     problem = drive.law == Law::conventional_noc
                                        ? conventional_nosc_problem(l, spec)
                                        : nosc_problem(l, spec);
    return solve_gain_series(problem, T_inverse.asDiagonal() * nosc_input_matrix(l).transpose(),
                             Eigen::MatrixXd::Identity(3, 3), spec.order, precision);
}

GainSeries solve_nodo(const ReducedParameters &l, const Drive &drive, Precision precision)
{
    if (drive.law == Law::noc_shaft) {
        return solve_shaft_observer(l, drive);
    }
    const NodoSpec &spec = drive.nodo;
    if (spec.form == NodoForm::encoder) {
        return solve_encoder_form(l, spec, control_period_s(drive));
    }
    const Eigen::Vector3d T_inverse(1.0 / spec.T[0], 1.0 / spec.T[1], 1.0 / spec.T[2]);
    const Eigen::MatrixXd C = nodo_model(l, spec.form).C;
    return solve_gain_series(nodo_problem(l, spec), Eigen::MatrixXd::Identity(C.cols(), C.cols()),
                             C.transpose() * T_inverse.asDiagonal(), spec.order, precision);
}

/// On the MTPA curve at the current limit.
double largest_torque_Nm(const Motor &motor, const ReducedParameters &l)
{
    const double iq_A = largest_iq_A(motor, l);
    return torque_Nm(motor, mtpa_id_A(l, iq_A), iq_A);
}

/// Twice the speed error at which the feedback reaches the current limit for a speed error
/// (EQ-NOSC-3). A reference that is further ahead has no use, and arrives long before the speed.
double near_e_radps(const Design &d)
{
    const Eigen::MatrixXd &Lambda = d.nosc.gain[0];
    const double full = 2.0 * speed_current_ratio * d.drive.motor.max_current_A * Lambda(0, 1) /
                        std::max(Lambda(0, 0), 1e-9);
    return std::min(full, trip_speed_e_radps(d.drive));
}

/// The magnet, or what the largest current makes of the flux where that is far more: weakening begins at a share of it.
double weakening_flux_A(const Design &d)
{
    const double iq_A = largest_iq_A(d.drive.motor, d.l);
    const double d_A  = d.l[5] + d.l[10] * mtpa_id_A(d.l, iq_A);
    return std::max(d.l[5], weakening_current_share * std::hypot(iq_A, d_A));
}

/// The filter of id_ref has so many periods where id is not on the MTPA curve.
double weakening_periods(const Design &d)
{
    return weakening_flux_A(d) > d.l[5] ? flux_filter_periods : weakening_filter_periods;
}

/// Slope of the chord of EQ-CURRENT-REF-4 for which id_ref changes by at most most_slope times as much as the iq that it makes
/// room for. The resistive drop of id takes voltage from iq and steepens the circle.
double chord_slope(const Design &d)
{
    const double base = limit_point(d.drive).speed_e_radps;
    return std::max(most_slope / (1.0 + most_slope * d.l[7] / base), least_slope);
}

} // namespace

current_ref_config_t current_ref_constants(const Design &d, bool exact_mtpa)
{
    const bool   exact  = exact_mtpa && d.l[13] <= 0.0;
    const Motor &m      = d.drive.motor;
    const double ts     = control_period_s(d.drive);
    const double np     = m.pole_pairs;
    const double v_dc   = d.drive.inverter.dc_link_V;
    const double k      = mtpa_A(d.l);
    const double full_W = 1.5 * v_dc / std::sqrt(3.0) * m.max_current_A;

    current_ref_config_t c{};
    c.current_max_A               = single(m.max_current_A);
    c.iq_max_A                    = single(largest_iq_A(m, k, exact));
    c.mtpa_A                      = single(std::max(k, least_mtpa_ratio * m.max_current_A));
    c.mtpa_half_1pA               = single(0.5 / std::max(k, least_mtpa_ratio * m.max_current_A));
    c.mtpa_exact                  = exact;
    c.circle_ApVs                 = single(voltage_share * d.l[6] / std::sqrt(3.0));
    c.torque_share                = single(torque_share);
    c.near_e_radps                = single(near_e_radps(d));
    c.id_rest_A                   = single(d.l[0]);
    c.flux_A                      = single(weakening_flux_A(d) / weakening_speed_share);
    c.l1_min                      = single(smallest_l1_ratio * at_rest(d.l)[1]);
    c.mtpa_per_period             = single(1.0 / mtpa_filter_periods);
    c.weakening_per_period        = single(1.0 / weakening_periods(d));
    const double slope            = chord_slope(d);
    c.chord_from                  = single((slope * slope - 1.0) / (slope * slope + 1.0));
    c.chord_slope                 = single(slope);
    c.samples_1ps                 = single(1.0 / ts);
    c.regen_max_W_norm            = single(np * np / m.inertia_kgm2 * full_W); // EQ-CURRENT-REF-7
    const RegenerationLimit regen = regeneration_limit(d.drive);
    c.regen_start_V               = single(regen.start_V);
    c.regen_per_V                 = single(1.0 / (regen.end_V - regen.start_V));
    return c;
}

namespace {

std::string lambda_block(const nosc_gains_t &g)
{
    std::string terms;
    for (int n = 0; n <= g.order; n++) {
        terms += term_block(n, "omega_e_radps             iq_A             id_A", {"v_q", "v_d"},
                            g.lambda[n]);
    }
    return c_block("lambda", terms);
}

} // namespace

double mtpa_A(const ReducedParameters &l)
{
    const double k = l[12] > 0.0 ? l[12] : 0.5 * l[5] / std::max(1.0 - l[10], 1e-9);
    return std::min(k, largest_mtpa_A);
}

double largest_iq_A(const Motor &motor, const ReducedParameters &l)
{
    return largest_iq_A(motor, mtpa_A(l), l[13] <= 0.0);
}

// Exact: id = k/2 - sqrt(k^2/4 + max^2/2); second order:
// iq^2 + iq^4 / (2 k)^2 = max^2.
double largest_iq_A(const Motor &motor, double k, bool exact)
{
    const double i2 = motor.max_current_A * motor.max_current_A;
    if (exact) {
        const double id_A = -0.5 * i2 / (0.5 * k + std::sqrt(0.25 * k * k + 0.5 * i2));
        return std::sqrt(i2 - id_A * id_A);
    }
    return std::sqrt(2.0 * i2 / (1.0 + std::sqrt(1.0 + i2 / (k * k))));
}

std::vector<OperatingPoint> loaded_points(const Design &d, const IdReference &r)
{
    const TrueMotor             motor = true_motor(d.drive, d.drive.motor);
    const double                top   = static_cast<double>(d.config.speed_max_e_radps);
    std::vector<OperatingPoint> points;
    for (const double speed : {0.0, d.drive.motor.rated_speed_e_radps, top}) {
        for (const double share : {0.0, 1.0, -1.0}) {
            points.push_back(loaded_point(r, motor, d.l, speed, share));
        }
    }
    return points;
}

void solve_near_optimal(Design &d)
{
    d.nosc = solve_nosc(at_rest(d.l), d.drive, d.precision);
    if (d.drive.law != Law::noc_h) {
        d.nodo = solve_nodo(at_rest(d.l), d.drive, d.precision);
    }
    if (d.drive.position) {
        d.position = solve_position(at_rest(d.l), d.drive, d.precision);
    }
    certify(d);
}

LoopGains first_gains(const Design &d)
{
    Drive drive      = d.drive;
    drive.nosc.order = 0;
    return {solve_nosc(at_rest(d.l), drive, Precision::quick).gain[0],
            solve_nodo(at_rest(d.l), drive, Precision::quick).gain[0]};
}

const current_ref_config_t *current_references(const Design &d)
{
    if (const auto *c = constants_of<law_noc_config_t>(d.config)) {
        return &c->near_optimal.current_ref;
    }
    if (const auto *c = constants_of<law_noc_h_config_t>(d.config)) {
        return &c->near_optimal.current_ref;
    }
    if (const auto *c = constants_of<law_noc_iron_config_t>(d.config)) {
        return &c->near_optimal.current_ref;
    }
    if (const auto *c = constants_of<law_noc_shaft_config_t>(d.config)) {
        return &c->near_optimal.current_ref;
    }
    if (const auto *c = constants_of<law_noc_speed_config_t>(d.config)) {
        return &c->near_optimal.current_ref;
    }
    const auto *c = constants_of<law_conventional_config_t>(d.config);
    return c != nullptr ? &c->near_optimal.current_ref : nullptr;
}

near_optimal_config_t near_optimal_constants(const Design &d, bool exact_mtpa, bool nosc_series)
{
    near_optimal_config_t c{};
    c.current_ref         = current_ref_constants(d, exact_mtpa);
    c.nosc.order          = static_cast<int16_t>(nosc_series ? d.drive.nosc.order : 0);
    c.nosc.iq_error_max_A = single(d.certificate.nosc.series_range_A);
    c.nosc.iq_speed_max_A = single(speed_current_ratio * d.drive.motor.max_current_A);
    for (std::size_t n = 0; n <= static_cast<std::size_t>(c.nosc.order); n++) {
        copy_matrix(d.nosc.gain[n], c.nosc.lambda[n]);
    }
    const double k_w         = d.nosc.gain[0](0, 0);
    const double k_iq        = d.nosc.gain[0](0, 1);
    c.nosc.speed_A_per_radps = single(k_w > 0.0 ? k_w / k_iq : 0.0);
    c.nosc.speed_radps_per_A = single(k_w > 0.0 ? k_iq / k_w : 0.0);
    if (d.position) {
        c.position = position_constants(d);
    }
    return c;
}

encoder_form_limits_t encoder_limits(const Design &d)
{
    return {single(trip_angle_rad),
            single(trip_torque_ratio * d.l[3] * largest_torque_Nm(d.drive.motor, d.l))};
}

TripMargin disturbance_margin(const Design &d, const encoder_form_limits_t &limits,
                              const Eigen::MatrixXd &A, const Eigen::MatrixXd &B_noise,
                              double angle_weight)
{
    constexpr Eigen::Index d_omega  = 4;   // of EQ-CERT-3's state
    constexpr double       as_noise = 6.0; // chosen: once in two days of samples, if it is normal
    const double           ts       = control_period_s(d.drive);
    const Eigen::MatrixXd  P        = covariance(
                A, B_noise, Eigen::Vector3d(d.drive.nodo.T[0], d.drive.nodo.T[1], angle_weight) / ts);
    return {"disturbance of the speed [rad/s2]", static_cast<double>(limits.d_omega),
            d.l[3] * largest_torque_Nm(d.drive.motor, d.l) +
                as_noise * std::sqrt(P(d_omega, d_omega))};
}

encoder_form_gains_t sample_gains(const nodo_encoder_gains_t &g, const Drive &drive)
{
    const double ts_s = control_period_s(drive);
    const auto   gain = [&](int row) {
        return static_cast<float>(ts_s * static_cast<double>(g.gain[0][row][2]));
    };
    return {gain(6), gain(3), gain(0), static_cast<float>(count_e_rad(drive))};
}

/// Error of the speed between two edges. A coarse encoder has two counts in a period at a speed to run at. Just below it one
/// count comes alone, and its error is the largest.
double start_error_e_radps(const Drive &d)
{
    const double per_period = count_e_rad(d) / control_period_s(d);
    if (2.0 * per_period < coarse_share * d.motor.rated_speed_e_radps) {
        return start_error_cnt * per_period;
    }
    const double fastest = std::min(trip_speed_e_radps(d), 2.0 * per_period);
    return fastest * start_error_cnt / (1.0 - start_error_cnt);
}

float believed_d_omega(const encoder_form_limits_t &limits, const encoder_form_gains_t &gains,
                       const Drive &drive)
{
    const double ts_s   = control_period_s(drive);
    const double torque = static_cast<double>(limits.d_omega) / trip_torque_ratio;
    const double count  = static_cast<double>(gains.count_rad);
    const double kick   = static_cast<double>(gains.d_omega_1ps2) * count;
    const double pace = std::cbrt(static_cast<double>(gains.d_omega_1ps2) / ts_s); // of three poles
    const double start = 0.5 * pace * start_error_e_radps(drive);
    return std::max(limits.d_omega, single(torque + trip_kick_ratio * kick + start));
}

Eigen::MatrixXd learned_gains(const Design &d, const Motor &motor, Eigen::MatrixXd Lambda)
{
    const double ratio = std::clamp(motor.inertia_kgm2 / d.drive.motor.inertia_kgm2,
                                    double{INERTIA_LEAST}, double{INERTIA_MOST});
    const double gain  = static_cast<double>(inertia_gain(static_cast<float>(ratio)));
    Lambda.leftCols(2) *= d.harmonics ? std::min(gain, 1.0) : gain; // as law_noc_h.c
    return Lambda;
}

LoopGains encoder_form_gains(const Design &d, double iq_A, const Eigen::MatrixXd &Lambda)
{
    const double   range = d.certificate.nodo.series_range_A;
    const Schedule s{std::clamp(iq_A, -range, range)};
    return {Lambda, series_gain(d.nodo, s, series_order(d.nodo))};
}

SampledModel speed_form_at(const Design &d, const TrueMotor &motor, const OperatingPoint &at,
                           const Eigen::MatrixXd &Lambda, const MovingReference *moving)
{
    const double range = d.certificate.nodo.series_range_A;
    Schedule     s{std::clamp(at.iq_A, -range, range), std::clamp(at.id_A, -range, range)};
    s.resize(d.nodo.problem.dA.size()); // iq alone, or both currents
    const LoopGains gains{Lambda, series_gain(d.nodo, s, series_order(d.nodo))};
    return speed_form_model(motor, d.l, d.drive.nodo.form, gains, at, control_period_s(d.drive),
                            moving);
}

double worst_residual(const Design &d)
{
    const auto worst = [](const GainSeries &g) {
        return g.residuals.empty() ? 0.0
                                   : *std::max_element(g.residuals.begin(), g.residuals.end());
    };
    return std::max({worst(d.nosc), worst(d.nodo), d.harmonic_check.worst_residual});
}

std::string method_line(const std::string &method)
{
    return fmt::format(" * method     {}\n", method);
}

std::string residual_line(double worst)
{
    return fmt::format(" * checked    relative residuals <= {:.0e}\n", std::max(worst, 1e-16));
}

std::string controller_line(const SampledLoop &c)
{
    return fmt::format(" *            controller: slowest pole {:.0f} 1/s, sampled spectral radius "
                       "{:.3f}, |e_iq| <= {:g} A\n",
                       c.worst_pole_1ps, c.spectral_radius, c.range_A);
}

std::string observer_line(const SampledLoop &o)
{
    return fmt::format(" *            observer:   slowest pole {:.0f} 1/s, sampled spectral radius "
                       "{:.3f}, |iq| <= {:g} A\n",
                       o.worst_pole_1ps, o.spectral_radius, o.range_A);
}

Layout near_optimal_layout(const Design &d, const near_optimal_config_t &c)
{
    Layout layout{{"near_optimal.nosc.lambda", lambda_block(c.nosc)}};
    if (d.position) {
        const position_gains_t &p                   = c.position;
        layout["near_optimal.position.nosc.lambda"] = lambda_block(p.nosc);
        layout["near_optimal.position.theta"] = c_field("theta", c_list(p.theta, p.nosc.order + 1));
    } else {
        layout["near_optimal.position"] = "";
    }
    return layout;
}

std::string term_block(int n, const char *columns, const std::vector<std::string> &labels,
                       const float (*rows)[3])
{
    std::string s = fmt::format("/*             {} */\n", columns);
    for (const std::string &label : labels) {
        s += c_row(label, *rows++, 3);
    }
    return fmt::format("{{ /* n = {} */\n", n) + c_indented(s) + "},\n";
}

NoiseKnob observer_knob(const char *law)
{
    return {law,
            [](Drive &drive, double factor) {
                for (double &weight : drive.nodo.T) {
                    weight /= factor;
                }
            },
            [](const Drive &drive) {
                const auto &T = drive.nodo.T;
                return fmt::format("[nodo] T = [{:.4g} {:.4g} {:.4g}]", T[0], T[1], T[2]);
            }};
}

std::vector<std::string> nosc_mismatches(const near_optimal_config_t &c)
{
    return {fmt::format("NOSC_ORDER_MAX < {}", c.nosc.order), "NOSC_N_U != 2", "NOSC_N_E != 3"};
}

} // namespace sdre
