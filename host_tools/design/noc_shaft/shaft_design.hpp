// SPDX-License-Identifier: MIT
/// Both problems of noc_shaft, in which the load is behind a shaft of known resonance (EQ-SHAFT-1 to 5).
#pragma once

#include "design/series_error.hpp"
#include "design/shaft_model.hpp"

namespace sdre {

/// The states of noc_shaft's observer, in the firmware's order: those of the encoder form, then the load.
namespace shaft_rows {
enum Row : Eigen::Index { d_omega, d_q, d_d, omega, iq, id, theta, omega_load, twist, count };
} // namespace shaft_rows

/// The shaft that the control believes in.
Shaft believed_shaft(const Drive &drive);

/// w_r of a shaft [rad/s].
double resonance_radps(const Shaft &shaft);

/// Lambda in e_w, e_iq, e_id, the slip w_load - w and the twist: 2 x 5, scheduled by e_iq.
GainSeries solve_shaft_controller(const ReducedParameters &l, const Drive &drive,
                                  Precision precision);

/// The observer's model, n = 9.
ObserverModel shaft_observer_model(const ReducedParameters &l, const Shaft &shaft);

/// L = K / Ts of EQ-SHAFT-1 at standstill with its series of order 1, 9 x 3. DesignError as solve_encoder_form().
GainSeries solve_shaft_observer(const ReducedParameters &l, const Drive &drive);

/// [Phi Gamma Gamma_d] of EQ-SHAFT-2: rows w, w_load, twist, theta; columns w, w_load, twist, a, d_w.
Eigen::MatrixXd shaft_step(const ReducedParameters &l, const Shaft &shaft, double ts_s);

/// 1 / ((1 - s) w_r^2) of EQ-SHAFT-4.
double twist_per_accel(const Shaft &shaft);

} // namespace sdre
