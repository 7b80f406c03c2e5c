// SPDX-License-Identifier: MIT
/// Plain field-oriented control from the core's parts: the yardstick for the cost of a tick.
///
/// i_d = 0, a PI for the speed, one PI per current axis with decoupling left out, back-calculated
/// anti-windup, space vector modulation. Single precision, like the core.
#pragma once

#include "core_types.hpp"
#include "drive_file.hpp"

namespace sdre {

struct PiFocGains {
    float ts_s;
    float speed_p; ///< A per rad/s
    float speed_i; ///< times Ts
    float d_p;     ///< V per A
    float d_i;     ///< times Ts
    float q_p;
    float q_i;
    float current_max_A;
};

struct PiFoc {
    PiFocGains gains{};
    float      speed_sum_A = 0.0F;
    float      d_sum_V     = 0.0F;
    float      q_sum_V     = 0.0F;
};

/// Pole cancellation for the currents at a tenth of the control rate's bandwidth, symmetric speed loop.
PiFoc make_pi_foc(const Drive &drive);

drive_output_t pi_foc_tick(PiFoc &c, const drive_sample_t &sample, const drive_command_t &command);

} // namespace sdre
