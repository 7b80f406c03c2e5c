// SPDX-License-Identifier: MIT
/// Noise of a drive that holds a speed, in the steady part of a measure.
#pragma once

#include <optional>
#include <vector>

#include "drive/drive_file.hpp"
#include "sil/run/trace.hpp"

namespace sdre {

struct Effort {
    double vq_noise_V           = 0.0; ///< rms deviation from the mean
    double vd_noise_V           = 0.0;
    double vq_noise_percent     = 0.0; ///< vq_noise_V of the voltage circle's radius
    double iq_noise_A           = 0.0;
    double torque_noise_percent = 0.0; ///< rms deviation from the mean, of the rated torque
    /// Above 100 Hz (first-order high-pass), which is what one hears.
    double audible_torque_percent = 0.0; ///< rms, of the rated torque
    double audible_current_A      = 0.0; ///< rms of the vector (id, iq)
};

/// Rows from begin to end, one per control period.
Effort effort_of(Trace::const_iterator begin, Trace::const_iterator end, const Motor &motor,
                 double period_s);

/// dip / (n_p dT / J): the time in which a load step dT makes the dip without any answer. It has a
/// lower bound, because the sensor must show the step and the inverter must change the current.
/// None without a step at `begin`.
std::optional<double> equivalent_delay_s(Trace::const_iterator begin, Trace::const_iterator end,
                                         double load_before_Nm, double dip_e_radps,
                                         const Motor &motor);

} // namespace sdre
