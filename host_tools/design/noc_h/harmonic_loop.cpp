// SPDX-License-Identifier: MIT
#include "design/noc_h/harmonic_loop.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "design/noc_h/harmonic_rows.hpp"

namespace sdre {
namespace {

using namespace harmonic_rows;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr Index n_motor = 4; // w, iq, id, theta

Index first_row(int pair)
{
    return n_base + 2 * pair;
}

/// Turns every pair by half a period's angle.
MatrixXd half_turn(const nodo_harmonic_gains_t &t, double w, double ts)
{
    const Index n = n_base + 2 * t.n_pairs;
    MatrixXd    H = MatrixXd::Identity(n, n);
    for (int i = 0; i < t.n_pairs; i++) {
        const double phi = 0.5 * static_cast<double>(t.pair[i].order) * w * ts;
        const Index  a   = first_row(i);
        H.block(a, a, 2, 2) << std::cos(phi), -std::sin(phi), std::sin(phi), std::cos(phi);
    }
    return H;
}

/// The disturbance that the first element of a pair adds to.
Index target_row(nodo_harmonic_channel_t channel)
{
    return channel == NODO_HARMONIC_TORQUE      ? d_omega
           : channel == NODO_HARMONIC_VOLTAGE_Q ? d_q
                                                : d_d;
}

/// Adds the pairs of the chosen channels to the disturbances: 7 x n, the states of the encoder form.
MatrixXd collect(const nodo_harmonic_gains_t &t, const MatrixXd &turn, bool torque, bool voltage)
{
    const Index n = turn.rows();
    MatrixXd    E = MatrixXd::Identity(7, n);
    for (int i = 0; i < t.n_pairs; i++) {
        const nodo_harmonic_channel_t channel = t.pair[i].channel;
        const bool                    wanted  = channel == NODO_HARMONIC_TORQUE ? torque : voltage;
        if (channel != NODO_HARMONIC_SENSOR && wanted) {
            E.row(target_row(channel)) += turn.row(first_row(i));
        }
    }
    return E;
}

/// EQ-HARMONIC-2.
MatrixXd measured(const nodo_harmonic_gains_t &t)
{
    MatrixXd C = MatrixXd::Zero(3, n_base + 2 * t.n_pairs);
    C(0, iq) = C(1, id) = C(2, theta) = 1.0;
    for (int i = 0; i < t.n_pairs; i++) {
        if (t.pair[i].channel == NODO_HARMONIC_SENSOR) {
            C(0, first_row(i) + 1) = C(1, first_row(i)) = 1.0;
        }
    }
    return C;
}

/// EQ-HARMONIC-1, 4 without voltages: the pairs turn, the base sees them in the middle of the period.
MatrixXd predicted(const nodo_harmonic_gains_t &t, const MatrixXd &H, const MatrixXd &plain,
                   double w, double ts)
{
    const Index n       = H.rows();
    MatrixXd    P       = H * H;
    MatrixXd    to_base = collect(t, H, true, true);
    for (int i = 0; i < t.n_pairs; i++) {
        const double turn = std::abs(static_cast<double>(t.pair[i].order)) * w * ts;
        const bool   slow = turn < static_cast<double>(NODO_HARMONIC_TURN_MAX);
        P.middleRows(first_row(i), 2) *= static_cast<double>(slow ? t.keep : t.keep_fast);
    }
    to_base(d_omega, slope) += 0.5 * ts;
    P.topRows(7)      = plain * to_base;
    P.topRows(3)      = MatrixXd::Identity(3, n);
    P(d_omega, slope) = ts;
    return P;
}

/// The law on what it is shown: torques of the instant, voltages and d_w' of the middle of the next period.
LawRows shown_law(const ReducedParameters &l, const nodo_harmonic_gains_t &t, const MatrixXd &H,
                  const MatrixXd &Lambda, const OperatingPoint &at, const MovingReference *moving)
{
    const Index n     = H.rows();
    MatrixXd    shown = collect(t, MatrixXd::Identity(n, n), true, false);
    shown += collect(t, H, false, true) - MatrixXd::Identity(7, n);
    RowVectorXd d_dot = RowVectorXd::Zero(n);
    d_dot(slope)      = 1.0;
    for (int i = 0; i < t.n_pairs; i++) {
        if (t.pair[i].channel == NODO_HARMONIC_TORQUE) {
            d_dot -=
                static_cast<double>(t.pair[i].order) * at.omega_e_radps * H.row(first_row(i) + 1);
        }
    }
    LawRows law = encoder_form_law(l, Lambda, at, moving);
    law.F       = MatrixXd(law.F * shown);
    law.B_ref   = MatrixXd(law.B_ref * shown);
    law.F.row(0) -=
        d_dot / (l[6] * (l[1] + l[11] * at.id_A)); // EQ-CURRENT-REF-1 in EQ-FEEDFORWARD-1
    return law;
}

/// As in sampled_model(), theta - theta^ replaces theta. A position's law alone reads theta^;
/// otherwise it is left out. A slope that never changes is left out too.
HarmonicSampled in_angle_error(const HarmonicSampled &m, bool still, bool position)
{
    const Index hat       = n_motor + theta;
    MatrixXd    S         = MatrixXd::Identity(m.A.rows(), m.A.rows());
    MatrixXd    S_inverse = S;
    S(3, hat)             = -1.0;
    S_inverse(3, hat)     = 1.0;
    std::vector<Index> rows;
    for (Index i = 0; i < m.A.rows(); i++) {
        if ((i != hat || position) && !(still && i == n_motor + slope)) {
            rows.push_back(i);
        }
    }
    const MatrixXd full    = S * m.A * S_inverse;
    const MatrixXd noise   = S * m.B_noise;
    const auto     columns = Eigen::all;
    return {full(rows, rows), m.B_voltage(rows, columns), m.C_voltage(columns, rows),
            noise(rows, columns)};
}

} // namespace

MatrixXd harmonic_gain(const nodo_harmonic_gains_t &t, double w, double iq_A)
{
    const double last = t.n_nodes - 1;
    const double place =
        std::clamp(static_cast<double>(t.nodes_per_root) * std::sqrt(w), 0.0, last);
    const double below = std::min(std::floor(place), last - 1.0);
    const double share = place - below;
    const double s =
        std::clamp(iq_A, -static_cast<double>(t.iq_max_A), static_cast<double>(t.iq_max_A));
    const auto k = static_cast<std::size_t>(below);
    MatrixXd   L(n_base + 2 * t.n_pairs, 3);
    for (Index row = 0; row < L.rows(); row++) {
        for (Index j = 0; j < 3; j++) {
            const auto at = [&](std::size_t node) {
                return static_cast<double>(t.gain[row][node][j]) +
                       s * static_cast<double>(t.gain[row][node][j + 3]);
            };
            L(row, j) = (1.0 - share) * at(k) + share * at(k + 1);
        }
    }
    return L;
}

HarmonicObserver linear_harmonic_observer(const ReducedParameters     &l,
                                          const nodo_harmonic_gains_t &t, const MatrixXd &Lambda,
                                          const OperatingPoint &at, double ts,
                                          const MovingReference *moving)
{
    const MatrixXd          H     = half_turn(t, at.omega_e_radps, ts);
    const PredictedObserver plain = predicted_encoder_form(l, at, ts);
    MatrixXd                G     = MatrixXd::Zero(H.rows(), 2);
    G.topRows(7)                  = plain.G;
    return {measured(t), predicted(t, H, plain.P, at.omega_e_radps, ts), G,
            shown_law(l, t, H, Lambda, at, moving)};
}

HarmonicSampled sampled_harmonic_model(const TrueMotor &motor, const ReducedParameters &l,
                                       const nodo_harmonic_gains_t &t, const MatrixXd &Lambda,
                                       const OperatingPoint &at, double ts,
                                       const MovingReference *moving)
{
    const HarmonicObserver o     = linear_harmonic_observer(l, t, Lambda, at, ts, moving);
    const MatrixXd         K     = harmonic_gain(t, at.omega_e_radps, at.iq_A);
    const Held<MatrixXd>   held  = held_motor(motor, at, ts);
    const Index            n     = o.P.rows();
    const Index            n_ref = o.law.A_ref.rows();
    const Index            all   = n_motor + n + n_ref;
    const MatrixXd         PK    = o.P * K;

    MatrixXd A                              = MatrixXd::Zero(all, all);
    A.topLeftCorner(n_motor, n_motor)       = held.Phi;
    A.block(0, n_motor, n_motor, n)         = held.Gamma.leftCols(2) * o.law.F;
    A.topRightCorner(n_motor, n_ref)        = held.Gamma.leftCols(2) * o.law.F_ref;
    A.block(n_motor, 1, n, 3)               = PK; // y = [iq id theta]
    A.block(n_motor, n_motor, n, n)         = o.P - PK * o.C + o.G * o.law.F;
    A.block(n_motor, n_motor + n, n, n_ref) = o.G * o.law.F_ref;
    A.block(n_motor + n, n_motor, n_ref, n) = o.law.B_ref;
    A.bottomRightCorner(n_ref, n_ref)       = o.law.A_ref;

    HarmonicSampled m{A, MatrixXd::Zero(all, 2), MatrixXd(2, all), MatrixXd::Zero(all, 3)};
    m.B_voltage.topRows(n_motor) = held.Gamma.leftCols(2);
    m.C_voltage << MatrixXd::Zero(2, n_motor), o.law.F, o.law.F_ref;
    m.B_noise.middleRows(n_motor, n) = PK;
    return in_angle_error(m, K.row(slope).isZero(0.0), has_angle(Lambda));
}

} // namespace sdre
