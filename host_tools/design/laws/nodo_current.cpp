// SPDX-License-Identifier: MIT
#include "design/laws/nodo_current.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/c_text.hpp"
#include "design/sampled_model.hpp"
#include "linalg/sampled_riccati.hpp"

namespace sdre {
namespace {

using Eigen::MatrixXd;

constexpr int n = NODO_CURRENT_N_X;

// Chosen: what the voltage in force is wrong by counts as noise of the currents, seven times the converter's. With less
// the estimates follow a wrong resistance or flux, with more they are late.
constexpr double noise_variance_ratio = 50.0;
// Chosen: a load changes seven times less than the encoder's observer is ready for.
constexpr double load_variance_ratio = 1.0 / 14.0;
// Certified between the nodes too, and at so many currents either way.
// Chosen: an EMF that shows above most of the speeds only is no encoder.
constexpr double usable_share    = 0.7;
constexpr int    speeds_per_node = 4;
constexpr int    currents        = 4;

/// Errors of (d_w w iq id theta) in continuous time; a rotor ahead of its estimate sees the voltage turned back.
MatrixXd jacobian(const ReducedParameters &l, const OperatingPoint &at)
{
    const double vd_V   = (l[7] * at.id_A - l[9] * at.omega_e_radps * at.iq_A) / l[8];
    const double vq_V   = (l[4] * at.iq_A + (l[5] + l[10] * at.id_A) * at.omega_e_radps) / l[6];
    MatrixXd     A      = MatrixXd::Zero(n, n);
    A(1, 0)             = 1.0;
    A.block(1, 1, 3, 3) = motor_jacobian(l, at);
    A(2, 4)             = -l[6] * vd_V;
    A(3, 4)             = l[8] * vq_V;
    A(4, 1)             = 1.0;
    return A;
}

/// Measured less estimated currents in the frame of the estimated angle.
MatrixXd output(const OperatingPoint &at)
{
    MatrixXd C = MatrixXd::Zero(NODO_CURRENT_N_Y, n);
    C(0, 2)    = 1.0;
    C(1, 3)    = 1.0;
    C(0, 4)    = at.id_A;
    C(1, 4)    = -at.iq_A;
    return C;
}

SampledObserverGain solve_at(const ReducedParameters &l, const Drive &drive, double omega)
{
    const double     ts_s = control_period_s(drive);
    const auto      &q    = drive.nodo.Q;
    const MatrixXd   zero = MatrixXd::Zero(n, n);
    const Transition T    = transition(jacobian(l, {omega, 0.0, 0.0}), zero, ts_s);
    MatrixXd         Q    = zero;
    Q.diagonal() << q[0] * load_variance_ratio, q[3] * load_variance_ratio, q[4], q[5], 0.0;
    SampledObserverProblem p{T.Phi,
                             zero,
                             0.5 * ts_s * (T.Phi * Q * T.Phi.transpose() + Q),
                             zero,
                             output({omega, 0.0, 0.0}),
                             MatrixXd::Identity(NODO_CURRENT_N_Y, NODO_CURRENT_N_Y)};
    p.R *= noise_variance_ratio * drive.nodo.T[0] / ts_s;
    return solve_sampled_observer(p);
}

/// EQ-NODO-CURRENT-2, in double.
MatrixXd gain_at(const nodo_current_gains_t &g, double omega)
{
    const double place =
        static_cast<double>(g.nodes_per_root) * (std::sqrt(omega) - static_cast<double>(g.root));
    const int    node  = std::clamp(static_cast<int>(place), 0, NODO_CURRENT_NODES - 2);
    const double share = place - node;
    MatrixXd     K(n, NODO_CURRENT_N_Y);
    for (int row = 0; row < n; row++) {
        for (int column = 0; column < NODO_CURRENT_N_Y; column++) {
            K(row, column) = (1.0 - share) * static_cast<double>(g.gain[node][row][column]) +
                             share * static_cast<double>(g.gain[node + 1][row][column]);
        }
    }
    return K;
}

} // namespace

double nodo_current_radius(const nodo_current_gains_t &g, const ReducedParameters &motor,
                           const OperatingPoint &at, double ts_s)
{
    const MatrixXd zero = MatrixXd::Zero(n, n);
    MatrixXd       K    = gain_at(g, at.omega_e_radps);
    const MatrixXd turn = K.row(4); // EQ-NODO-CURRENT-1
    K.row(2) -= at.id_A * turn;
    K.row(3) += at.iq_A * turn;
    const MatrixXd F = transition(jacobian(motor, at), zero, ts_s).Phi *
                       (MatrixXd::Identity(n, n) - K * output(at));
    return spectral_radius(F);
}

namespace {

/// Beyond the trip speed it is never asked: a lost encoder trips.
CurrentObserver none(double trip_e_radps)
{
    CurrentObserver d;
    d.gains.from_e_radps   = static_cast<float>(2.0 * trip_e_radps);
    d.gains.root           = std::sqrt(d.gains.from_e_radps);
    d.gains.nodes_per_root = 1.0F;
    return d;
}

} // namespace

CurrentObserver design_nodo_current(const ReducedParameters &l, const Drive &drive,
                                    double trip_e_radps)
{
    const Motor    &m = drive.motor;
    CurrentObserver d;
    // The EMF is then the voltage that the largest current loses in the resistance.
    const double from = m.stator_resistance_Ohm * m.max_current_A / m.pm_flux_Wb;
    if (!(from < usable_share * trip_e_radps)) {
        return none(trip_e_radps);
    }
    const double root      = std::sqrt(from);
    const double step      = (std::sqrt(trip_e_radps) - root) / (NODO_CURRENT_NODES - 1);
    d.gains.from_e_radps   = static_cast<float>(from);
    d.gains.root           = static_cast<float>(root);
    d.gains.nodes_per_root = static_cast<float>(1.0 / step);
    for (int node = 0; node < NODO_CURRENT_NODES; node++) {
        const double              at = root + node * step;
        const SampledObserverGain k  = solve_at(l, drive, at * at);
        d.worst_residual             = std::max(d.worst_residual, k.riccati_residual);
        for (int row = 0; row < n; row++) {
            for (int column = 0; column < NODO_CURRENT_N_Y; column++) {
                d.gains.gain[node][row][column] = static_cast<float>(k.K0(row, column));
            }
        }
    }
    for (int i = 0; i <= speeds_per_node * (NODO_CURRENT_NODES - 1); i++) {
        const double at = root + i * step / speeds_per_node;
        for (int k = -currents; k <= currents; k++) {
            const double iq   = m.max_current_A * k / currents;
            d.spectral_radius = std::max(
                d.spectral_radius, nodo_current_radius(d.gains, l, {at * at, iq, mtpa_id_A(l, iq)},
                                                       control_period_s(drive)));
        }
    }
    // The EMF of a weak magnet has little information on the angle beside the inductances'.
    const bool weak_magnet = l[0] < 0.0;
    return weak_magnet && !(d.spectral_radius < 1.0) ? none(trip_e_radps) : d;
}

std::string nodo_current_block(const nodo_current_gains_t &g)
{
    static const char *const labels[n] = {"d_w", "w", "iq", "id", "theta"};
    std::string              nodes;
    for (int node = 0; node < NODO_CURRENT_NODES; node++) {
        const double root =
            static_cast<double>(g.root) + node / static_cast<double>(g.nodes_per_root);
        std::string rows;
        for (int row = 0; row < n; row++) {
            rows += c_row(labels[row], g.gain[node][row], NODO_CURRENT_N_Y);
        }
        nodes += fmt::format("{{ /* {:.1f} rad/s: iq_A, id_A */\n", root * root) +
                 c_indented(rows) + "},\n";
    }
    return c_block("gain", nodes);
}

} // namespace sdre
