// SPDX-License-Identifier: MIT
#include "design/position.hpp"

#include <algorithm>
#include <cmath>

#include "design/laws/near_optimal.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;

// Chosen: half of the torque stays for load, friction and feedback.
constexpr double profile_torque_share = 0.5;
// Chosen: a quarter of the voltage circle turns the q current; the rest is the back-EMF's and the feedback's.
constexpr double profile_voltage_share = 0.25;
// Twice the error at the limit of the current for an error, as near_e_radps of the speed's
// reference.
constexpr double near_ratio = 2.0;

MatrixXd with_angle(const MatrixXd &of_three)
{
    MatrixXd out                = MatrixXd::Zero(4, 4);
    out.bottomRightCorner(3, 3) = of_three;
    return out;
}

position_profile_t fastest_profile(const Design &d)
{
    const Motor &m        = d.drive.motor;
    const double iq_A     = largest_iq_A(m, d.l);
    const double l1       = d.l[1] + d.l[11] * mtpa_id_A(d.l, iq_A);
    const double circle_V = d.drive.inverter.dc_link_V / std::sqrt(3.0);
    const double accel    = profile_torque_share * l1 * iq_A;
    return {d.config.speed_max_e_radps, single(accel), single(accel),
            single(profile_voltage_share * circle_V * d.l[6] * l1)};
}

} // namespace

MatrixXd position_input_matrix(const ReducedParameters &l)
{
    MatrixXd B      = MatrixXd::Zero(4, 2);
    B.bottomRows(3) = nosc_input_matrix(l);
    return B;
}

GainSeries solve_position(const ReducedParameters &l, const Drive &drive, Precision precision)
{
    const PositionSpec &p = *drive.position;
    NoscSpec            inner;
    inner.Q             = {p.Q[1], p.Q[2], p.Q[3]};
    inner.T             = p.T;
    SdreProblem problem = nosc_problem(l, inner);
    problem.A0          = with_angle(problem.A0);
    problem.A0(0, 1)    = 1.0;
    problem.dA[0]       = with_angle(problem.dA[0]);
    problem.G           = with_angle(problem.G);
    problem.Q           = with_angle(problem.Q);
    problem.Q(0, 0)     = p.Q[0];
    const Eigen::Vector2d T_inverse(1.0 / p.T[0], 1.0 / p.T[1]);
    return solve_gain_series(problem, T_inverse.asDiagonal() * position_input_matrix(l).transpose(),
                             MatrixXd::Identity(4, 4), drive.nosc.order, precision);
}

position_gains_t position_constants(const Design &d)
{
    const GainSeries &g = *d.position;
    const MatrixXd   &K = g.gain[0];
    position_gains_t  c{};
    c.nosc.order             = static_cast<int16_t>(d.drive.nosc.order);
    c.nosc.iq_error_max_A    = single(d.certificate.position->series_range_A);
    c.nosc.iq_speed_max_A    = single(speed_current_ratio * d.drive.motor.max_current_A);
    c.nosc.speed_A_per_radps = single(K(0, 1) / K(0, 2));
    c.nosc.speed_radps_per_A = single(K(0, 2) / K(0, 1));
    for (std::size_t n = 0; n < g.gain.size(); n++) {
        copy_matrix(g.gain[n].rightCols(3), c.nosc.lambda[n]);
        c.theta[n] = gain_entry(g.gain[n], n % 2 == 0 ? 0 : 1, 0);
    }
    c.speed_per_rad = single(K(0, 0) / K(0, 1));
    c.near_rad      = std::min(
             single(near_ratio * speed_current_ratio * d.drive.motor.max_current_A * K(0, 2) / K(0, 0)),
             BASE_PI);
    c.most = fastest_profile(d);
    return c;
}

std::vector<MatrixXd> feedback_gains(const Design &d)
{
    std::vector<MatrixXd> all{d.nosc.gain[0]};
    if (d.position) {
        all.push_back(d.position->gain[0]);
    }
    return all;
}

} // namespace sdre
