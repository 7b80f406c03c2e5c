// SPDX-License-Identifier: MIT
/// Current and times of the alignment (firmware/app/angle/app_align.h), so that the shaft of any motor comes to rest in time.
#pragma once

#include "drive/drive_file.hpp"

namespace sdre {

struct AlignDesign {
    double current_A       = 0.0;
    double bandwidth_radps = 0.0; ///< of the current along the vector; k_p brakes the swing
    double theta_e_rad     = 0.0; ///< of the rotor at rest
    double decay_1ps       = 0.0; ///< of the slowest mode
    double settle_s        = 0.0;
};

/// The rotor near a current vector I that stands, turned away from it by delta, across it i_q:
///
///     delta' = w
///     J w' = n_p T(I, i_q) - B w,  T = 1.5 n_p (flux + (L_d - L_q) I) i_q
///     L_q i_q' = -(R + k_p) (i_q + I delta) - w (flux + L_d I)                     EQ-BOARD-3
///
/// k_p = w_c L_d is taken where the slowest mode dies fastest.
AlignDesign align_design(const Drive &drive);

} // namespace sdre
