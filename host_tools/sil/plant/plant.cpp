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
    const double omega_m = omega_e_radps / motor_.pole_pairs;
    x_                   = {{0.0, 0.0, omega_m, theta_e_rad}, 0.0, omega_m};
    set_current({});
    peak_A2_ = 0.0;
    align_angle();
}

void Plant::set_motor(const Motor &motor)
{
    motor_ = motor;
    renew();
}

void Plant::set_effects(const MotorEffects &effects)
{
    effects_ = effects;
    renew();
}

void Plant::renew()
{
    with_effects_ = any_effect(effects_);
    equations_    = MotorEquations(motor_, 1.0 - effects_.load_inertia_share);
    set_current(i_);
}

void Plant::set_current(RotorVector i)
{
    const RotorVector magnet = magnet_flux(effects_, motor_.pm_flux_Wb, x_.theta_e).flux_Wb;
    i_                       = i;
    if (effects_.flux) {
        const FluxAt f = effects_.flux->at(i.d, i.q);
        x_.psi_d       = magnet.d + f.d_Wb - effects_.flux->magnet_Wb();
        x_.psi_q       = magnet.q + f.q_Wb;
        return;
    }
    const RotorVector L = inductances_H(i);
    x_.psi_d            = magnet.d + L.d * i.d;
    x_.psi_q            = magnet.q + L.q * i.q;
}

RotorVector Plant::inductances_H(RotorVector i) const
{
    return effects_.saturation
               ? inductance_H(*effects_.saturation, i)
               : RotorVector{motor_.d_axis_inductance_H, motor_.q_axis_inductance_H};
}

RotorVector Plant::current_at(const MotorState &x) const
{
    const RotorVector magnet = magnet_flux(effects_, motor_.pm_flux_Wb, x.theta_e).flux_Wb;
    const RotorVector of_current{x.psi_d - magnet.d, x.psi_q - magnet.q};
    if (effects_.flux) {
        return saturated_current_A(*effects_.flux, of_current, i_);
    }
    if (effects_.saturation) {
        return saturated_current_A(*effects_.saturation, of_current, i_);
    }
    return equations_.current_A(x, magnet);
}

double Plant::torque_Nm(const MotorState &x, RotorVector i) const
{
    const RotorVector slope = magnet_flux(effects_, motor_.pm_flux_Wb, x.theta_e).slope_Wb;
    return equations_.torque_Nm(x, i) + equations_.slope_Nm(slope, i);
}

/// Everything on the motor's mass but dry friction.
double Plant::motor_side_Nm(const MotorState &x, RotorVector i, const ShaftLoad &load) const
{
    const RotorVector slope = magnet_flux(effects_, motor_.pm_flux_Wb, x.theta_e).slope_Wb;
    return equations_.shaft_Nm(x, i, load) - cogging_Nm(effects_, x.theta_e, motor_.pole_pairs) +
           equations_.slope_Nm(slope, i) - effects_.iron_eddy_Nms * iron_share(x) * x.omega_m;
}

/// Share of the iron's drag at the magnet's own flux. A motor without a magnet has none
/// (require_magnet()).
double Plant::iron_share(const MotorState &x) const // EQ-EFFECTS-6
{
    if (motor_.pm_flux_Wb == 0.0) {
        return 0.0;
    }
    return (x.psi_d * x.psi_d + x.psi_q * x.psi_q) / (motor_.pm_flux_Wb * motor_.pm_flux_Wb);
}

/// Dry friction of the motor.
double Plant::dry_Nm(const MotorState &x) const
{
    return friction_Nm(effects_, x.omega_m) + effects_.iron_hysteresis_Nm * iron_share(x);
}

double Plant::spring_Nm(const TwoMassState &x) const // EQ-EFFECTS-4
{
    return effects_.shaft_stiffness_Nmprad * x.twist_rad +
           effects_.shaft_damping_Nms * (x.omega_m - x.omega_load_m);
}

