// SPDX-License-Identifier: MIT
/// The motor and its mechanics, in flux linkages and mechanical speed: written without looking at the
/// controller's reduced parameters, so that an error there cannot cancel here.
///
///     psi_d' = v_d - R i_d + w psi_q,   psi_q' = v_q - R i_q - w psi_d        EQ-PLANT-1
///     i_d = (psi_d - psi_m) / L_d,      i_q = psi_q / L_q
///     T = 1.5 n_p (psi_d i_q - psi_q i_d)                                      EQ-PLANT-2
///     J w_m' = T - B w_m - T_load,      theta' = w = n_p w_m                   EQ-PLANT-3
///
/// With MotorEffects also saturation, cogging and Coulomb friction. The friction holds a shaft at rest for as
/// long as it can: a step that takes the speed through zero ends at zero, and zero stays until the rest
/// of the torque exceeds it.
#pragma once

#include "drive/drive_file.hpp"
#include "sil/plant/load.hpp"
#include "sil/plant/motor_effects.hpp"
#include "sil/plant/vectors.hpp"

namespace sdre {

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
    /// Saturation, cogging, friction; the drifts are the caller's. Currents and speed are continuous. Only
    /// advance() knows them.
    void set_effects(const MotorEffects &effects);

    /// Advances by dt_s with the voltage constant in the stator frame (an inverter) in `substeps` RK4 steps.
    void step(StatorVector v_V, double load_Nm, double dt_s, int substeps);
    /// The same with the voltage constant in the rotor frame.
    void step(RotorVector v_V, double load_Nm, double dt_s, int substeps);

    /// One RK4 step with every effect, the voltage constant in the stator frame. As exact as step(), and
    /// quicker: within a step the angle moves so little that a short series rotates the voltage.
    void advance(StatorVector v_V, const ShaftLoad &load, double dt_s);

    RotorVector current_A() const;
    /// At this instant; meant for advance(), which keeps the angle's sine and cosine.
    PhaseVector phase_current_A() const;
    /// d/dt of the phase currents under a voltage.
    PhaseVector phase_current_rate_Aps(StatorVector v_V) const;
    /// Largest |i| at the end of any step or substep since the last reset_peak().
    double peak_current_A() const
    {
        return peak_A_;
    }
    void reset_peak();
    /// Takes sine and cosine from the library again. Call now and then, so that rounding does not pile up.
    void   align_angle();
    double torque_Nm() const;
    double omega_e_radps() const;
    double theta_e_rad() const
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
    template <bool with_effects> RotorVector current_at(const State &x) const;
    template <bool with_effects>
    State slope(const State &x, RotorVector v_V, double turned_rad, const ShaftLoad &load) const;
    template <bool with_effects>
    void   advance_with(RotorVector v_V, const ShaftLoad &load, double dt_s);
    double net_torque_Nm(const State &x, RotorVector i, const ShaftLoad &load) const;
    void   choose_friction(const ShaftLoad &load);
    void   note_peak(RotorVector i);
    void   set_current(RotorVector i);

    Motor        motor_;
    MotorEffects effects_;
    bool         with_effects_ = false;
    State        x_;
    RotorVector  i_;            ///< current_at(x_) after advance(): Newton's guess with saturation
    double       cos_    = 1.0; ///< of x_.theta_e, kept by advance() and reset()
    double       sin_    = 0.0;
    double       peak_A_ = 0.0;
    double       slide_  = 0.0; ///< direction of the sliding friction in this step: -1, 0 (held), 1
};

} // namespace sdre
