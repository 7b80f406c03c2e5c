// SPDX-License-Identifier: MIT
/// Observers that are designed for their sampled correction: the laws noc and noc_h.
///
///     Phi = e^(A Ts),  Q_s = Ts/2 (Phi Q Phi' + Q),  R = T / Ts,  then EQ-DARE-1, 2        EQ-SAMPLED-OBSERVER-1
///
/// A gain of the continuous equation that is stepped with Ts L corrects past the measurement when Ts L is above one.
#pragma once

#include "design/motor_model.hpp"
#include "design/series_error.hpp"
#include "linalg/sampled_riccati.hpp"

namespace sdre {

/// Discretised exactly, process noise as the mean of both ends of the period.
///
/// @param A n x n, @param dA its derivative by iq, @param C m x n, @param Q n weights of the states,
/// @param T m variances of a measurement times the period.
SampledObserverProblem sampled_observer(const Eigen::MatrixXd &A, const Eigen::MatrixXd &dA,
                                        const Eigen::MatrixXd &C, const Eigen::VectorXd &Q,
                                        const Eigen::VectorXd &T, double ts_s);

/// The poles of the estimation error as those of a continuous system [1/s].
Eigen::VectorXcd encoder_form_poles(const ObserverModel &model, const Eigen::MatrixXd &L,
                                    double iq_A, double ts_s);

/// L = K / Ts of the encoder form at standstill, with its series in iq of order 0 or 1. The motor
/// is its own mirror image there. DesignError when an equation has no acceptable solution.
GainSeries solve_encoder_form(const ReducedParameters &l, const NodoSpec &spec, double ts_s);

} // namespace sdre
