// SPDX-License-Identifier: MIT
/// The programme that a drive runs to be compared with its simulation.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "drive/drive_file.hpp"

namespace sdre {

/// One record of the scope.
struct Shot {
    std::string name;
    double      from_e_radps   = 0.0;
    double      to_e_radps     = 0.0; ///< from_e_radps: recorded while the speed stays
    double      accel_e_radps2 = 0.0; ///< of the reference, both ways; 0: what the drive can
    /// Names of the scope: SPEED first, or IQ when the speed stays. The rest are currents and voltages.
    std::array<std::string, 4> signals;

    bool steady() const
    {
        return from_e_radps == to_e_radps;
    }
    /// The record begins `before` samples before the speed passes this [rad/s, electrical].
    double trigger_e_radps() const;
};

struct Programme {
    double            period_s     = 0.0; ///< of the samples: the control period
    int               samples      = 0;   ///< of a record
    int               before       = 0;   ///< of these, before the trigger
    double            settle_s     = 0.0; ///< wait at the speed where a shot begins
    double            way_e_radps2 = 0.0; ///< to there
    std::vector<Shot> shots;
};

/// The programme of a drive for a scope with so many samples. It needs a free shaft without load.
Programme verify_programme(const Drive &drive, int samples); // EQ-VERIFY-1

/// {"drive", "digest", "period_s", "samples", .., "shots": [..]}, for whoever runs it on a machine.
std::string programme_json(const Drive &drive, const Programme &programme);

} // namespace sdre
