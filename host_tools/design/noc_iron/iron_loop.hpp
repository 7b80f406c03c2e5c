// SPDX-License-Identifier: MIT
/// The whole loop of noc_iron at an operating point. The observer is EQ-IRON-1 linearised. The law acts on z = T x^: EQ-IRON-2
/// with the flux and the offset that move with the currents. As deviations from the point,
///
///     d_d of z = d_d^ + (offset w^ + w M id^) / D,   d_q of z = d_q^ - w M iq^ / Q,
///     d_w of z = d_w^ - c (offset + M id) id^                                                     EQ-IRON-5
#pragma once

#include "design/id_reference.hpp"
#include "design/sampled_model.hpp"

namespace sdre {

struct Design;

/// The controller believes this motor at a point: the tangent of noc_iron's table, or the constants of other laws.
ReducedParameters believed_motor(const Design &design, const OperatingPoint &at);

/// The references' constants in the units of that motor: the circle is l6 times a voltage.
IdReference believed_reference(IdReference r, const ReducedParameters &constants,
                               const ReducedParameters &believed);

/// EQ-CERT-6 of noc_iron; `gains` are those of the constants.
SampledModel sampled_iron_model(const Design &design, const TrueMotor &motor,
                                const OperatingPoint &at, const LoopGains &gains,
                                const MovingReference *moving = nullptr);

} // namespace sdre
