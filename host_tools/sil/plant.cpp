// SPDX-License-Identifier: MIT
#include "plant.hpp"

#include <cmath>

namespace sdre {

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
    x_ = {motor_.pm_flux_Wb, 0.0, omega_e_radps / motor_.pole_pairs, theta_e_rad};
}

void Plant::set_motor(const Motor &motor)
{
    const RotorVector i = current_A();
    motor_              = motor;
    x_.psi_d            = motor.pm_flux_Wb + motor.d_axis_inductance_H * i.d;
    x_.psi_q            = motor.q_axis_inductance_H * i.q;
}

RotorVector Plant::current_of(const State &x) const
{
    return {(x.psi_d - motor_.pm_flux_Wb) / motor_.d_axis_inductance_H,
            x.psi_q / motor_.q_axis_inductance_H};
}

RotorVector Plant::current_A() const
{
    return current_of(x_);
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
    }
}

void Plant::step(StatorVector v_V, double load_Nm, double dt_s, int substeps)
{
    integrate([&](double theta_e) { return to_rotor(v_V, theta_e); }, load_Nm, dt_s, substeps);
}

void Plant::step(RotorVector v_V, double load_Nm, double dt_s, int substeps)
{
    integrate([&](double) { return v_V; }, load_Nm, dt_s, substeps);
}

} // namespace sdre
