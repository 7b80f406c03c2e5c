// SPDX-License-Identifier: MIT
#include "sil/plant/plant.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

const double half_sqrt3 = 0.5 * std::sqrt(3.0);

struct Rotation {
    double cos;
    double sin;
};

/// Taylor to the 7th power. Its error at the bound is 0.1^8 / 8! = 2.5e-13; beyond it the library is asked.
Rotation small_rotation(double x)
{
    constexpr double bound_rad = 0.1;
    if (std::abs(x) > bound_rad) {
        return {std::cos(x), std::sin(x)};
    }
    const double y = x * x;
    return {1.0 - y * (0.5 - y * (1.0 / 24.0 - y / 720.0)),
            x * (1.0 - y * (1.0 / 6.0 - y * (1.0 / 120.0 - y / 5040.0)))};
}

} // namespace

RotorVector to_rotor(StatorVector v, double theta_e_rad)
{
    const double c = std::cos(theta_e_rad);
    const double s = std::sin(theta_e_rad);
    return {c * v.alpha + s * v.beta, c * v.beta - s * v.alpha};
}

StatorVector to_stator(RotorVector v, double theta_e_rad)
{
    const double c = std::cos(theta_e_rad);
    const double s = std::sin(theta_e_rad);
    return {c * v.d - s * v.q, s * v.d + c * v.q};
}

Plant::Plant(const Motor &motor) : motor_(motor)
{
    reset(0.0);
}

void Plant::reset(double omega_e_radps, double theta_e_rad)
{
    x_      = {motor_.pm_flux_Wb, 0.0, omega_e_radps / motor_.pole_pairs, theta_e_rad};
    i_      = {};
    cos_    = std::cos(theta_e_rad);
    sin_    = std::sin(theta_e_rad);
    peak_A_ = 0.0;
}

void Plant::set_motor(const Motor &motor)
{
    const RotorVector i = current_A();
    motor_              = motor;
    set_current(i);
}

void Plant::set_effects(const MotorEffects &effects)
{
    const RotorVector i = current_A();
    effects_            = effects;
    with_effects_       = effects.saturation || effects.cogging_amplitude_Nm != 0.0 ||
                    effects.coulomb_friction_Nm != 0.0;
    set_current(i);
}

void Plant::set_current(RotorVector i)
{
    RotorVector L{motor_.d_axis_inductance_H, motor_.q_axis_inductance_H};
    if (effects_.saturation) {
        L = inductance_H(*effects_.saturation, i);
    }
    x_.psi_d = motor_.pm_flux_Wb + L.d * i.d;
    x_.psi_q = L.q * i.q;
    i_       = i;
}

RotorVector Plant::current_of(const State &x) const
{
    return {(x.psi_d - motor_.pm_flux_Wb) / motor_.d_axis_inductance_H,
            x.psi_q / motor_.q_axis_inductance_H};
}

RotorVector Plant::current_A() const
{
    return effects_.saturation ? current_at<true>(x_) : current_of(x_);
}

double Plant::torque_Nm() const
{
    const RotorVector i = current_A();
    return 1.5 * motor_.pole_pairs * (x_.psi_d * i.q - x_.psi_q * i.d);
}

double Plant::omega_e_radps() const
{
    return motor_.pole_pairs * x_.omega_m;
}

template <typename Voltage>
Plant::State Plant::derivative(const State &x, const Voltage &voltage, double load_Nm) const
{
    const RotorVector v = voltage(x.theta_e);
    const RotorVector i = current_of(x);
    const double      w = motor_.pole_pairs * x.omega_m;
    const double torque = 1.5 * motor_.pole_pairs * (x.psi_d * i.q - x.psi_q * i.d); // EQ-PLANT-2
    const double R      = motor_.stator_resistance_Ohm;

    return {v.d - R * i.d + w * x.psi_q, // EQ-PLANT-1
            v.q - R * i.q - w * x.psi_d,
            (torque - motor_.viscous_friction_Nms * x.omega_m - load_Nm) /
                motor_.inertia_kgm2, // EQ-PLANT-3
            w};
}

