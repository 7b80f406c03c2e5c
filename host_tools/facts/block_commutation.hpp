// SPDX-License-Identifier: MIT
/// Data sheets of motors that are meant for block commutation: dc current I through two of three phases, switched every 60
/// degrees. Its torque is that of the line's peak EMF, kt = E_line / w = sqrt 3 p flux, so that kt kv = 1 in SI units. A
/// sinusoidal current has kt = 1.5 p flux per ampere of its peak, less by the factor 2 / sqrt 3. With 2 / sqrt 3 I as its
/// peak it makes the same torque and the same heat: rms values of both are sqrt(2 / 3) I.
#pragma once

#include "facts/fact_keys.hpp"

namespace sdre {

/// Peak of the sinusoidal current that replaces a dc current of 1 A: 2 / sqrt 3.
double block_factor();

/// True when a torque constant that does not say rms or peak and a speed constant are of this kind.
bool is_block_commutated(const Facts &facts);

/// Peak flux of a phase from the torque constant of such a sheet.
double block_flux_Wb(double kt_Nm_per_A, double pole_pairs);

} // namespace sdre
