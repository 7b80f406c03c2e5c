// SPDX-License-Identifier: MIT
#include "design/torque.hpp"

#include <algorithm>
#include <cmath>

#include "design/laws/near_optimal.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;

// Chosen: of an error in a period. The step of a reference is fed forward, so the feedback has only the errors of the model. With
// 0.3 a step of a tenth of the rated torque needs up to 0.95 ms in the noise of the sensors instead of 0.55. With 0.1 a motor with 0.8 of the
// inductance overshoots by 12 % instead of 11.
constexpr double share_per_period = 0.15;

// Chosen: of slowest_mode_s, the time constant of a free shaft with its load. Where the iron saturates, the torque grows a little with the
// speed. A shaft then runs away at 1 1/s and less, if no load is on it. That is an error of the torque, not one of the loop.
constexpr double load_share = 0.1;

double weight(double pole_1ps, double own_1ps, double per_V)
{
    const double beyond = std::max(pole_1ps * pole_1ps - own_1ps * own_1ps, 1e-12);
    return beyond / (per_V * per_V);
}

} // namespace

TorqueWeights torque_weights(const ReducedParameters &l, const Drive &drive)
{
    if (drive.torque && drive.torque->weights) {
        return *drive.torque->weights;
    }
    const double pole = share_per_period / control_period_s(drive);
    return {{weight(pole, l[4], l[6]), weight(pole, l[7], l[8])}, {1.0, 1.0}};
}

GainSeries solve_torque(const ReducedParameters &l, const Drive &drive, Precision precision)
{
    const TorqueWeights w = torque_weights(l, drive);
    SdreProblem         problem;
    problem.A0 = Eigen::Vector2d(-l[4], -l[7]).asDiagonal();
    problem.Q  = Eigen::Vector2d(w.Q[0], w.Q[1]).asDiagonal();
    problem.G  = Eigen::Vector2d(l[6] * l[6] / w.T[0], l[8] * l[8] / w.T[1]).asDiagonal();
    const MatrixXd to_gain = Eigen::Vector2d(l[6] / w.T[0], l[8] / w.T[1]).asDiagonal();
    return solve_gain_series(problem, to_gain, MatrixXd::Identity(2, 2), 0, precision);
}

torque_gains_t torque_constants(const Design &d)
{
    const MatrixXd &K    = d.torque->gain[0];
    const double    iq_A = largest_iq_A(d.drive.motor, d.l);
    return {single(K(0, 0)), single(K(1, 1)), single(mtpa_id_A(d.l, iq_A))};
}

std::vector<MatrixXd> torque_gains(const Design &d)
{
    if (!d.torque) {
        return {};
    }
    MatrixXd free     = MatrixXd::Zero(2, 3);
    free.rightCols(2) = d.torque->gain[0];
    MatrixXd limited  = d.nosc.gain[0];
    limited(0, 0) *= static_cast<double>(TORQUE_LIMIT_SHARE);
    return {limited, free};
}

Motor with_load_of_its_own(Motor motor)
{
    motor.viscous_friction_Nms =
        std::max(motor.viscous_friction_Nms, motor.inertia_kgm2 / (load_share * slowest_mode_s));
    return motor;
}

double shaft_mode(const Motor &motor, double ts_s)
{
    const Motor m = with_load_of_its_own(motor);
    return std::exp(-ts_s * m.viscous_friction_Nms / m.inertia_kgm2);
}

MovingReference still_reference(double ts_s)
{
    MovingReference r;
    r.of_estimate = Eigen::RowVectorXd::Zero(7);
    r.ts_s        = ts_s;
    r.torque      = true;
    return r;
}

} // namespace sdre