template <typename Voltage>
void Plant::integrate(const Voltage &voltage, double load_Nm, double dt_s, int substeps)
{
    const double h          = dt_s / substeps;
    const auto   add_scaled = [](const State &x, const State &k, double f) {
        return State{x.psi_d + f * k.psi_d, x.psi_q + f * k.psi_q, x.omega_m + f * k.omega_m,
                     x.theta_e + f * k.theta_e};
    };
    for (int i = 0; i < substeps; i++) {
        const State k1 = derivative(x_, voltage, load_Nm);
        const State k2 = derivative(add_scaled(x_, k1, 0.5 * h), voltage, load_Nm);
        const State k3 = derivative(add_scaled(x_, k2, 0.5 * h), voltage, load_Nm);
        const State k4 = derivative(add_scaled(x_, k3, h), voltage, load_Nm);
        x_             = add_scaled(x_, k1, h / 6.0);
        x_             = add_scaled(x_, k2, h / 3.0);
        x_             = add_scaled(x_, k3, h / 3.0);
        x_             = add_scaled(x_, k4, h / 6.0);
        note_peak(current_of(x_));
    }
    cos_ = std::cos(x_.theta_e);
    sin_ = std::sin(x_.theta_e);
    i_   = current_of(x_);
}

void Plant::step(StatorVector v_V, double load_Nm, double dt_s, int substeps)
{
    integrate([&](double theta_e) { return to_rotor(v_V, theta_e); }, load_Nm, dt_s, substeps);
}

void Plant::step(RotorVector v_V, double load_Nm, double dt_s, int substeps)
{
    integrate([&](double) { return v_V; }, load_Nm, dt_s, substeps);
}

void Plant::note_peak(RotorVector i)
{
    peak_A_ = std::max(peak_A_, std::sqrt(i.d * i.d + i.q * i.q));
}

void Plant::reset_peak()
{
    const RotorVector i = current_A();
    peak_A_             = std::sqrt(i.d * i.d + i.q * i.q);
}

template <bool with_effects> RotorVector Plant::current_at(const State &x) const
{
    if constexpr (with_effects) {
        if (effects_.saturation) {
            return saturated_current_A(*effects_.saturation, {x.psi_d - motor_.pm_flux_Wb, x.psi_q},
                                       i_);
        }
    }
    return current_of(x);
}

/// Everything on the shaft but Coulomb friction.
double Plant::net_torque_Nm(const State &x, RotorVector i, const ShaftLoad &load) const
{
    double torque = 1.5 * motor_.pole_pairs * (x.psi_d * i.q - x.psi_q * i.d);
    torque -= motor_.viscous_friction_Nms * x.omega_m + load.torque_Nm;
    torque -= load.fan_Nm_per_radps2 * x.omega_m * std::abs(x.omega_m);
    if (effects_.cogging_amplitude_Nm != 0.0) { // EQ-EFFECTS-2
        const double angle = effects_.cogging_order * x.theta_e / motor_.pole_pairs;
        torque -= effects_.cogging_amplitude_Nm * std::sin(angle);
        if (effects_.cogging_second_Nm != 0.0) {
            torque -=
                effects_.cogging_second_Nm * std::sin(2.0 * angle + effects_.cogging_second_rad);
        }
    }
    return torque;
}

/// v_V is the voltage seen from the rotor's angle at the start of the step, which it has left by turned_rad.
template <bool with_effects>
Plant::State Plant::slope(const State &x, RotorVector v_V, double turned_rad,
                          const ShaftLoad &load) const
{
    const Rotation    turn = small_rotation(turned_rad);
    const RotorVector v    = {v_V.d * turn.cos + v_V.q * turn.sin,
                              v_V.q * turn.cos - v_V.d * turn.sin};
    const RotorVector i    = current_at<with_effects>(x);
    const double      w    = motor_.pole_pairs * x.omega_m;
    const double      R    = motor_.stator_resistance_Ohm;
    double            T    = 0.0;
    if constexpr (with_effects) {
        T = net_torque_Nm(x, i, load);
        if (effects_.coulomb_friction_Nm != 0.0) {
            T = slide_ != 0.0 ? T - slide_ * effects_.coulomb_friction_Nm : 0.0;
        }
    } else {
        T = 1.5 * motor_.pole_pairs * (x.psi_d * i.q - x.psi_q * i.d);
        T -= motor_.viscous_friction_Nms * x.omega_m + load.torque_Nm;
        T -= load.fan_Nm_per_radps2 * x.omega_m * std::abs(x.omega_m);
    }
    return {v.d - R * i.d + w * x.psi_q, v.q - R * i.q - w * x.psi_d, T / motor_.inertia_kgm2, w};
}

