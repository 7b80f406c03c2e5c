// SPDX-License-Identifier: MIT
/// The motor's equations, in flux linkages and mechanical speed: written without looking at the controller's reduced
/// parameters, so that an error there cannot cancel here.
///
///     psi_d' = v_d - R i_d + w psi_q,   psi_q' = v_q - R i_q - w psi_d        EQ-PLANT-1
///     i_d = (psi_d - psi_m) / L_d,      i_q = psi_q / L_q
///     T = 1.5 n_p (psi_d i_q - psi_q i_d)                                      EQ-PLANT-2
///     J w_m' = T - B w_m - T_load,      theta' = w = n_p w_m                   EQ-PLANT-3
#pragma once

#include <cmath>

#include "drive/drive_file.hpp"
#include "sil/plant/load.hpp"
#include "sil/plant/vectors.hpp"

namespace sdre {

struct MotorState {
    double psi_d   = 0.0;
    double psi_q   = 0.0;
    double omega_m = 0.0;
    double theta_e = 0.0;
};

/// x + f rate
inline MotorState along(const MotorState &x, const MotorState &rate, double f)
{
    return {x.psi_d + f * rate.psi_d, x.psi_q + f * rate.psi_q, x.omega_m + f * rate.omega_m,
            x.theta_e + f * rate.theta_e};
}

class MotorEquations {
public:
    /// `inertia_share` of the motor's inertia is what its torque turns.
    explicit MotorEquations(const Motor &m, double inertia_share = 1.0)
        : pole_pairs_(m.pole_pairs), resistance_Ohm_(m.stator_resistance_Ohm),
          flux_Wb_(m.pm_flux_Wb), friction_Nms_(m.viscous_friction_Nms),
          per_ld_(1.0 / m.d_axis_inductance_H), per_lq_(1.0 / m.q_axis_inductance_H),
          per_inertia_(1.0 / (inertia_share * m.inertia_kgm2)), torque_factor_(1.5 * m.pole_pairs)
    {
    }

    double omega_e_radps(const MotorState &x) const
    {
        return pole_pairs_ * x.omega_m;
    }
    /// Without saturation.
    RotorVector current_A(const MotorState &x, RotorVector magnet_Wb) const
    {
        return {(x.psi_d - magnet_Wb.d) * per_ld_, (x.psi_q - magnet_Wb.q) * per_lq_};
    }
    /// The same of a magnet without harmonics.
    RotorVector current_A(const MotorState &x) const
    {
        return {(x.psi_d - flux_Wb_) * per_ld_, x.psi_q * per_lq_};
    }
    double torque_Nm(const MotorState &x, RotorVector i) const // EQ-PLANT-2
    {
        return torque_factor_ * (x.psi_d * i.q - x.psi_q * i.d);
    }
    /// Torque of a magnet whose flux changes with the angle.
    double slope_Nm(RotorVector slope_Wb, RotorVector i) const
    {
        return torque_factor_ * (slope_Wb.d * i.d + slope_Wb.q * i.q);
    }
    /// Torque on the shaft, without cogging and Coulomb friction.
    double shaft_Nm(const MotorState &x, RotorVector i, const ShaftLoad &load) const
    {
        const double fan = load.fan_Nm_per_radps2 * std::abs(x.omega_m);
        return torque_Nm(x, i) - (friction_Nms_ + fan) * x.omega_m - load.torque_Nm;
    }
    /// d/dt of the flux linkages.
    RotorVector flux_rate_V(const MotorState &x, RotorVector i, RotorVector v) const // EQ-PLANT-1
    {
        const double w = omega_e_radps(x);
        return {v.d - resistance_Ohm_ * i.d + w * x.psi_q,
                v.q - resistance_Ohm_ * i.q - w * x.psi_d};
    }
    MotorState rate(const MotorState &x, RotorVector i, RotorVector v,
                    double shaft_Nm) const // EQ-PLANT-3
    {
        const RotorVector flux = flux_rate_V(x, i, v);
        return {flux.d, flux.q, shaft_Nm * per_inertia_, omega_e_radps(x)};
    }

private:
    double pole_pairs_;
    double resistance_Ohm_;
    double flux_Wb_;
    double friction_Nms_;
    double per_ld_;
    double per_lq_;
    double per_inertia_;
    double torque_factor_;
};

} // namespace sdre
