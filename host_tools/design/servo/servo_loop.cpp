// SPDX-License-Identifier: MIT
#include "design/servo/servo_loop.hpp"

#include "design/sampled_model.hpp"
#include "design/servo/dobc_design.hpp"

namespace sdre {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

VectorXd values(const float *x, Index n)
{
    return Eigen::Map<const Eigen::VectorXf>(x, n).cast<double>();
}

MatrixXd rows(const dobc_config_t &c)
{
    MatrixXd M(c.n_x, c.n_x);
    for (Index i = 0; i < c.n_x; i++) {
        M.row(i) = values(c.m[i], c.n_x).transpose();
    }
    return M;
}

/// State: speed error, current error, x^, voltage on its way.
BrokenLoop dobc_loop(const Motor &motor, const dobc_config_t &c, double ts_s)
{
    const ServoPlant p = servo_plant(motor);
    MatrixXd         A(2, 2);
    A << 0.0, motor.pole_pairs * p.b, 0.0, -p.a;
    const auto     plant = c2d(A, Eigen::Vector2d(0.0, -1.0 / p.L_H), ts_s);
    const Index    n     = c.n_x;
    const VectorXd g     = values(c.g, n);

    BrokenLoop loop;
    loop.ts_s            = ts_s;
    loop.c               = RowVectorXd::Zero(n + 3);
    loop.c(0)            = static_cast<double>(c.k_omega_Vs);
    loop.c.segment(2, n) = values(c.k_x, n).transpose();

    loop.A                       = MatrixXd::Zero(n + 3, n + 3);
    loop.A.topLeftCorner(2, 2)   = plant.Phi;
    loop.A.block(0, n + 2, 2, 1) = plant.Gamma;
    loop.A.block(2, 0, n, 2)     = g * plant.Phi.row(0);
    loop.A.block(2, 0, n, 1) -= g;
    loop.A.block(2, n + 2, n, 1) = g * plant.Gamma(0);
    loop.A.block(2, 2, n, n)     = rows(c);
    loop.A.block(2, 0, n, n + 3) += values(c.h, n) * loop.c; // EQ-DOBC-3 with its own voltage
    loop.A.row(n + 2) = loop.c;
    loop.B            = VectorXd::Unit(n + 3, n + 2);
    return loop;
}

/// State: plant (the first is minus the error), integral, error of the period before, voltage on its way.
BrokenLoop pid_loop(const Held<MatrixXd> &plant, const pid_law_config_t &c, double ts_s)
{
    const Index  n  = plant.Phi.rows();
    const double kp = static_cast<double>(c.kp);
    const double kd = static_cast<double>(c.kd_tick);

    BrokenLoop loop;
    loop.ts_s     = ts_s;
    loop.c        = RowVectorXd::Zero(n + 3);
    loop.c(0)     = -kp - kd;
    loop.c(n)     = 1.0;
    loop.c(n + 1) = -kd;

    loop.A                       = MatrixXd::Zero(n + 3, n + 3);
    loop.A.topLeftCorner(n, n)   = plant.Phi;
    loop.A.block(0, n + 2, n, 1) = plant.Gamma;
    loop.A(n, n)                 = 1.0;
    loop.A(n, 0)                 = -static_cast<double>(c.ki_per_tick);
    loop.A(n + 1, 0)             = -1.0;
    loop.A.row(n + 2)            = loop.c;
    loop.B                       = VectorXd::Unit(n + 3, n + 2);
    return loop;
}

} // namespace

BrokenLoop speed_loop(const Motor &m, const drive_config_t &config)
{
    const auto ts_s = static_cast<double>(config.ts_s);
    if (const auto *c = constants_of<law_dobc_config_t>(config)) {
        return dobc_loop(m, c->dobc, ts_s);
    }
    const double L = m.q_axis_inductance_H;
    MatrixXd     A(2, 2);
    A << -m.viscous_friction_Nms / m.inertia_kgm2, m.pole_pairs * servo_plant(m).b, //
        -m.pm_flux_Wb / L, -m.stator_resistance_Ohm / L;
    return pid_loop(c2d(A, Eigen::Vector2d(0.0, 1.0 / L), ts_s),
                    constants_of<law_pid_config_t>(config)->pid, ts_s);
}

BrokenLoop d_axis_loop(const Motor &m, const drive_config_t &config)
{
    const auto     ts_s = static_cast<double>(config.ts_s);
    const double   L    = m.d_axis_inductance_H;
    const MatrixXd A    = MatrixXd::Constant(1, 1, -m.stator_resistance_Ohm / L);
    const auto    *dobc = constants_of<law_dobc_config_t>(config);
    return pid_loop(c2d(A, VectorXd::Constant(1, 1.0 / L), ts_s),
                    dobc != nullptr ? dobc->id_pi : constants_of<law_pid_config_t>(config)->id_pi,
                    ts_s);
}

} // namespace sdre
