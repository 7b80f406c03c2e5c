// SPDX-License-Identifier: MIT
#include "design/noc_shaft/shaft_loop.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "design/design.hpp"

namespace sdre {
namespace {

using namespace shaft_rows;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

constexpr Index n_motor = 4; // w, iq, id, theta

/// Rows of the states and of v_q, v_d.
RowVectorXd unit(Index of)
{
    return RowVectorXd::Unit(count + 2, of);
}

/// The law on nine states from that of seven.
LawRows with_shaft(const LawRows &seven, const Shaft &shaft, const MatrixXd &Lambda)
{
    const double slip_V   = Lambda(0, 3);
    const double twist_V  = Lambda(0, 4);
    LawRows      law      = seven;
    law.F                 = MatrixXd::Zero(2, count);
    law.F.leftCols(7)     = seven.F;
    law.B_ref             = MatrixXd::Zero(seven.B_ref.rows(), count);
    law.B_ref.leftCols(7) = seven.B_ref;
    law.F(0, omega) += slip_V;
    law.F(0, omega_load) -= slip_V;
    law.F(0, twist) -= twist_V;
    law.F(0, d_omega) -= twist_V * twist_per_accel(shaft) / shaft.load_inertia_share;
    return law;
}

} // namespace

LinearObserver linear_shaft_observer(const ReducedParameters &l, const Shaft &shaft,
                                     const MatrixXd &Lambda, const OperatingPoint &at, double ts,
                                     const MovingReference *moving)
{
    const double   w    = at.omega_e_radps;
    const MatrixXd step = shaft_step(l, shaft, ts);
    const auto     rate = [&](const RowVectorXd &of_w, const RowVectorXd &q, const RowVectorXd &d) {
        const RowVectorXd iq_dot = unit(d_q) - l[4] * q - (l[5] + l[10] * at.id_A) * of_w -
                                   l[10] * w * d + l[6] * unit(count);
        const RowVectorXd id_dot =
            unit(d_d) - l[7] * d + l[9] * (w * q + at.iq_A * of_w) + l[8] * unit(count + 1);
        return std::pair(iq_dot, id_dot);
    };
    const auto [q0, d0]      = rate(unit(omega), unit(iq), unit(id));
    const RowVectorXd q      = unit(iq) + 0.5 * ts * q0;
    const RowVectorXd d      = unit(id) + 0.5 * ts * d0;
    const RowVectorXd torque = (l[1] + l[11] * at.id_A) * q + l[11] * at.iq_A * d;
    const auto        row    = [&](Index i) -> RowVectorXd {
        return step(i, 0) * unit(omega) + step(i, 1) * unit(omega_load) + step(i, 2) * unit(twist) +
               step(i, 3) * torque + step(i, 4) * unit(d_omega);
    };
    const auto [q1, d1] = rate(0.5 * (unit(omega) + row(0)), q, d);

    MatrixXd next        = MatrixXd::Identity(count, count + 2);
    next.row(omega)      = row(0);
    next.row(omega_load) = row(1);
    next.row(twist)      = row(2);
    next.row(theta) += row(3);
    next.row(iq) += ts * q1;
    next.row(id) += ts * d1;
    return {next.leftCols(count), next.rightCols(2), shaft_observer_model(l, shaft).C,
            with_shaft(encoder_form_law(l, Lambda.leftCols(3), at, moving), shaft, Lambda)};
}

SampledModel sampled_shaft_model(const Design &d, const TrueMotor &motor, const Shaft &shaft,
                                 const OperatingPoint &at, const LoopGains &gains,
                                 const MovingReference *moving)
{
    const double         ts = control_period_s(d.drive);
    const LinearObserver o =
        linear_shaft_observer(d.l, believed_shaft(d.drive), gains.Lambda, at, ts, moving);
    SampledModel       m = closed_loop(held_with_shaft(motor, at, ts, shaft), o, gains.L, false);
    std::vector<Index> order(static_cast<std::size_t>(m.A.rows())); // the load's states at the end
    std::iota(order.begin(), order.end(), Index{0});
    std::rotate(order.begin() + n_motor, order.begin() + n_motor + 2, order.end());
    const auto all = Eigen::all;
    m.A            = MatrixXd(m.A(order, order));
    m.b_load       = Eigen::VectorXd(m.b_load(order));
    m.B_noise      = MatrixXd(m.B_noise(order, all));
    m.C_voltage    = MatrixXd(m.C_voltage(all, order));
    m.B_voltage    = MatrixXd(m.B_voltage(order, all));
    return m;
}

} // namespace sdre
