// SPDX-License-Identifier: MIT
/// Saturation and what drags on the shaft.
///
///     psi_d = psi_m + L_d(i) i_d,  psi_q = L_q(i) i_q,  L bilinear in the map  EQ-EFFECTS-1
///     or both fluxes of the drive file's map (drive/flux_map.hpp)              EQ-SATURATION-1
///     T_cogging = amplitude sin(order theta_m) + second sin(2 order theta_m + phase)   EQ-EFFECTS-2
///     F(w_m) = F_c + (F_s - F_c) exp(-(w_m / w_s)^2), against the motion       EQ-EFFECTS-3
///     psi_pm,d = psi_m (1 + (h5 + h7) cos 6 theta)                             EQ-EFFECTS-5
///     psi_pm,q = psi_m (h7 - h5) sin 6 theta,  T += 1.5 n_p i . d psi_pm / d theta
///     T_iron = (T_h sign(w_m) + k_e w_m) |psi|^2 / psi_m^2                     EQ-EFFECTS-6
///
/// h5 and h7 are the shares of cos 5 theta and cos 7 theta in a phase's flux. The voltage gets them
/// through psi, so that power balances. The iron losses brake the turning shaft. There are none at
/// standstill, from the ripple of the PWM, or in the currents.
///
/// Outside the map its edge value holds.
#pragma once

#include "sil/plant/vectors.hpp"
#include "sil/setup/board_settings.hpp"

namespace sdre {

/// Anything but drifts, which are the parameters' own.
bool any_effect(const MotorEffects &effects);

double cogging_Nm(const MotorEffects &effects, double theta_e_rad, int pole_pairs);

/// Dry friction at a speed, at least 0.
double friction_Nm(const MotorEffects &effects, double omega_m_radps);

/// The magnet's part of the flux linkages, and its slope over the electrical angle.
struct MagnetFlux {
    RotorVector flux_Wb;
    RotorVector slope_Wb;
};
MagnetFlux magnet_flux(const MotorEffects &effects, double pm_flux_Wb, double theta_e_rad);

/// A saturation map scaled by factors of L_d and L_q.
SaturationMap scaled(SaturationMap map, double ld_factor, double lq_factor);

/// Inductances at a current: {L_d, L_q}.
RotorVector inductance_H(const SaturationMap &map, RotorVector current_A);

/// The current that makes this flux linkage without the magnet's (EQ-EFFECTS-1 solved for i), from a guess.
RotorVector saturated_current_A(const SaturationMap &map, RotorVector flux_Wb, RotorVector guess_A);

/// The same with both fluxes of a map, without its magnet.
RotorVector saturated_current_A(const SaturatedMotor &motor, RotorVector flux_Wb,
                                RotorVector guess_A);

/// Temperature drift: the value after some time, never below a hundredth of the start.
double drifted(double value, double share_per_s, double time_s);

} // namespace sdre
