// SPDX-License-Identifier: MIT
/// The sampled closed loop of noc_shaft, linearised at an operating point: EQ-CERT-3 with the plant of EQ-CERT-9.
#pragma once

#include "design/noc_shaft/shaft_design.hpp"

namespace sdre {

/// The firmware's prediction (EQ-SHAFT-2) and law (EQ-SHAFT-3, 4). Lambda is 2 x 5.
LinearObserver linear_shaft_observer(const ReducedParameters &l, const Shaft &shaft,
                                     const Eigen::MatrixXd &Lambda, const OperatingPoint &at,
                                     double ts_s, const MovingReference *moving = nullptr);

/// The loop of a design at a point with a motor and a shaft. State [w iq id (theta - theta^) | observer without theta^ |
/// references | w_load twist]; Lambda as feedback_gains() has it.
SampledModel sampled_shaft_model(const Design &design, const TrueMotor &motor, const Shaft &shaft,
                                 const OperatingPoint &at, const LoopGains &gains,
                                 const MovingReference *moving = nullptr);

} // namespace sdre
