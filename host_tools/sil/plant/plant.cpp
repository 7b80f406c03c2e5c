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
    with_effects_ = effects.saturation || effects.cogging_amplitude_Nm != 0.0 ||
                    effects.coulomb_friction_Nm != 0.0;
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

template <bool with_effects> RotorVector Plant::current_at(const MotorState &x) const
{
    if constexpr (with_effects) {
        if (effects_.saturation) {
            return saturated_current_A(*effects_.saturation, {x.psi_d - motor_.pm_flux_Wb, x.psi_q},
                                       i_);
        }
    }
    return equations_.current_A(x);
}

double Plant::cogging_Nm(double theta_e_rad) const // EQ-EFFECTS-2
{
    if (effects_.cogging_amplitude_Nm == 0.0) {
        return 0.0;
    }
    const double angle  = effects_.cogging_order * theta_e_rad / motor_.pole_pairs;
    double       torque = effects_.cogging_amplitude_Nm * std::sin(angle);
    if (effects_.cogging_second_Nm != 0.0) {
        torque += effects_.cogging_second_Nm * std::sin(2.0 * angle + effects_.cogging_second_rad);
    }
    return torque;
}

/// Everything on the shaft but Coulomb friction.
template <bool with_effects>
double Plant::shaft_Nm(const MotorState &x, RotorVector i, const ShaftLoad &load) const
{
    const double torque = equations_.shaft_Nm(x, i, load);
    if constexpr (with_effects) {
        return torque - cogging_Nm(x.theta_e);
    }
    return torque;
}

/// voltage(turned_rad, x, i) is the voltage seen from the rotor once it has turned this far in the step.
template <bool with_effects, typename Voltage>
void Plant::move(const Voltage &voltage, const ShaftLoad &load, double dt_s)
{
    const double     friction_Nm = with_effects ? effects_.coulomb_friction_Nm : 0.0;
    const MotorState gain        = rk4_gain(x_, dt_s, [&](const MotorState &x, double turned_rad) {
        const RotorVector i      = current_at<with_effects>(x);
        double            torque = shaft_Nm<with_effects>(x, i, load);
        if (with_effects && friction_Nm != 0.0) {
            torque = slide_ != 0.0 ? torque - slide_ * friction_Nm : 0.0;
        }
        return equations_.rate(x, i, voltage(turned_rad, x, i), torque);
    });
    x_                           = along(x_, gain, 1.0);
    angle_                       = turned(angle_, small_rotation(gain.theta_e));
}

template <typename Voltage>
void Plant::move(const Voltage &voltage, const ShaftLoad &load, double dt_s)
{
    if (!with_effects_) {
        move<false>(voltage, load, dt_s);
        i_ = current_at<false>(x_);
    } else {
        choose_friction(load);
        move<true>(voltage, load, dt_s);
        if (effects_.coulomb_friction_Nm != 0.0 && slide_ * x_.omega_m < 0.0) {
            x_.omega_m = 0.0;
        }
        i_ = current_at<true>(x_);
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
        advance(v_V, {load_Nm, 0.0}, dt_s / substeps);
    }
}

void Plant::step(RotorVector v_V, double load_Nm, double dt_s, int substeps)
{
    align_angle();
    for (int n = 0; n < substeps; n++) {
        move([v_V](double, const MotorState &, RotorVector) { return v_V; }, {load_Nm, 0.0},
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

/// Sliding friction opposes the speed; at rest the friction either holds or opposes the torque.
void Plant::choose_friction(const ShaftLoad &load)
{
    const double torque = shaft_Nm<true>(x_, i_, load);
    if (x_.omega_m != 0.0) {
        slide_ = std::copysign(1.0, x_.omega_m);
    } else if (std::abs(torque) <= effects_.coulomb_friction_Nm) {
        slide_ = 0.0;
    } else {
        slide_ = std::copysign(1.0, torque);
    }
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
