// SPDX-License-Identifier: MIT
#include "sil/board/board_runs.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/board/board_constants.hpp"
#include "design/board/identity.hpp"

extern "C" {
#include "app.h"
#include "app_registers.h"

extern drive_config_t   sil_drive_config;
extern app_config_t     sil_board_config;
extern board_identity_t sil_board_identity;
}

namespace sdre {
namespace {

// Beyond the longest boot: clock 4 ms, converter 5 ms.
constexpr double longest_boot_s = 0.5;
// Chosen: between two ticks, clear of the conversion that follows each.
constexpr double rest_s           = 50e-6;
constexpr int    polled_registers = 8;
// Ticks of a command on the virtual line at 5 kHz, so that a run begins in the same period on both
// boards. The time at standstill decides how accurate an angle between two edges is.
constexpr int line_ticks = 19;

float omega_of(int tenths)
{
    return static_cast<float>(tenths) / 10.0F;
}

} // namespace

void require_f28335(const Drive &drive)
{
    const Processor &p = processor_of(drive);
    if (p.name != "f28335") {
        throw InputError(
            fmt::format("{}: the virtual F28335 cannot be the {} of board \"{}\"; "
                        "--board {} runs its image, \"run --board api\" the application",
                        drive.name, p.name, drive.board.file->name, p.name));
    }
}

void set_firmware(const drive_config_t &config, const Drive &drive)
{
    static BoardConstants constants;
    constants          = board_constants(drive);
    sil_drive_config   = config;
    sil_board_config   = constants.bind();
    sil_board_identity = board_identity_of(drive);
}

app_status_t BoardRun::status() const
{
    return app_status_read();
}

const drive_t &BoardRun::drive() const
{
    return *app_drive();
}

ApiRun::ApiRun(const Scenario &s, long start_tick, double dead_time_s)
    : BoardRun(s, start_tick),
      fake_(bench_, dead_time_s, s.drive.board.dc_link_range_V, processor_of(s.drive).counter_Hz),
      choice_(fake_)
{
    if (!board_init(&sil_board_config.board) ||
        app_init(&sil_board_config, &sil_drive_config) != CTL_OK) {
        throw InputError("--board: the application refuses these constants");
    }
    board_start(app_tick, sil_drive_config.hardware.updates_per_period);
    step();
}

bool ApiRun::step()
{
    if (wait_ticks_ > 0 && --wait_ticks_ == 0) {
        app_objects_t o = app_control_default(&sil_drive_config);
        o.omega_e_radps = omega_of(tenths_);
        o.controlword   = run_ ? APP_CONTROL_ENABLE_OPERATION : APP_CONTROL_SHUT_DOWN;
        app_command_write(&o);
    }
    fake_.tick();
    app_background();
    return true;
}

void ApiRun::command()
{
    wait_ticks_ = line_ticks;
}

void ApiRun::set_speed(int tenths)
{
    tenths_ = tenths;
    command();
}

void ApiRun::set_run()
{
    run_ = true;
    command();
}

bool ApiRun::commission(std::uint16_t current, std::uint16_t speed)
{
    app_objects_t o     = app_control_default(&sil_drive_config);
    o.mode_of_operation = APP_CONTROL_COMMISSIONING;
    o.controlword       = commission_ready_ ? APP_CONTROL_ENABLE_OPERATION : APP_CONTROL_SHUT_DOWN;
    o.bounds            = {0.01F * static_cast<float>(current), 0.1F * static_cast<float>(speed)};
    if (!app_command_write(&o) || std::exchange(commission_ready_, true)) {
        return o.controlword == APP_CONTROL_ENABLE_OPERATION;
    }
    return false;
}

void ApiRun::inject(FaultKind)
{
    throw InputError("--board: this fault is one of the processor's, it needs --board f28335");
}

std::array<int, 3> ApiRun::duty_cnt() const
{
    return fake_.duty_cnt();
}

F28335Run::F28335Run(const Scenario &s, long start_tick, double dead_time_s)
    : ModbusRun(s, start_tick),
      surroundings_(bench_, dead_time_s <= 0.0, s.drive.board.dc_link_range_V,
                    sil_board_config.board.duty_full_cnt),
      device_(surroundings_, f28335::whole_firmware(), {{}, dead_time_s}),
      master_(device_.serial(), static_cast<std::uint8_t>(sil_board_config.modbus_address))
{
    require_f28335(s.drive);
    f28335::hang_ticks(false);
    if (!device_.run_until([this] { return bench_.tick() >= 0; }, longest_boot_s)) {
        std::string why = "--board: the firmware does not start";
        for (const std::string &finding : findings()) {
            why += "; " + finding;
        }
        throw InputError(why);
    }
    device_.run_for(rest_s);
}

bool F28335Run::step()
{
    device_.run_for(static_cast<double>(sil_board_config.board.pwm_cycles) /
                    sil_drive_config.hardware.updates_per_period / f28335::tick_Hz);
    master_.poll();
    return !device_.stopped();
}

void ModbusRun::set_speed(int tenths)
{
    tenths_ = tenths;
    command();
}

/// All of it each time: a command takes as long as any other.
void ModbusRun::command()
{
    const auto speed = static_cast<std::uint32_t>(tenths_);
    master().write(
        APP_REGISTERS_CONTROLWORD,
        {static_cast<std::uint16_t>(run_ ? APP_CONTROL_ENABLE_OPERATION : APP_CONTROL_SHUT_DOWN),
         APP_CONTROL_PROFILE_VELOCITY, static_cast<std::uint16_t>(speed >> 16U),
         static_cast<std::uint16_t>(speed & 0xFFFFU)});
}

void ModbusRun::set_run()
{
    run_ = true;
    command();
}

bool ModbusRun::commission(std::uint16_t current, std::uint16_t speed)
{
    const std::array<std::array<std::uint16_t, 2>, 5> writes{
        {{APP_REGISTERS_COMMISSION_CURRENT, current},
         {APP_REGISTERS_COMMISSION_SPEED, speed},
         {APP_REGISTERS_MODE_OF_OPERATION,
          static_cast<std::uint16_t>(APP_CONTROL_COMMISSIONING & 0xFFFF)},
         {APP_REGISTERS_CONTROLWORD, APP_CONTROL_SHUT_DOWN},
         {APP_REGISTERS_CONTROLWORD, APP_CONTROL_ENABLE_OPERATION}}};
    if (commission_writes_ < writes.size() && can_command()) {
        master().write(writes[commission_writes_][0], writes[commission_writes_][1]);
        commission_writes_++;
    }
    return commission_writes_ == writes.size();
}

void F28335Run::inject(FaultKind kind)
{
    if (kind == FaultKind::tick_hung) {
        f28335::hang_ticks(true);
    } else if (kind == FaultKind::trigger_lost) {
        device_.lose_trigger();
    } else {
        device_.mask_interrupts();
    }
}

void ModbusRun::chat()
{
    master().read_input(APP_REGISTERS_LIVE_FIRST, polled_registers);
}

std::array<int, 3> F28335Run::duty_cnt() const
{
    return surroundings_.duty_cnt();
}

std::vector<std::string> F28335Run::findings() const
{
    std::vector<std::string> all;
    for (const f28335::Findings::Entry &e : device_.findings().all()) {
        all.push_back(fmt::format("{:.6f} s: {}", e.time_s, e.text));
    }
    return all;
}

} // namespace sdre
