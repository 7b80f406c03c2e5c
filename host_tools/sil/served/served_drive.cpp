// SPDX-License-Identifier: MIT
#include "sil/served/served_drive.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/setup/board_reader.hpp"

namespace sdre {
namespace {

constexpr double no_end_s = 1e9;
constexpr double pi       = 3.14159265358979323846;

// Chosen: bearings, seals and fan of a small machine take one to three per cent of its rated torque.
constexpr double dry_friction_share = 0.02;

// Chosen: two slots for each phase and pole. Six would be the order of the dead time.
constexpr int usual_slots_per_pair = 12;

void require_same(const char *key, int drive, int machine)
{
    if (drive != machine) {
        throw InputError(
            fmt::format("--machine: {} = {} is not allowed: must be {}, as in the drive file", key,
                        machine, drive));
    }
}

MotorScale scale_of(Motor drive, Motor machine)
{
    MotorScale scale;
    for (const char *key : {"stator_resistance_Ohm", "d_axis_inductance_H", "q_axis_inductance_H",
                            "pm_flux_Wb", "inertia_kgm2", "viscous_friction_Nms"}) {
        const double believed = motor_value(drive, key);
        const double true_one = motor_value(machine, key);
        if (believed == 0.0 && true_one != 0.0) {
            throw InputError(fmt::format(
                "--machine: {} = {:g} is not allowed: the drive file has 0", key, true_one));
        }
        if (true_one != believed) {
            scale[key] = true_one / believed;
        }
    }
    return scale;
}

} // namespace

double bench_friction_Nm(const Drive &machine)
{
    const Motor &m = machine.motor;
    return m.viscous_friction_Nms > 0.0 ? 0.0 : dry_friction_share * m.rated_torque_Nm;
}

Scenario bench_scenario(const Drive &drive, const Machine &bench, std::uint64_t seed)
{
    const Drive &machine = bench.drive;
    require_same("[motor] pole_pairs", drive.motor.pole_pairs, machine.motor.pole_pairs);
    require_same("[encoder] lines", drive.encoder.lines, machine.encoder.lines);
    Scenario s;
    s.name                              = drive.name;
    s.drive                             = drive;
    s.duration_s                        = no_end_s;
    s.dc_link_V                         = drive.inverter.dc_link_V;
    s.seed                              = seed;
    s.sensors                           = sensors_of_drive(drive);
    s.sensors.ideal                     = false;
    const SensorSettings true_ones      = sensors_of_drive(machine);
    s.sensors.encoder_disc              = true_ones.encoder_disc;
    s.sensors.encoder_eccentricity_rad  = true_ones.encoder_eccentricity_rad;
    s.plant_scale                       = scale_of(drive.motor, machine.motor);
    s.motor_effects                     = effects_of_drive(machine);
    s.motor_effects.coulomb_friction_Nm = bench_friction_Nm(machine);
    if (bench.cogging_share > 0.0) {
        const Motor &m                       = machine.motor;
        s.motor_effects.cogging_amplitude_Nm = bench.cogging_share * m.rated_torque_Nm;
        // Without dry friction a shaft at rest would swing in the cogging for seconds.
        s.motor_effects.coulomb_friction_Nm = dry_friction_share * m.rated_torque_Nm;
        s.motor_effects.cogging_order = m.slots > 0 ? m.slots : usual_slots_per_pair * m.pole_pairs;
    }
    if (machine.saturation) {
        s.motor_effects.flux = saturated_motor(machine, machine.motor);
        s.plant_scale.erase("pm_flux_Wb"); // the map has them
        s.plant_scale.erase("d_axis_inductance_H");
        s.plant_scale.erase("q_axis_inductance_H");
    }
    s.speed_reference = {{0.0, 0.0}};
    s.load_torque     = {{0.0, 0.0}};
    return s;
}

ServedDrive::ServedDrive(const Scenario &scenario, long start_tick)
    : scenario_(scenario), bench_(scenario_, start_tick), dynamometer_(scenario.drive),
      source_V_(scenario.dc_link_V)
{
}

void ServedDrive::set_load()
{
    if (bench_.board() == nullptr) {
        return; // the shaft is held
    }
    const DynamometerTorque torque = dynamometer_.at(plant_state().omega_e_radps);
    bench_.board()->set_extra_load_Nm(torque.active_Nm);
    bench_.board()->set_extra_brake_Nm(torque.brake_Nm);
}

double ServedDrive::turns() const
{
    return plant_state().theta_e_rad / (2.0 * pi * scenario_.drive.motor.pole_pairs);
}

/// An input without a switch is open.
bool ServedDrive::home_is_open() const
{
    const auto &home = switches_.home;
    return !home || (turns() >= home->first && turns() <= home->second);
}

void ServedDrive::set_dc_link_V(double voltage_V)
{
    bench_.board()->set_source_V(voltage_V);
    source_V_ = voltage_V;
}

void ServedDrive::mend()
{
    bench_.board()->mend();
    can_bus_.set_fault(f28335::CanFault::none);
    broken_.erase(std::remove_if(broken_.begin(), broken_.end(),
                                 [](const InjectedFault &f) { return !needs_processor(f.kind); }),
                  broken_.end());
    if (bridge_on()) {
        dynamometer_.brake(0.0);
    } else {
        dynamometer_.bring_to_rest();
    }
}

void ServedDrive::forget_processor_faults()
{
    broken_.erase(std::remove_if(broken_.begin(), broken_.end(),
                                 [](const InjectedFault &f) { return needs_processor(f.kind); }),
                  broken_.end());
}

void ServedDrive::break_part(const InjectedFault &fault)
{
    broken_.push_back(fault);
    if (needs_processor(fault.kind)) {
        break_processor(fault.kind);
    } else {
        bench_.board()->break_part(fault);
    }
}

} // namespace sdre
