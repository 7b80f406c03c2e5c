// SPDX-License-Identifier: MIT
/// The numbers that are compared: they depend on the machine, and little on anything else.
#pragma once

#include <Eigen/Dense>

#include "sil/verify/rehearsal.hpp"

namespace sdre {

/// The equations with the drive file's values leave a rest of voltage and torque: its means over blocks. Then the noise
/// of steady signals, and how far steps pass their ends. The records have to be complete.
Eigen::VectorXd features_of(const Drive &drive, const Programme &programme, // EQ-VERIFY-2
                            const Records &records);

} // namespace sdre
