// SPDX-License-Identifier: MIT
/// The sampled closed loop of noc_h, linearised at an operating point, with the gains that the firmware interpolates.
#pragma once

#include "design/motor_model.hpp"
#include "design/sampled_model.hpp"
#include "drive/core_types.hpp"

namespace sdre {

/// The gain that the firmware interpolates at w >= 0, n x 3.
Eigen::MatrixXd harmonic_gain(const nodo_harmonic_gains_t &table, double omega_e_radps,
                              double iq_A);

/// EQ-CERT-3 with this observer: state [w iq id (theta - theta^) | observer without theta^].
struct HarmonicSampled {
    Eigen::MatrixXd A;
    Eigen::MatrixXd B_voltage; ///< per volt of v_q, v_d that the observer does not know
    Eigen::MatrixXd C_voltage; ///< the v_q, v_d in force
    Eigen::MatrixXd B_noise; ///< per ampere of iq, id and radian of angle error in the measurement
};

/// The observer's own half: x^-(k+1) = P (x^- + K (y - C x^-)) + G v, v by the law (deviations), rows as the firmware's.
struct HarmonicObserver {
    Eigen::MatrixXd C;   ///< 3 x n
    Eigen::MatrixXd P;   ///< n x n
    Eigen::MatrixXd G;   ///< n x 2
    LawRows         law; ///< on what nodo_harmonic_view_t shows it
};

HarmonicObserver linear_harmonic_observer(const ReducedParameters     &l,
                                          const nodo_harmonic_gains_t &table,
                                          const Eigen::MatrixXd &Lambda, const OperatingPoint &at,
                                          double ts_s, const MovingReference *moving = nullptr);

/// @param motor what the motor is, @param l what the controller believes.
HarmonicSampled sampled_harmonic_model(const TrueMotor &motor, const ReducedParameters &l,
                                       const nodo_harmonic_gains_t &table,
                                       const Eigen::MatrixXd &Lambda, const OperatingPoint &at,
                                       double ts_s, const MovingReference *moving = nullptr);

} // namespace sdre
