// SPDX-License-Identifier: MIT
#include "sil/served/served_drive.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/board/board_choice.hpp"
#include "sil/board/board_runs.hpp"
#include "sil/setup/board_reader.hpp"

extern "C" {
extern volatile std::uint32_t watchdog_after_reset[2]; // firmware/board/f28335/watchdog.c
std::uint16_t                *f28335_board_kept(void);
}

namespace sdre {
namespace {

// Beyond the longest boot: clock 4 ms, converter 5 ms. After a reset the loader may run, which has no ticks.
constexpr double longest_boot_s = 0.5;
// Chosen: between two ticks, clear of the conversion that follows each.
constexpr double rest_share = 0.25;
constexpr double no_end_s   = 1e9;
constexpr double pi         = 3.14159265358979323846;

constexpr int pin_home     = 26; // docs/hardware.md
constexpr int pin_negative = 32;
constexpr int pin_positive = 33;

/// The firmware's constants, before anything of the board is made.
Controller bound(const Scenario &s)
{
    require_f28335(s.drive);
    Controller c = prepare_controller(s, Precision::extended);
    set_firmware(c.config, s.drive);
    return c;
}

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

ServedDrive::ServedDrive(const Drive &drive, const Machine &machine, std::uint64_t seed,
                         const f28335::FlashWords &flash, bool own_stack)
    : scenario_(bench_scenario(drive, machine, seed)), controller_(bound(scenario_)),
      bench_(scenario_, 0), surroundings_(bench_, false, drive.board.dc_link_range_V, 1),
      own_stack_(own_stack), dynamometer_(drive), source_V_(scenario_.dc_link_V)
{
    if (flash.empty()) {
        f28335::erase_flash();
    } else {
        f28335::set_flash(flash);
    }
    power_cycle();
}

void ServedDrive::power_up(bool after_reset)
{
    before_s_ += device_ ? device_->time_s() : 0.0;
    device_.reset(); // the registers exist once
    surroundings_.brake_changes(false, 0.0);
    broken_.erase(std::remove_if(broken_.begin(), broken_.end(),
                                 [](const InjectedFault &f) { return needs_processor(f.kind); }),
                  broken_.end());
    f28335::hang_ticks(false);
    device_ = std::make_unique<f28335::Device>(
        surroundings_, f28335::whole_firmware(),
        f28335::DeviceOptions{{},
                              scenario_.drive.inverter.dead_time_s,
                              after_reset ? watchdog_low_s_ : power_on_low_s_,
                              f28335::AtLoad::old_values,
                              own_stack_,
                              &can_bus_});
    const long before = bench_.tick();
    if (!device_->run_until([&] { return bench_.tick() > before; }, longest_boot_s) &&
        !after_reset) {
        throw InputError(fmt::format("serve: the firmware does not start{}{}",
                                     findings().empty() ? "" : ": ",
                                     findings().empty() ? "" : findings().front()));
    }
    ready_s_ = device_->time_s();
    device_->run_for(rest_share * period_s());
}

/// Memory without power: anything, and not the same twice.
void ServedDrive::power_cycle()
{
    for (volatile std::uint32_t &word : watchdog_after_reset) {
        word = 0x9E3779B9U * ++power_cycles_;
    }
    for (std::size_t n = 0; n < BOARD_KEPT_WORDS; n++) {
        f28335_board_kept()[n] = static_cast<std::uint16_t>((0x9E3779B9U * ++power_cycles_) >> 16U);
    }
    power_up(false);
}

void ServedDrive::period()
{
    if (device_->stopped()) {
        resets_++;
        power_up(true);
        return;
    }
    const DynamometerTorque torque = dynamometer_.at(plant_state().omega_e_radps);
    bench_.board()->set_extra_load_Nm(torque.active_Nm);
    bench_.board()->set_extra_brake_Nm(torque.brake_Nm);
    set_inputs();
    device_->run_for(period_s());
}

double ServedDrive::turns() const
{
    return plant_state().theta_e_rad / (2.0 * pi * scenario_.drive.motor.pole_pairs);
}

/// Contacts that open when they are active; an input without a switch is open.
void ServedDrive::set_inputs()
{
    const double at   = turns();
    const auto  &home = switches_.home;
    device_->set_input(pin_home, !home || (at >= home->first && at <= home->second));
    device_->set_input(pin_negative, !switches_.negative || at <= *switches_.negative);
    device_->set_input(pin_positive, !switches_.positive || at >= *switches_.positive);
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

void ServedDrive::break_part(const InjectedFault &fault)
{
    broken_.push_back(fault);
    switch (fault.kind) {
    case FaultKind::tick_hung:
        f28335::hang_ticks(true);
        break;
    case FaultKind::trigger_lost:
        device_->lose_trigger();
        break;
    case FaultKind::interrupt_masked:
        device_->mask_interrupts();
        break;
    case FaultKind::phase_open:
    case FaultKind::current_zero:
    case FaultKind::current_frozen:
    case FaultKind::current_drift:
    case FaultKind::current_gain:
    case FaultKind::encoder_losing:
    case FaultKind::index_missing:
        bench_.board()->break_part(fault);
        break;
    }
}

std::vector<std::string> ServedDrive::findings() const
{
    std::vector<std::string> all;
    for (const f28335::Findings::Entry &e : device_->findings().all()) {
        all.push_back(fmt::format("{:.6f} s: {}", e.time_s, e.text));
    }
    return all;
}

} // namespace sdre