/// Everything on the load's mass but its dry friction.
double Plant::load_side_Nm(const TwoMassState &x, const ShaftLoad &load) const
{
    const double fan = load.fan_Nm_per_radps2 * std::abs(x.omega_load_m);
    return spring_Nm(x) - fan * x.omega_load_m - load.torque_Nm;
}

template <typename State, typename Rate>
void Plant::integrate(State &x, double dt_s, const Rate &rate)
{
    const State gain = rk4_gain(x, dt_s, rate);
    x                = along(x, gain, 1.0);
    angle_           = turned(angle_, small_rotation(gain.theta_e));
}

template <typename Voltage>
void Plant::move_rigid(const Voltage &voltage, const ShaftLoad &load, double dt_s)
{
    MotorState &motor = x_;
    friction_.choose(x_.omega_m, motor_side_Nm(x_, i_, load), dry_Nm(x_) + load.brake_Nm);
    integrate(motor, dt_s, [&](const MotorState &x, double turned_rad) {
        const RotorVector i = current_at(x);
        return equations_.rate(
            x, i, voltage(turned_rad, x, i),
            friction_.left_Nm(motor_side_Nm(x, i, load), dry_Nm(x) + load.brake_Nm));
    });
    x_.omega_m = friction_.ended(x_.omega_m);
}

/// To the motor the shaft is the load.
template <typename Voltage>
void Plant::move_two_masses(const Voltage &voltage, const ShaftLoad &load, double dt_s)
{
    const double per_load_inertia = 1.0 / (effects_.load_inertia_share * motor_.inertia_kgm2);
    friction_.choose(x_.omega_m, motor_side_Nm(x_, i_, {spring_Nm(x_)}), dry_Nm(x_));
    brake_.choose(x_.omega_load_m, load_side_Nm(x_, load), load.brake_Nm);
    integrate(x_, dt_s, [&](const TwoMassState &x, double turned_rad) {
        const RotorVector i         = current_at(x);
        const double      motor_Nm  = motor_side_Nm(x, i, {spring_Nm(x)});
        const double      beyond_Nm = brake_.left_Nm(load_side_Nm(x, load), load.brake_Nm);
        return TwoMassState{equations_.rate(x, i, voltage(turned_rad, x, i),
                                            friction_.left_Nm(motor_Nm, dry_Nm(x))),
                            x.omega_m - x.omega_load_m, beyond_Nm * per_load_inertia};
    });
    x_.omega_m      = friction_.ended(x_.omega_m);
    x_.omega_load_m = brake_.ended(x_.omega_load_m);
}

/// voltage(turned_rad, x, i) is the voltage seen from the rotor once it has turned this far in the step.
template <typename Voltage>
void Plant::move(const Voltage &voltage, const ShaftLoad &load, double dt_s)
{
    if (effects_.load_inertia_share != 0.0) {
        move_two_masses(voltage, load, dt_s);
        i_ = current_at(x_);
    } else if (with_effects_ || load.brake_Nm != 0.0) {
        move_rigid(voltage, load, dt_s);
        i_ = current_at(x_);
    } else {
        MotorState &motor = x_;
        integrate(motor, dt_s, [&](const MotorState &x, double turned_rad) {
            const RotorVector i = equations_.current_A(x);
            return equations_.rate(x, i, voltage(turned_rad, x, i),
                                   equations_.shaft_Nm(x, i, load));
        });
        i_ = equations_.current_A(x_);
    }
    end_step(dt_s);
}

void Plant::end_step(double dt_s)
{
    note_peak();
    path_.add(dt_s, x_.theta_e, omega_e_radps());
}

