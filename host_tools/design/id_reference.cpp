// SPDX-License-Identifier: MIT
#include "design/id_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/parallel.hpp"
#include "design/design.hpp"

namespace sdre {
namespace {

constexpr double nearly =
    0.98; // chosen: of the largest q current; at the end itself the limit of iq acts
constexpr int bisections = 45; // of the current limit: 1e-13 of it

double number(float x)
{
    return static_cast<double>(x);
}

/// sqrt(k^2 + x) - k, without its cancellation.
double root_beyond_k(const IdReference &r, double x)
{
    const double k = number(r.c.mtpa_A);
    return x / (k + std::sqrt(k * k + x));
}

double accel_per_A(const IdReference &r, const ReducedParameters &l, double id_A)
{
    return std::max(l[1] + l[11] * id_A, number(r.c.l1_min));
}

constexpr double weakening_share = 0.965; // WEAKENING_SHARE of current_ref.c

/// EQ-CURRENT-REF-3, 4.
double id_weakening_A(const IdReference &r, const ReducedParameters &l, const IdInputs &in)
{
    const double iq_A = (l[2] * in.profile_e_radps - in.d_omega) / accel_per_A(r, l, in.id_A) +
                        in.iq_speed_A; // EQ-CURRENT-REF-1
    const double w  = in.omega_e_radps;
    const double g  = weakening_share * r.most_Aps / std::abs(w);
    const double y  = l[10] * (l[7] * in.id_A - in.d_d) / w;
    const double x  = (l[4] * in.iq_A - in.d_q) / w;
    const double dq = std::abs(iq_A - y);
    const double q_flux =
        dq > number(r.c.chord_from) * g
            ? -std::min(number(r.c.chord_slope) * (dq - g), 0.5 * root_beyond_k(r, 2.0 * g * g))
            : std::sqrt(g * g - dq * dq);
    return l[9] * (q_flux - l[5] - x);
}

double id_mtpa_A(const IdReference &r, double iq_A)
{
    const double square = iq_A * iq_A;
    return -(r.c.mtpa_exact ? root_beyond_k(r, square) : number(r.c.mtpa_half_1pA) * square);
}

/// EQ-CURRENT-REF-5: whether id weakens the flux.
bool weakens(const IdReference &r, const ReducedParameters &l, const IdInputs &in)
{
    return r.most_Aps < number(r.c.flux_A) * std::abs(in.omega_e_radps) &&
           id_weakening_A(r, l, in) < id_mtpa_A(r, in.iq_ref_A);
}

/// EQ-MOTOR-2 at rest: what voltages and load hold a motor, and what another model takes for disturbances.
IdInputs estimates(const TrueMotor &motor, const ReducedParameters &model, const OperatingPoint &at)
{
    const double          w = at.omega_e_radps;
    const Eigen::Vector2d v = motor.voltage_V(at);
    IdInputs              in;
    in.d_omega = model[2] * w - (model[1] + model[11] * at.id_A) * at.iq_A;
    in.d_q     = model[4] * at.iq_A + model[5] * w + model[10] * w * at.id_A - model[6] * v(0);
    in.d_d     = model[7] * at.id_A - model[9] * w * at.iq_A - model[8] * v(1);
    in.omega_e_radps   = w;
    in.iq_A            = at.iq_A;
    in.id_A            = at.id_A;
    in.iq_ref_A        = at.iq_A;
    in.profile_e_radps = w;
    return in;
}

/// EQ-NOSC-3 as a row of the estimated w, iq, id, theta.
Eigen::RowVector4d speed_current(const Eigen::MatrixXd &Lambda)
{
    const Eigen::Index first = has_angle(Lambda) ? 1 : 0;
    const double       k_iq  = Lambda(0, first + 1);
    Eigen::RowVector4d row   = Eigen::RowVector4d::Zero();
    row(0)                   = -Lambda(0, first) / k_iq;
    row(3)                   = first == 1 ? -Lambda(0, 0) / k_iq : 0.0;
    return row;
}

} // namespace

double id_target_A(const IdReference &r, const ReducedParameters &l, const IdInputs &in)
{
    const double most = number(r.c.current_max_A);
    const double id_A = weakens(r, l, in) ? id_weakening_A(r, l, in) : id_mtpa_A(r, in.iq_ref_A);
    return std::clamp(id_A, -most, number(r.c.id_rest_A));
}

SteadyState state_at(const TrueMotor &motor, const ReducedParameters &model,
                     const OperatingPoint &at)
{
    return {at, estimates(motor, model, at)};
}

SteadyState steady_state(const IdReference &r, const TrueMotor &motor,
                         const ReducedParameters &model, double omega_e_radps, double iq_A)
{
    double lo = -number(r.c.current_max_A);
    double hi = number(r.c.id_rest_A);
    for (int i = 0; i < bisections; i++) { // the target falls, or rises less than id itself
        const double   id_A = 0.5 * (lo + hi);
        const IdInputs in   = estimates(motor, model, {omega_e_radps, iq_A, id_A});
        (id_target_A(r, model, in) > id_A ? lo : hi) = id_A;
    }
    return state_at(motor, model, {omega_e_radps, iq_A, 0.5 * (lo + hi)});
}

double most_iq_A(const IdReference &r, const TrueMotor &motor, const ReducedParameters &l,
                 double omega_e_radps, double sign)
{
    constexpr int steps  = 100; // of the current limit
    const double  most   = number(r.c.current_max_A);
    const double  most_V = r.most_Aps / l[6];
    double        best   = 0.0;
    double        least  = 0.0;
    for (int i = 1; i <= steps; i++) {
        const double         iq_A = std::copysign(most * i / steps, sign);
        const double         id_A = steady_state(r, motor, l, omega_e_radps, iq_A).at.id_A;
        const OperatingPoint at{omega_e_radps, iq_A, id_A};
        const double         torque = std::abs(motor.acceleration(at));
        if (std::hypot(iq_A, id_A) <= most && torque > least &&
            motor.voltage_V(at).norm() <= most_V) {
            least = torque;
            best  = iq_A;
        }
    }
    return best;
}

IdReference id_reference(const Design &d, const current_ref_config_t &c)
{
    return {c, number(c.circle_ApVs) * d.drive.inverter.dc_link_V, control_period_s(d.drive)};
}

OperatingPoint loaded_point(const IdReference &r, const TrueMotor &motor,
                            const ReducedParameters &l, double omega_e_radps, double share)
{
    const double iq_A = nearly * std::abs(share) * most_iq_A(r, motor, l, omega_e_radps, share);
    return steady_state(r, motor, l, omega_e_radps, iq_A).at;
}

std::vector<OperatingPoint> plane_points(const IdReference &r, const TrueMotor &motor,
                                         const ReducedParameters &l, double top_e_radps,
                                         int per_side)
{
    const auto                  side = static_cast<std::size_t>(per_side);
    const double                half = 0.5 * (per_side - 1);
    std::vector<OperatingPoint> points(side * side);
    parallel_for(side, [&](std::size_t i) {
        const double w          = top_e_radps * static_cast<double>(i) / (2.0 * half);
        const double motoring   = nearly * most_iq_A(r, motor, l, w, 1.0);
        const double generating = nearly * most_iq_A(r, motor, l, w, -1.0);
        for (std::size_t j = 0; j < side; j++) {
            const double share   = (static_cast<double>(j) - half) / half;
            const double iq_A    = share * (share < 0.0 ? -generating : motoring);
            points[i * side + j] = steady_state(r, motor, l, w, iq_A).at;
        }
    });
    return points;
}

MovingReference moving_reference(const IdReference &r, const ReducedParameters &model,
                                 const Eigen::MatrixXd &Lambda, const SteadyState &s)
{
    const double most = number(r.c.current_max_A);
    const double w    = std::max(std::abs(s.at.omega_e_radps), 1.0);
    // The inputs stand in the order of the observer's states; theta is none.
    const std::array<double IdInputs::*, 6> states{&IdInputs::d_omega, &IdInputs::d_q,
                                                   &IdInputs::d_d,     &IdInputs::omega_e_radps,
                                                   &IdInputs::iq_A,    &IdInputs::id_A};
    const double                accel = at_rest(model)[1] * most; // without a magnet l1 alone is 0
    const std::array<double, 6> scale{accel, w * most, w * most, w, most, most};
    const auto                  slope = [&](double IdInputs::*input, double by, const auto &f) {
        IdInputs more = s.in;
        IdInputs less = s.in;
        more.*input += by;
        less.*input -= by;
        return (f(more) - f(less)) / (2.0 * by);
    };
    const auto       target = [&](const IdInputs &in) { return id_target_A(r, model, in); };
    constexpr double step =
        1e-6; // of the scale: rounding and curvature of the difference are alike

    MovingReference m;
    m.of_estimate = Eigen::RowVectorXd::Zero(7);
    for (std::size_t i = 0; i < states.size(); i++) {
        m.of_estimate(static_cast<Eigen::Index>(i)) = slope(states[i], step * scale[i], target);
    }
    m.of_estimate.rightCols(4) +=
        slope(&IdInputs::iq_speed_A, step * most, target) * speed_current(Lambda);
    m.of_iq_ref = slope(&IdInputs::iq_ref_A, step * most, target);
    m.filter    = number(weakens(r, model, s.in) ? r.c.weakening_per_period : r.c.mtpa_per_period);
    m.ts_s      = r.ts_s;
    return m;
}

} // namespace sdre
