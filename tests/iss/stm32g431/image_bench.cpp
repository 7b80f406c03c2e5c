// SPDX-License-Identifier: MIT
#include "stm32g431/image_bench.hpp"

#include <cmath>

#include "sil/setup/board_reader.hpp"

extern "C" {
#include "app_control.h"
#include "app_registers.h"
}

namespace iss::stm32g431 {
namespace {

constexpr double dry_friction_share = 0.02; // of the rated torque: chosen, as of a served drive
constexpr double answer_s           = 0.1;
constexpr double ask_s              = 0.1;
constexpr double look_s             = 2e-6;

constexpr std::uint16_t polled_registers = 8;

std::uint16_t high(std::uint32_t word)
{
    return static_cast<std::uint16_t>(word >> 16U);
}

std::uint16_t low(std::uint32_t word)
{
    return static_cast<std::uint16_t>(word & 0xFFFFU);
}

} // namespace

sdre::Scenario at_rest(const sdre::Drive &drive)
{
    sdre::Scenario s;
    s.drive                             = drive;
    s.dc_link_V                         = drive.inverter.dc_link_V;
    s.sensors                           = sdre::sensors_of_drive(drive);
    s.sensors.ideal                     = false;
    s.sensors.current_sensors           = 3;
    s.inverter.dead_time_s              = drive.inverter.dead_time_s;
    s.motor_effects.coulomb_friction_Nm = dry_friction_share * drive.motor.rated_torque_Nm;
    return s;
}

void break_chip(Chip &chip, const Program &program, sdre::FaultKind kind)
{
    if (kind == sdre::FaultKind::tick_hung) {
        chip.core().hang_at(program.image.symbols.at("app_tick"));
    } else if (kind == sdre::FaultKind::trigger_lost) {
        chip.lose_trigger();
    } else {
        chip.core().mask_interrupts();
    }
}

ImageBench::ImageBench(const sdre::Scenario &s, double start_s, const Program &p)
    : program(p), scenario(s), bench(s, std::lround(start_s / sdre::control_period_s(s.drive))),
      circuit(bench, s.drive, false), chip(p.image, circuit),
      memory(chip.core(), p.image, p.layout), line(chip.serial()), master(line, 1)
{
}

void ImageBench::pass(double time_s)
{
    for (const double end_s = chip.time_s() + time_s; chip.time_s() < end_s;) {
        chip.run_for(bench.period_s());
        master.poll();
    }
}

bool ImageBench::answered()
{
    const int errors = master.errors();
    for (const double end_s = chip.time_s() + answer_s; master.busy() && chip.time_s() < end_s;) {
        pass(bench.period_s());
    }
    return !master.busy() && master.errors() == errors;
}

void ImageBench::run(double time_s)
{
    for (const double end_s = chip.time_s() + time_s; chip.time_s() < end_s;) {
        master.read_input(APP_REGISTERS_LIVE_FIRST, polled_registers);
        pass(std::min(ask_s, end_s - chip.time_s()));
        (void)answered();
    }
}

bool ImageBench::write(std::uint16_t first, const std::vector<std::uint16_t> &words)
{
    master.write(first, words);
    return answered();
}

int ImageBench::input(std::uint16_t number)
{
    master.read_input(number, 1);
    return answered() && master.values().size() == 1 ? master.values().front() : -1;
}

bool ImageBench::command(unsigned word, double speed_e_radps)
{
    const auto tenths =
        static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(10.0 * speed_e_radps)));
    return write(APP_REGISTERS_CONTROLWORD,
                 {static_cast<std::uint16_t>(word), APP_CONTROL_PROFILE_VELOCITY, high(tenths),
                  low(tenths)});
}

bool ImageBench::enable(double speed_e_radps, double within_s)
{
    const double end_s = chip.time_s() + within_s;
    bool         taken = command(APP_CONTROL_SHUT_DOWN, speed_e_radps);
    pass(2.0 * bench.period_s());
    taken = taken && command(APP_CONTROL_ENABLE_OPERATION, speed_e_radps);
    while (taken && mode() != APP_MODE_RUN && mode() != APP_MODE_FAULT && chip.time_s() < end_s) {
        run(0.5 * ask_s);
    }
    return mode() == APP_MODE_RUN;
}

double ImageBench::opens_s(double within_s)
{
    const double from_s = chip.time_s();
    while (chip.gates_enabled() && chip.time_s() < from_s + within_s) {
        chip.run_for(look_s);
    }
    return chip.gates_enabled() ? -1.0 : chip.time_s() - from_s;
}

} // namespace iss::stm32g431