/// A step of a rigid motor without effects, as move() does it. No library call is in its way, and the rate is inlined in
/// its four places: 0.7 of the instructions. False, and nothing has changed: an angle is beyond the series.
bool Plant::advance_by_series(RotorVector v, const ShaftLoad &load, double dt_s)
{
    double           farthest_rad = 0.0;
    MotorState      &motor        = x_;
    const MotorState gain         = rk4_gain(
                motor, dt_s, [&](const MotorState &x, double turned_rad) __attribute__((always_inline)) {
                    farthest_rad        = std::max(farthest_rad, std::abs(turned_rad));
                    const RotorVector i = equations_.current_A(x);
                    return equations_.rate(x, i, seen_from(series_rotation(turned_rad), v.d, v.q),
                                           equations_.shaft_Nm(x, i, load));
                });
    if (std::max(farthest_rad, std::abs(gain.theta_e)) > series_bound_rad) {
        return false;
    }
    motor  = along(motor, gain, 1.0);
    angle_ = turned(angle_, series_rotation(gain.theta_e));
    i_     = equations_.current_A(motor);
    end_step(dt_s);
    return true;
}

void Plant::advance(StatorVector v, const ShaftLoad &load, double dt_s)
{
    const RotorVector v_V = to_rotor(v, angle_); // at the start of the step
    if (!with_effects_ && load.brake_Nm == 0.0 && advance_by_series(v_V, load, dt_s)) {
        return;
    }
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
    move([&](double, const MotorState &x, RotorVector) { return emf_V(x); }, load, dt_s);
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
    const RotorVector rate = current_rate_Aps(i_, current_flux_rate_V(x_, i_, to_rotor(v, angle_)));
    const double      w    = omega_e_radps();
    // The rotor frame's own rotation comes in: d/dt (P i) = P (i' + w J i).
    return phases_of(to_stator({rate.d - w * i_.q, rate.q + w * i_.d}, angle_));
}

/// L^-1 times the rate of a flux, L incremental where the drive file has a map.
RotorVector Plant::current_rate_Aps(RotorVector i, RotorVector flux_rate_V) const
{
    if (effects_.flux) {
        const auto rate = by_inductance(effects_.flux->at(i.d, i.q), flux_rate_V.d, flux_rate_V.q);
        return {rate[0], rate[1]};
    }
    const RotorVector L = inductances_H(i);
    return {flux_rate_V.d / L.d, flux_rate_V.q / L.q};
}

/// EQ-OPEN-1: u (L^-1 (v - R i + w ..) + w J i) = 0, solved for what the terminal adds to v.
double Plant::floating_V(const MotorState &x, RotorVector i, RotorVector v, RotorVector u) const
{
    const RotorVector own  = current_rate_Aps(i, current_flux_rate_V(x, i, v));
    const double      w    = equations_.omega_e_radps(x);
    const double      rate = u.d * (own.d - w * i.q) + u.q * (own.q + w * i.d);
    if (effects_.flux) {
        const RotorVector per_V = current_rate_Aps(i, u);
        return -1.5 * rate / (u.d * per_V.d + u.q * per_V.q);
    }
    const RotorVector L = inductances_H(i);
    return -1.5 * rate / (u.d * u.d / L.d + u.q * u.q / L.q);
}

double Plant::floating_V(std::array<double, 3> others_V, std::size_t phase) const
{
    others_V[phase] = 0.0;
    return floating_V(x_, i_, to_rotor(clarke(others_V), angle_),
                      to_rotor(phase_axes[phase], angle_));
}

/// Voltage that the rotation induces, with or without currents.
RotorVector Plant::emf_V(const MotorState &x) const
{
    const double      w     = equations_.omega_e_radps(x);
    const RotorVector slope = magnet_flux(effects_, motor_.pm_flux_Wb, x.theta_e).slope_Wb;
    return {w * (slope.d - x.psi_q), w * (slope.q + x.psi_d)};
}

/// The part of d/dt of the flux linkages that changes the currents.
RotorVector Plant::current_flux_rate_V(const MotorState &x, RotorVector i, RotorVector v) const
{
    const double      w     = equations_.omega_e_radps(x);
    const RotorVector slope = magnet_flux(effects_, motor_.pm_flux_Wb, x.theta_e).slope_Wb;
    const RotorVector rate  = equations_.flux_rate_V(x, i, v);
    return {rate.d - w * slope.d, rate.q - w * slope.q};
}

PhaseVector Plant::emf_V() const
{
    return phases_of(to_stator(emf_V(x_), angle_));
}

} // namespace sdre
