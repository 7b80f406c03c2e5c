// SPDX-License-Identifier: MIT
#include "design/board/align_design.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/eigenvalues.hpp"

namespace sdre {
namespace {

constexpr double pi = 3.14159265358979323846;
// Chosen: half of the limit, which leaves the other half for what swings.
constexpr double current_share = 0.5;
// Chosen: a vector that turns slowly needs no faster loop than the slowest one that brakes well.
constexpr double slowest_radps = 5.0;
constexpr int    steps         = 60;
// The application's own bound.
constexpr double most_per_sample = 0.1;
// The decay from 3 degrees to 0.2 takes 2.7 time constants; the index corrects the rest. Chosen:
// three times that, for a rotor with three times the inertia.
constexpr double time_constants = 8.1;
// Chosen: the lower bound is for friction, the upper bound for the user's patience.
constexpr double shortest_s = 1.2;
constexpr double longest_s  = 20.0;

/// The axis that the vector pulls: the magnet's, or without a magnet that of the larger inductance.
struct Pull {
    double flux_Wb; ///< of the magnet along the vector
    double ld_H;    ///< along the vector
    double lq_H;    ///< across
    double theta_e; ///< of the d axis when the vector is at 0
    double current_A;
};

Pull pull_of(const Motor &m)
{
    const double most_A     = current_share * m.max_current_A;
    const double saliency_H = m.q_axis_inductance_H - m.d_axis_inductance_H;
    if (m.pm_flux_Wb <= 0.0) {
        return {0.0, m.q_axis_inductance_H, m.d_axis_inductance_H, 1.5 * pi, most_A};
    }
    // The hold flux I - (Lq - Ld) I^2 is stiffest at half of flux / (Lq - Ld).
    const double stiffest_A = saliency_H > 0.0 ? 0.5 * m.pm_flux_Wb / saliency_H : most_A;
    return {m.pm_flux_Wb, m.d_axis_inductance_H, m.q_axis_inductance_H, 0.0,
            std::min(most_A, stiffest_A)};
}

double decay_1ps(const Motor &m, const Pull &p, double current_A, double kp_VpA)
{
    const double n_p    = m.pole_pairs;
    const double torque = 1.5 * n_p * (p.flux_Wb + (p.ld_H - p.lq_H) * current_A); // per A of i_q
    const double r_Ohm  = m.stator_resistance_Ohm + kp_VpA;
    Eigen::MatrixXd A(3, 3);
    A << 0.0, 1.0, 0.0,                                                               //
        0.0, -m.viscous_friction_Nms / m.inertia_kgm2, n_p * torque / m.inertia_kgm2, //
        -r_Ohm * current_A / p.lq_H, -(p.flux_Wb + p.ld_H * current_A) / p.lq_H, -r_Ohm / p.lq_H;
    return -eigenvalues(A).real().maxCoeff();
}

} // namespace

AlignDesign align_design(const Drive &drive)
{
    const Motor &m = drive.motor;
    const Pull   p = pull_of(m);
    AlignDesign  d;
    d.current_A          = drive.board.align_current_A.value_or(p.current_A);
    d.theta_e_rad        = p.theta_e;
    const double fastest = most_per_sample / control_period_s(drive);
    for (int i = 0; i <= steps; i++) {
        const double w_radps =
            slowest_radps * std::pow(fastest / slowest_radps, static_cast<double>(i) / steps);
        const double decay = decay_1ps(m, p, d.current_A, w_radps * m.d_axis_inductance_H);
        if (decay > d.decay_1ps) {
            d.decay_1ps       = decay;
            d.bandwidth_radps = w_radps;
        }
    }
    d.settle_s = std::clamp(time_constants / std::max(d.decay_1ps, 1e-3), shortest_s, longest_s);
    return d;
}

} // namespace sdre
