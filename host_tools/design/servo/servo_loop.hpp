// SPDX-License-Identifier: MIT
/// Paper B's loops as they run: sampled, one period late, with the constants of the firmware.
///
/// Speed loop, broken at the motor's q voltage. DOBC: paper B's (5), which takes EQ-DOBC-1 for exact. PID: the whole q
/// axis with its back-EMF.
///
///     s(k+1) = A s(k) + B r(k),  u_q(k) = c s(k),  S(z) = 1 + c (zI - A)^-1 B             EQ-CERT-4
///
/// r is added to the voltage on its way to the motor; the observer does not see it.
#pragma once

#include <string>
#include <vector>

#include "drive/core_types.hpp"
#include "drive/drive_file.hpp"

#include <Eigen/Core>

namespace sdre {

/// A sampled loop and what to excite it with.
struct SampledServoLoop {
    Eigen::MatrixXd    A;
    Eigen::VectorXd    B;
    Eigen::RowVectorXd c;
    double             ts_s = 0.0;
};

SampledServoLoop speed_loop(const Motor &motor, const drive_config_t &config);
SampledServoLoop d_axis_loop(const Motor &motor, const drive_config_t &config);

/// |S| at a frequency below half the sampling rate.
double sensitivity(const SampledServoLoop &loop, double frequency_Hz);

struct SensitivityAt {
    std::string name;
    double      frequency_Hz = 0.0;
    double      value        = 0.0;
};

struct LoopCheck {
    double                     spectral_radius = 0.0;
    double                     peak            = 0.0; ///< M_s, the largest |S|
    double                     peak_Hz         = 0.0;
    std::vector<SensitivityAt> at; ///< the disturbances' frequencies
};

LoopCheck check_loop(const SampledServoLoop &loop, std::vector<SensitivityAt> disturbances);

/// Current sensors, dead time and the harmonics of the drive file, at its design speed (rated speed without one).
std::vector<SensitivityAt> disturbance_frequencies(const Drive &drive);

} // namespace sdre
