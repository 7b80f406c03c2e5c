// SPDX-License-Identifier: MIT
#include "design/servo/servo_loop.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "design/sampled_model.hpp"
#include "design/servo/dobc_design.hpp"
#include "linalg/transfer_function.hpp"

namespace sdre {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

const double pi = std::acos(-1.0);

// Chosen: neighbouring points of the sweep are 0.4 % apart; the peak between them is searched for.
constexpr int    sweep_points   = 2000;
constexpr double sweep_from     = 1e-4; // of the sampling rate
constexpr int    peak_halvings  = 60;
constexpr double golden_section = 0.6180339887498949;

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
SampledServoLoop dobc_loop(const Motor &motor, const dobc_config_t &c, double ts_s)
{
    const ServoPlant p = servo_plant(motor);
    MatrixXd         A(2, 2);
    A << 0.0, motor.pole_pairs * p.b, 0.0, -p.a;
    const auto     plant = c2d(A, Eigen::Vector2d(0.0, -1.0 / p.L_H), ts_s);
    const Index    n     = c.n_x;
    const VectorXd g     = values(c.g, n);

    SampledServoLoop loop;
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
SampledServoLoop pid_loop(const Held<MatrixXd> &plant, const pid_law_config_t &c, double ts_s)
{
    const Index  n  = plant.Phi.rows();
    const double kp = static_cast<double>(c.kp);
    const double kd = static_cast<double>(c.kd_tick);

    SampledServoLoop loop;
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

double sensitivity(const TransferFunction &loop, double frequency_Hz, double ts_s) // EQ-CERT-4
{
    return std::abs(1.0 + loop.at(std::polar(1.0, 2.0 * pi * frequency_Hz * ts_s)));
}

} // namespace

SampledServoLoop speed_loop(const Motor &m, const drive_config_t &config)
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

SampledServoLoop d_axis_loop(const Motor &m, const drive_config_t &config)
{
    const auto     ts_s = static_cast<double>(config.ts_s);
    const double   L    = m.d_axis_inductance_H;
    const MatrixXd A    = MatrixXd::Constant(1, 1, -m.stator_resistance_Ohm / L);
    const auto    *dobc = constants_of<law_dobc_config_t>(config);
    return pid_loop(c2d(A, VectorXd::Constant(1, 1.0 / L), ts_s),
                    dobc != nullptr ? dobc->id_pi : constants_of<law_pid_config_t>(config)->id_pi,
                    ts_s);
}

double sensitivity(const SampledServoLoop &loop, double frequency_Hz)
{
    return sensitivity(TransferFunction(loop.A, loop.B, loop.c), frequency_Hz, loop.ts_s);
}

LoopCheck check_loop(const SampledServoLoop &loop, std::vector<SensitivityAt> disturbances)
{
    const double rate_Hz = 1.0 / loop.ts_s;
    const double step    = std::pow(0.5 / sweep_from, 1.0 / sweep_points);
    LoopCheck    out;

    const TransferFunction transfer(loop.A, loop.B, loop.c);
    const auto             at_Hz = [&](double f) { return sensitivity(transfer, f, loop.ts_s); };
    out.spectral_radius          = spectral_radius(loop.A);
    for (int i = 0; i <= sweep_points; i++) {
        const double f = rate_Hz * sweep_from * std::pow(step, i);
        const double s = at_Hz(f);
        if (s > out.peak) {
            out.peak    = s;
            out.peak_Hz = f;
        }
    }
    double lo = out.peak_Hz / step;
    double hi = std::min(out.peak_Hz * step, 0.5 * rate_Hz);
    for (int i = 0; i < peak_halvings; i++) {
        const double left  = hi - golden_section * (hi - lo);
        const double right = lo + golden_section * (hi - lo);
        const bool   lower = at_Hz(left) > at_Hz(right);
        lo                 = lower ? lo : left;
        hi                 = lower ? right : hi;
    }
    out.peak_Hz = 0.5 * (lo + hi);
    out.peak    = std::max(out.peak, at_Hz(out.peak_Hz));
    out.at      = std::move(disturbances);
    for (SensitivityAt &x : out.at) {
        x.value = at_Hz(x.frequency_Hz);
    }
    return out;
}

std::vector<SensitivityAt> disturbance_frequencies(const Drive &drive)
{
    const int    np      = drive.motor.pole_pairs;
    const double design  = drive.law == Law::noc_h ? drive.harmonics.weight_speed_e_radps
                                                   : drive.dobc.design_speed_e_radps;
    const double speed   = design > 0.0 ? design : drive.motor.rated_speed_e_radps;
    const double turn_Hz = speed / np / (2.0 * pi);
    std::vector<SensitivityAt> out{{"current sensor offset", np * turn_Hz, 0.0},
                                   {"current sensor gain", 2 * np * turn_Hz, 0.0},
                                   {"dead time", 6 * np * turn_Hz, 0.0}};
    std::vector<double>        per_turn = drive.dobc.harmonics_per_turn;
    for (const double multiple : drive.harmonics.cogging) {
        per_turn.push_back(multiple * drive.motor.slots);
    }
    for (const double order : per_turn) {
        if (std::abs(order - 6.0 * np) < 1e-9) {
            continue; // the dead time's
        }
        out.push_back({fmt::format("harmonic {:g}", order), order * turn_Hz, 0.0});
    }
    const double limit_Hz = 0.5 / control_period_s(drive);
    out.erase(std::remove_if(out.begin(), out.end(),
                             [&](const SensitivityAt &x) { return x.frequency_Hz >= limit_Hz; }),
              out.end());
    return out;
}

} // namespace sdre
