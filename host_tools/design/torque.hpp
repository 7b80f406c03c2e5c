// SPDX-License-Identifier: MIT
/// Near optimal control of a torque: the currents of the speed law's error system,
///
///     e' = diag(-l4, -l7) e + diag(l6, l8) u,   e = (iq, id) - reference      EQ-TORQUE-3
///
/// with weights of its own. The feed-forward takes the coupling by the speed, so nothing schedules the gain.
#pragma once

#include <vector>

#include "design/design.hpp"
#include "design/sampled_model.hpp"

namespace sdre {

/// Those of the drive file, or weights whose sampled loop takes a share of an error in each period.
TorqueWeights torque_weights(const ReducedParameters &l, const Drive &drive);

/// (k_q, k_d) on a diagonal.
GainSeries solve_torque(const ReducedParameters &l, const Drive &drive, Precision precision);

/// Constants of the firmware. Needs design.torque.
torque_gains_t torque_constants(const Design &design);

/// Ways in which the loop of a torque is closed, as Lambda of the speed law (2 x 3) for LoopGains. The first is that law's: the speed
/// limit acts. The second has zeros in its first column: the shaft is free.
std::vector<Eigen::MatrixXd> torque_gains(const Design &design);

/// Whether the limit acts.
inline bool is_limited(const Eigen::MatrixXd &Lambda)
{
    return Lambda(0, 0) > 0.0;
}

/// A free shaft loses its speed to the load. This one does so with a tenth of slowest_mode_s, which is that load's and not the law's.
Motor with_load_of_its_own(Motor motor);

/// Its eigenvalue in a control period, BrokenLoop::shaft_mode.
double shaft_mode(const Motor &motor, double ts_s);

/// References of a torque where id_ref stands still.
MovingReference still_reference(double ts_s);

} // namespace sdre
