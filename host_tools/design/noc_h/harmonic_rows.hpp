// SPDX-License-Identifier: MIT
/// States of noc_h's observer in the firmware's order (nodo_harmonic.h): eight, then two for every pair.
#pragma once

#include <Eigen/Core>

#include "drive/core_types.hpp"

namespace sdre::harmonic_rows {

enum Row : Eigen::Index { d_omega, d_q, d_d, omega, iq, id, theta, slope };

constexpr Eigen::Index n_base = NODO_HARMONIC_N_BASE;

} // namespace sdre::harmonic_rows
