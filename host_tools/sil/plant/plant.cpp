// SPDX-License-Identifier: MIT
#include "sil/plant/plant.hpp"

#include <algorithm>
#include <cmath>

#include "sil/plant/rk4.hpp"

namespace sdre {
namespace {

// Directions of the phases in the stator's frame.
const std::array<StatorVector, 3> phase_axes{
    {{1.0, 0.0}, {-0.5, 0.5 * std::sqrt(3.0)}, {-0.5, -0.5 * std::sqrt(3.0)}}};

} // namespace

Plant::Plant(const Motor &motor) : motor_(motor), equations_(motor)
{
    reset(0.0);
}

void Plant::reset(double omega_e_radps, double theta_e_rad)
{
    x_       = {motor_.pm_flux_Wb, 0.0, omega_e_radps / motor_.pole_pairs, theta_e_rad};
    i_       = {};
    peak_A2_ = 0.0;
    align_angle();
}

void Plant::set_motor(const Motor &motor)
{
    motor_     = motor;
    equations_ = MotorEquations(motor);
    set_current(i_);
}

void Plant::set_effects(const MotorEffects &effects)
{
    effects_      = effects;
    with_effects_ = any_effect(effects);
    set_current(i_);
}

void Plant::set_current(RotorVector i)
{
    const RotorVector L = inductances_H(i);
    x_.psi_d            = motor_.pm_flux_Wb + L.d * i.d;
    x_.psi_q            = L.q * i.q;
    i_                  = i;
}

RotorVector Plant::inductances_H(RotorVector i) const
{
    return effects_.saturation
               ? inductance_H(*effects_.saturation, i)
               : RotorVector{motor_.d_axis_inductance_H, motor_.q_axis_inductance_H};
}

RotorVector Plant::current_at(const MotorState &x) const
{
    if (effects_.saturation) {
        return saturated_current_A(*effects_.saturation, {x.psi_d - motor_.pm_flux_Wb, x.psi_q},
                                   i_);
    }
    return equations_.current_A(x);
}

/// Everything on the motor's mass but dry friction.
double Plant::motor_side_Nm(const MotorState &x, RotorVector i, const ShaftLoad &load) const
{
    return equations_.shaft_Nm(x, i, load) - cogging_Nm(effects_, x.theta_e, motor_.pole_pairs);
}

/// Dry friction of motor and load.
double Plant::dry_Nm(const MotorState &x, const ShaftLoad &load) const
{
    return friction_Nm(effects_, x.omega_m) + load.brake_Nm;
}

template <typename State, typename Rate>
void Plant::integrate(State &x, double dt_s, const Rate &rate)
{
    const State gain = rk4_gain(x, dt_s, rate);
    x                = along(x, gain, 1.0);
    angle_           = turned(angle_, small_rotation(gain.theta_e));
}

template <typename Voltage>
void Plant::move_with_effects(const Voltage &voltage, const ShaftLoad &load, double dt_s)
{
    friction_.choose(x_.omega_m, motor_side_Nm(x_, i_, load), dry_Nm(x_, load));
    integrate(x_, dt_s, [&](const MotorState &x, double turned_rad) {
        const RotorVector i = current_at(x);
        return equations_.rate(x, i, voltage(turned_rad, x, i),
                               friction_.left_Nm(motor_side_Nm(x, i, load), dry_Nm(x, load)));
    });
    x_.omega_m = friction_.ended(x_.omega_m);
    i_         = current_at(x_);
}

/// voltage(turned_rad, x, i) is the voltage seen from the rotor once it has turned this far in the step.
template <typename Voltage>
void Plant::move(const Voltage &voltage, const ShaftLoad &load, double dt_s)
{
    if (with_effects_ || load.brake_Nm != 0.0) {
        move_with_effects(voltage, load, dt_s);
    } else {
        integrate(x_, dt_s, [&](const MotorState &x, double turned_rad) {
            const RotorVector i = equations_.current_A(x);
            return equations_.rate(x, i, voltage(turned_rad, x, i),
                                   equations_.shaft_Nm(x, i, load));
        });
        i_ = equations_.current_A(x_);
    }
    note_peak();
    path_.add(dt_s, x_.theta_e, omega_e_radps());
}

void Plant::advance(StatorVector v, const ShaftLoad &load, double dt_s)
{
    const RotorVector v_V = to_rotor(v, angle_); // at the start of the step
    move([v_V](double turned_rad, const MotorState &,
               RotorVector) { return seen_from(small_rotation(turned_rad), v_V.d, v_V.q); },
         load, dt_s);
}

void Plant::advance_floating(StatorVector v, std::size_t phase, const ShaftLoad &load, double dt_s)
{
    const RotorVector v_V  = to_rotor(v, angle_);
    const RotorVector axis = to_rotor(phase_axes[phase], angle_);
    move(
        [&](double turned_rad, const MotorState &x, RotorVector i) {
            const Rotation    turn = small_rotation(turned_rad);
            const RotorVector u    = seen_from(turn, axis.d, axis.q);
            const RotorVector w    = seen_from(turn, v_V.d, v_V.q);
            const double      more = 2.0 / 3.0 * floating_V(x, i, w, u);
            return RotorVector{w.d + more * u.d, w.q + more * u.q};
        },
        load, dt_s);
    clear_current(phase);
}

void Plant::coast(const ShaftLoad &load, double dt_s)
{
    move(
        [&](double, const MotorState &x, RotorVector) {
            const double w = equations_.omega_e_radps(x);
            return RotorVector{-w * x.psi_q, w * x.psi_d};
        },
        load, dt_s);
}

void Plant::clear_current(std::size_t phase)
{
    const RotorVector u    = to_rotor(phase_axes[phase], angle_);
    const double      rest = u.d * i_.d + u.q * i_.q;
    set_current({i_.d - rest * u.d, i_.q - rest * u.q});
}

void Plant::clear_current()
{
    set_current({});
}

void Plant::step(StatorVector v_V, double load_Nm, double dt_s, int substeps)
{
    align_angle();
    for (int n = 0; n < substeps; n++) {
        advance(v_V, {load_Nm}, dt_s / substeps);
    }
}

void Plant::step(RotorVector v_V, double load_Nm, double dt_s, int substeps)
{
    align_angle();
    for (int n = 0; n < substeps; n++) {
        move([v_V](double, const MotorState &, RotorVector) { return v_V; }, {load_Nm},
             dt_s / substeps);
    }
}

void Plant::note_peak()
{
    peak_A2_ = std::max(peak_A2_, i_.d * i_.d + i_.q * i_.q);
}

void Plant::reset_peak()
{
    peak_A2_ = 0.0;
    note_peak();
}

void Plant::align_angle()
{
    angle_ = rotation_by(x_.theta_e);
}

PhaseVector Plant::phase_current_rate_Aps(StatorVector v) const
{
    const RotorVector L    = inductances_H(i_);
    const RotorVector flux = equations_.flux_rate_V(x_, i_, to_rotor(v, angle_));
    const double      w    = omega_e_radps();
    // The rotor frame's own rotation comes in: d/dt (P i) = P (i' + w J i).
    return phases_of(to_stator({flux.d / L.d - w * i_.q, flux.q / L.q + w * i_.d}, angle_));
}

/// EQ-OPEN-1: u (L^-1 (v - R i + w ..) + w J i) = 0, solved for what the terminal adds to v.
double Plant::floating_V(const MotorState &x, RotorVector i, RotorVector v, RotorVector u) const
{
    const RotorVector L    = inductances_H(i);
    const RotorVector flux = equations_.flux_rate_V(x, i, v);
    const double      w    = equations_.omega_e_radps(x);
    const double      rate = u.d * (flux.d / L.d - w * i.q) + u.q * (flux.q / L.q + w * i.d);
    return -1.5 * rate / (u.d * u.d / L.d + u.q * u.q / L.q);
}

double Plant::floating_V(std::array<double, 3> others_V, std::size_t phase) const
{
    others_V[phase] = 0.0;
    return floating_V(x_, i_, to_rotor(clarke(others_V), angle_),
                      to_rotor(phase_axes[phase], angle_));
}

PhaseVector Plant::emf_V() const
{
    const double w = omega_e_radps();
    return phases_of(to_stator(RotorVector{-w * x_.psi_q, w * x_.psi_d}, angle_));
}

} // namespace sdre