template <bool with_effects>
void Plant::advance_with(RotorVector v_V, const ShaftLoad &load, double h)
{
    const State x0   = x_;
    const auto  from = [&x0](const State &k, double f) {
        return State{x0.psi_d + f * k.psi_d, x0.psi_q + f * k.psi_q, x0.omega_m + f * k.omega_m,
                     x0.theta_e + f * k.theta_e};
    };
    const State  k1 = slope<with_effects>(x0, v_V, 0.0, load);
    const State  k2 = slope<with_effects>(from(k1, 0.5 * h), v_V, 0.5 * h * k1.theta_e, load);
    const State  k3 = slope<with_effects>(from(k2, 0.5 * h), v_V, 0.5 * h * k2.theta_e, load);
    const State  k4 = slope<with_effects>(from(k3, h), v_V, h * k3.theta_e, load);
    const double f  = h / 6.0;
    x_.psi_d += f * (k1.psi_d + 2.0 * (k2.psi_d + k3.psi_d) + k4.psi_d);
    x_.psi_q += f * (k1.psi_q + 2.0 * (k2.psi_q + k3.psi_q) + k4.psi_q);
    x_.omega_m += f * (k1.omega_m + 2.0 * (k2.omega_m + k3.omega_m) + k4.omega_m);
    const double turned = f * (k1.theta_e + 2.0 * (k2.theta_e + k3.theta_e) + k4.theta_e);
    x_.theta_e += turned;

    // The angle's sine and cosine follow; one Newton step of 1/sqrt keeps their length at one.
    const Rotation turn   = small_rotation(turned);
    const double   c      = cos_ * turn.cos - sin_ * turn.sin;
    const double   s      = sin_ * turn.cos + cos_ * turn.sin;
    const double   length = 1.5 - 0.5 * (c * c + s * s);
    cos_                  = length * c;
    sin_                  = length * s;
}

void Plant::advance(StatorVector v, const ShaftLoad &load, double dt_s)
{
    const RotorVector v_V = {cos_ * v.alpha + sin_ * v.beta, cos_ * v.beta - sin_ * v.alpha};
    if (!with_effects_) {
        advance_with<false>(v_V, load, dt_s);
        i_ = current_of(x_);
    } else {
        choose_friction(load);
        advance_with<true>(v_V, load, dt_s);
        if (effects_.coulomb_friction_Nm != 0.0 && slide_ * x_.omega_m < 0.0) {
            x_.omega_m = 0.0;
        }
        i_ = current_at<true>(x_);
    }
    note_peak(i_);
}

/// Sliding friction opposes the speed; at rest the friction either holds or opposes the torque.
void Plant::choose_friction(const ShaftLoad &load)
{
    const double torque = net_torque_Nm(x_, i_, load);
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
    cos_ = std::cos(x_.theta_e);
    sin_ = std::sin(x_.theta_e);
}

PhaseVector Plant::phase_current_A() const
{
    const double alpha     = cos_ * i_.d - sin_ * i_.q;
    const double half_beta = half_sqrt3 * (sin_ * i_.d + cos_ * i_.q);
    return {alpha, half_beta - 0.5 * alpha, -half_beta - 0.5 * alpha};
}

PhaseVector Plant::phase_current_rate_Aps(StatorVector v) const
{
    RotorVector L{motor_.d_axis_inductance_H, motor_.q_axis_inductance_H};
    if (effects_.saturation) {
        L = inductance_H(*effects_.saturation, i_);
    }
    const double R   = motor_.stator_resistance_Ohm;
    const double w   = motor_.pole_pairs * x_.omega_m;
    const double v_d = cos_ * v.alpha + sin_ * v.beta;
    const double v_q = cos_ * v.beta - sin_ * v.alpha;
    // In the rotor frame by EQ-PLANT-1, then the frame's own rotation: d/dt (P i) = P (i' + w J i).
    const double d         = (v_d - R * i_.d + w * x_.psi_q) / L.d - w * i_.q;
    const double q         = (v_q - R * i_.q - w * x_.psi_d) / L.q + w * i_.d;
    const double alpha     = cos_ * d - sin_ * q;
    const double half_beta = half_sqrt3 * (sin_ * d + cos_ * q);
    return {alpha, half_beta - 0.5 * alpha, -half_beta - 0.5 * alpha};
}

} // namespace sdre
