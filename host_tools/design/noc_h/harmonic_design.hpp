// SPDX-License-Identifier: MIT
/// The observer of noc_h: the encoder form with harmonics that turn with the angle, one Riccati and one Stein equation
/// per speed.
///
///     A(w, iq) = A_0 + (couplings at w) + blocks h w [0 -1; 1 0] - leak I, plus iq dA            EQ-HARMONIC-5
///     weights of a pair: Q min(1, (w / w_ref)^2) cos^2(pi / 2 h w Ts), none from h w Ts = 1 on     EQ-HARMONIC-6
///     T of the angle: the drive file's from eight counts per period on, at least count^2 / 12 Ts up to one     EQ-HARMONIC-8
///
/// At standstill every harmonic is a constant and cannot be separated from the others. Their
/// weights vanish there, and the leak keeps the Riccati equation solvable. A pair that rotates by
/// more than a radian per period is switched off with a faster leak.
#pragma once

#include <memory>
#include <vector>

#include "design/motor_model.hpp"
#include "drive/core_types.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

struct HarmonicNode {
    double          omega_e_radps = 0.0;
    Eigen::MatrixXd K0;             ///< n x 3, rows in the firmware's order
    Eigen::MatrixXd K1;             ///< per ampere of iq
    double          residual = 0.0; ///< the worse of the Riccati and the Stein equation's
};

struct HarmonicDesign {
    std::vector<HarmonicNode>              nodes; ///< first at standstill, last at the trip speed
    std::shared_ptr<nodo_harmonic_gains_t> table; ///< what the firmware gets
};

/// Pairs in the firmware's order.
std::vector<nodo_harmonic_order_t> harmonic_pairs(const Drive &drive);

/// The observer problem at a speed, states in the firmware's rows; d_w' is left out when it has no weight.
ObserverModel harmonic_model(const ReducedParameters &l, const Drive &drive, double omega_e_radps);

/// Diagonal of Q at a speed, EQ-HARMONIC-6.
Eigen::VectorXd harmonic_weights(const Drive &drive, double omega_e_radps);

/// T of the angle at a speed, EQ-HARMONIC-8.
double angle_weight(const Drive &drive, double omega_e_radps);

/// DesignError when an equation has no acceptable solution.
HarmonicDesign design_harmonics(const ReducedParameters &l, const Drive &drive,
                                double largest_speed_e_radps, double iq_max_A);

} // namespace sdre
