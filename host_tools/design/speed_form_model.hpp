// SPDX-License-Identifier: MIT
/// The sampled closed loop of the laws that measure the speed: noc in its speed form and the conventional law (EQ-CERT-7).
/// The feedback takes the measured w, iq, id and theta; only the disturbances are the observer's. The state is
/// [w iq id theta | d_w^ d_q^ d_d^ w^ iq^ id^ | v_q v_d], a moving d-current reference adds [id_ref iq_ref]. A speed law has no
/// theta, a conventional observer of the load alone no d_q^ and d_d^: n = 9 to 14.
#pragma once

#include "design/sampled_model.hpp"

namespace sdre {

/// @param motor what the motor is, @param model what the controller believes.
/// @param gains Lambda as in LoopGains, L 6 x 3, of the load alone 4 x 3.
/// @param form speed, conventional_load or conventional_all.
/// @return without B_noise: the speed's noise is another than that of an angle.
SampledModel speed_form_model(const TrueMotor &motor, const ReducedParameters &model, NodoForm form,
                              const LoopGains &gains, const OperatingPoint &at, double ts_s,
                              const MovingReference *moving = nullptr);

} // namespace sdre
