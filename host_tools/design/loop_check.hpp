// SPDX-License-Identifier: MIT
/// A sampled loop that is opened at one signal: its distance from instability, and its response to
/// disturbances.
///
///     s(k+1) = A s(k) + B r(k),  u(k) = c s(k),  S(z) = 1 + c (zI - A)^-1 B             EQ-CERT-4
///
/// A holds the closed loop; r is added to the signal u on its way.
#pragma once

#include <string>
#include <vector>

#include "drive/drive_file.hpp"

#include <Eigen/Core>

namespace sdre {

/// A sampled loop and what to excite it with.
struct BrokenLoop {
    Eigen::MatrixXd    A;
    Eigen::VectorXd    B;
    Eigen::RowVectorXd c;
    double             ts_s = 0.0;
    double             shaft_mode =
        0.0; ///< real eigenvalue that a free shaft has by its load; 0: the shaft is not free
};

/// A free shaft's own mode is left out while it stays within nine tenths of its distance to 1.
double spectral_radius(const BrokenLoop &loop);

/// |S| at a frequency below half the sampling rate; infinite, never NaN, when a number of the loop is not finite.
double sensitivity(const BrokenLoop &loop, double frequency_Hz);

struct SensitivityAt {
    std::string name;
    double      frequency_Hz = 0.0;
    double      value        = 0.0;
};

/// Infinite, never NaN, when a number of the loop is not finite.
struct LoopCheck {
    double                     spectral_radius = 0.0;
    double                     peak            = 0.0; ///< M_s, the largest |S|
    double                     peak_Hz         = 0.0;
    std::vector<SensitivityAt> at; ///< the disturbances' frequencies
};

/// The largest |S| of few frequencies: tells which of many loops is the worst.
double rough_peak(const BrokenLoop &loop);

LoopCheck check_loop(const BrokenLoop &loop, std::vector<SensitivityAt> disturbances);

/// Current sensors, dead time and the harmonics of the drive file, at its design speed (rated speed without one).
std::vector<SensitivityAt> disturbance_frequencies(const Drive &drive);

} // namespace sdre
