// SPDX-License-Identifier: MIT
/// The motor with its mechanics as a whole, step by step: the equations of motor_equations.hpp.
///
/// With MotorEffects also what motor_effects.hpp and two_mass.hpp say and dry friction (dry_friction.hpp), with or without
/// them a brake.
#pragma once

#include <array>
#include <cmath>

#include "drive/drive_file.hpp"
#include "sil/plant/dry_friction.hpp"
#include "sil/plant/load.hpp"
#include "sil/plant/motor_effects.hpp"
#include "sil/plant/motor_equations.hpp"
#include "sil/plant/rotation.hpp"
#include "sil/plant/shaft_path.hpp"
#include "sil/plant/two_mass.hpp"
#include "sil/plant/vectors.hpp"

namespace sdre {

class Plant {
public:
    explicit Plant(const Motor &motor);

    /// Stops the currents; sets speed and angle.
    void reset(double omega_e_radps, double theta_e_rad = 0.0);
    /// Changes parameters in flight. Currents and speed are continuous.
    void set_motor(const Motor &motor);
    /// Saturation, cogging, friction; the drifts are the caller's. Currents and speed are continuous.
    void set_effects(const MotorEffects &effects);

    /// One RK4 step with the voltage constant in the stator frame (an inverter). Within a step the angle moves so
    /// little that a short series rotates the voltage.
    void advance(StatorVector v_V, const ShaftLoad &load, double dt_s);
    /// The same with one phase (0 .. 2) without current: its terminal floats, and its v_V has no
    /// effect.
    void advance_floating(StatorVector v_V, std::size_t phase, const ShaftLoad &load, double dt_s);
    /// The same without any current.
    void coast(const ShaftLoad &load, double dt_s);
    /// Ends what is left of a current that has died out: of one phase, of all.
    void clear_current(std::size_t phase);
    void clear_current();
    /// Advances by dt_s in `substeps` of them.
    void step(StatorVector v_V, double load_Nm, double dt_s, int substeps);
    /// The same with the voltage constant in the rotor frame.
    void step(RotorVector v_V, double load_Nm, double dt_s, int substeps);

    RotorVector current_A() const
    {
        return i_;
    }
    PhaseVector phase_current_A() const
    {
        return phases_of(to_stator(i_, angle_));
    }
    /// d/dt of the phase currents under a voltage.
    PhaseVector phase_current_rate_Aps(StatorVector v_V) const;
    /// Where a floating terminal is, with the other two (0 in its own place) as given and no current in its phase.
    double floating_V(std::array<double, 3> others_V, std::size_t phase) const;
    /// Phase voltages of a motor whose terminals all float.
    PhaseVector emf_V() const;
    /// Largest |i| at the end of any step since the last reset_peak().
    double peak_current_A() const
    {
        return std::sqrt(peak_A2_);
    }
    void reset_peak();
    /// Angles and speeds since the path was last restarted.
    ShaftPath &path()
    {
        return path_;
    }
    /// Takes sine and cosine from the library again. Call now and then, so that rounding does not pile up.
    void   align_angle();
    double torque_Nm() const
    {
        return torque_Nm(x_, i_);
    }
    double omega_e_radps() const
    {
        return equations_.omega_e_radps(x_);
    }
    /// Mechanical speed of the load's mass.
    double omega_load_m_radps() const
    {
        return effects_.load_inertia_share != 0.0 ? x_.omega_load_m : x_.omega_m;
    }
    /// Motor ahead of load, mechanical.
    double twist_rad() const
    {
        return x_.twist_rad;
    }
    double theta_e_rad() const
    {
        return x_.theta_e;
    } ///< not wrapped

private:
    RotorVector current_at(const MotorState &x) const;
    double      motor_side_Nm(const MotorState &x, RotorVector i, const ShaftLoad &load) const;
    double      torque_Nm(const MotorState &x, RotorVector i) const;
    double      iron_share(const MotorState &x) const;
    double      dry_Nm(const MotorState &x) const;
    double      spring_Nm(const TwoMassState &x) const;
    double      load_side_Nm(const TwoMassState &x, const ShaftLoad &load) const;
    RotorVector emf_V(const MotorState &x) const;
    RotorVector current_flux_rate_V(const MotorState &x, RotorVector i, RotorVector v_V) const;
    template <typename State, typename Rate>
    void integrate(State &x, double dt_s, const Rate &rate);
    template <typename Voltage>
    void move_rigid(const Voltage &voltage, const ShaftLoad &load, double dt_s);
    template <typename Voltage>
    void move_two_masses(const Voltage &voltage, const ShaftLoad &load, double dt_s);
    template <typename Voltage>
    void        move(const Voltage &voltage, const ShaftLoad &load, double dt_s);
    bool        advance_by_series(RotorVector v_V, const ShaftLoad &load, double dt_s);
    void        end_step(double dt_s);
    RotorVector inductances_H(RotorVector i) const;
    RotorVector current_rate_Aps(RotorVector i, RotorVector flux_rate_V) const;
    double floating_V(const MotorState &x, RotorVector i, RotorVector v_V, RotorVector axis) const;
    void   renew();
    void   note_peak();
    void   set_current(RotorVector i);

    Motor          motor_;
    MotorEquations equations_;
    MotorEffects   effects_;
    bool           with_effects_ = false;
    TwoMassState   x_;     ///< the load's part with an elastic shaft only
    RotorVector    i_;     ///< of x_; Newton's guess with saturation
    Rotation       angle_; ///< by x_.theta_e
    ShaftPath      path_;
    double         peak_A2_ = 0.0;
    DryFriction    friction_; ///< of the motor
    DryFriction    brake_;    ///< of a load behind the shaft
};

} // namespace sdre
