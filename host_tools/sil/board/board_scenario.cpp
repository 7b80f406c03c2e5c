// SPDX-License-Identifier: MIT
#include "sil/board/board_scenario.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/setup/board_reader.hpp"

extern "C" {
#include "board_limits.h"
}

namespace sdre {
namespace {

// Largest value of the register of the commanded speed, which counts tenths.
constexpr double largest_command_e_radps = 3276.7;

void require(bool ok, const std::string &what)
{
    if (!ok) {
        throw InputError("--board: " + what);
    }
}

void check_sensors(const SensorSettings &s, const Drive &drive)
{
    const int lines = drive.encoder.lines;
    require(s.encoder_lines.value_or(lines) == lines,
            fmt::format("the drive file's encoder has {} lines", lines));
    require(s.encoder_index, "the encoder has to have an index");
    require(1U << static_cast<unsigned>(s.adc_bits) == BOARD_ADC_CODES,
            "the converter has 12 bits");
    require(std::abs(s.adc_full_scale_A - drive.current_sensors.range_A) < 1e-6,
            fmt::format("the range of the drive file's current sensors is {:g} A",
                        drive.current_sensors.range_A));
    require(!s.encoder_disc.map_error_rms_cnt,
            "a map of the disc is loaded with an image (sdre-sil serve)");
    require(s.encoder_count_late_s <= 0.0, "the eQEP latches count and time at once");
    require(s.sampling_advance_s <= 0.0, "samples are taken when the period begins");
}

void check_dead_time(const InverterSettings &i, const Drive &drive)
{
    const double gates_s = drive.inverter.dead_time_s;
    const double dead_s  = i.dead_time_s.value_or(gates_s);
    require(dead_s <= 0.0 || std::abs(dead_s - gates_s) < 1e-12,
            fmt::format("the drive file's dead time is {:g} s; another can be 0 only, for an ideal "
                        "inverter",
                        gates_s));
}

} // namespace

BoardScenario for_board(const Scenario &scenario)
{
    BoardScenario b{scenario, 0.0, {}};
    Scenario     &s = b.scenario;
    if (s.sensors.ideal) {
        const bool edge_time        = s.sensors.encoder_edge_time;
        s.sensors                   = sensors_of_drive(s.drive);
        s.sensors.ideal             = false;
        s.sensors.encoder_edge_time = edge_time;
        s.inverter.dead_time_s      = s.inverter.dead_time_s.value_or(0.0);
        b.notes.emplace_back("ideal sensors: run with the board's sensors and an ideal inverter");
    }
    require(s.position_reference.empty(),
            "positions are for the core alone; on the board they come over Modbus (serve)");
    require(s.torque_reference.empty(),
            "torques are for the core alone; on the board they come over Modbus (serve)");
    check_sensors(s.sensors, s.drive);
    require(s.sensors.encoder_edge_time == s.drive.encoder.edge_times,
            "edge times are a matter of the drive file, which the firmware follows");
    if (!s.inverter.dead_time_s) {
        s.inverter.dead_time_s = s.drive.inverter.dead_time_s;
    }
    check_dead_time(s.inverter, s.drive);
    b.dead_time_s = *s.inverter.dead_time_s;
    for (PlantChange &change : s.changes) {
        if (scenario.sensors.ideal && change.sensors && change.sensors->ideal) {
            change.sensors.reset(); // a change names all values; these are replaced above
        }
        if (scenario.sensors.ideal && change.inverter && !change.inverter->dead_time_s) {
            change.inverter->dead_time_s = b.dead_time_s;
        }
        if (change.sensors) {
            require(!change.sensors->ideal, "sensors cannot become ideal");
            check_sensors(*change.sensors, s.drive);
        }
        if (change.inverter) {
            require(change.inverter->dead_time_s.value_or(b.dead_time_s) >= b.dead_time_s,
                    "the dead time cannot become shorter than that of the gates");
        }
    }
    for (const Step &step : s.speed_reference) {
        require(std::abs(step.value) <= largest_command_e_radps,
                fmt::format("a command of {:g} rad/s: at most {:g}", step.value,
                            largest_command_e_radps));
    }
    const bool rounded =
        std::any_of(s.speed_reference.begin(), s.speed_reference.end(), [](const Step &step) {
            return std::abs(0.1 * tenths_of(step.value) - step.value) > 1e-9;
        });
    if (rounded) {
        b.notes.emplace_back("commanded speeds are rounded to 0.1 rad/s");
    }
    return b;
}

int tenths_of(double omega_e_radps)
{
    return static_cast<int>(std::lround(10.0 * omega_e_radps));
}

} // namespace sdre
