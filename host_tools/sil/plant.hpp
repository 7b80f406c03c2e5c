// SPDX-License-Identifier: MIT
/// The motor and its mechanics, in flux linkages and mechanical speed: written without looking at the
/// controller's reduced parameters, so that an error there cannot cancel here.
///
///     psi_d' = v_d - R i_d + w psi_q,   psi_q' = v_q - R i_q - w psi_d        EQ-PLANT-1
///     i_d = (psi_d - psi_m) / L_d,      i_q = psi_q / L_q
///     T = 1.5 n_p (psi_d i_q - psi_q i_d)                                      EQ-PLANT-2
///     J w_m' = T - B w_m - T_load,      theta' = w = n_p w_m                   EQ-PLANT-3
#pragma once

#include "drive_file.hpp"

namespace sdre {

struct RotorVector {
    double d = 0.0;
    double q = 0.0;
};

struct StatorVector {
    double alpha = 0.0;
    double beta  = 0.0;
};

/// Amplitude-invariant rotation by the electrical angle.
RotorVector  to_rotor(StatorVector v, double theta_e_rad);
StatorVector to_stator(RotorVector v, double theta_e_rad);

class Plant {
public:
    explicit Plant(const Motor &motor);

    /// Stops the currents; sets speed and angle.
    void reset(double omega_e_radps, double theta_e_rad = 0.0);
    /// Changes parameters in flight. Currents and speed are continuous.
    void set_motor(const Motor &motor);

    /// Advances by dt_s with the voltage constant in the stator frame (an inverter) in `substeps` RK4 steps.
    void step(StatorVector v_V, double load_Nm, double dt_s, int substeps);
    /// The same with the voltage constant in the rotor frame.
    void step(RotorVector v_V, double load_Nm, double dt_s, int substeps);

    RotorVector current_A() const;
    double      torque_Nm() const;
    double      omega_e_radps() const;
    double      theta_e_rad() const
    {
        return x_.theta_e;
    } ///< not wrapped

private:
    struct State {
        double psi_d   = 0.0;
        double psi_q   = 0.0;
        double omega_m = 0.0;
        double theta_e = 0.0;
    };

    template <typename Voltage>
    State derivative(const State &x, const Voltage &v, double load_Nm) const;
    template <typename Voltage>
    void        integrate(const Voltage &v, double load_Nm, double dt_s, int substeps);
    RotorVector current_of(const State &x) const;

    Motor motor_;
    State x_;
};

} // namespace sdre
