// SPDX-License-Identifier: MIT
#include "sil/board/board_scenario.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/setup/board_reader.hpp"

extern "C" {
#include "board_config.h"
#include "board_limits.h"
#include "f28335/clock_tree.h"
}

namespace sdre {
namespace {

constexpr double board_pwm_Hz      = CLOCK_PWM_Hz;
constexpr double board_dead_time_s = CLOCK_DEAD_TIME_us * 1e-6;
constexpr int    board_lines       = BOARD_POSITIONS / 4;

/// Either way from the middle of the converter's codes.
double board_full_scale_A()
{
    return 0.5 * BOARD_ADC_CODES * static_cast<double>(board_config.scale.current_A_per_cnt);
}

void require(bool ok, const std::string &what)
{
    if (!ok) {
        throw InputError("--board: " + what);
    }
}

void check_sensors(const SensorSettings &s, int lines)
{
    require(s.encoder_lines.value_or(lines) == board_lines,
            fmt::format("the encoder has to have {} lines", board_lines));
    require(s.encoder_index, "the encoder has to have an index");
    require(1U << static_cast<unsigned>(s.adc_bits) == BOARD_ADC_CODES,
            "the converter has 12 bits");
    require(std::abs(s.adc_full_scale_A - board_full_scale_A()) < 1e-6,
            fmt::format("the currents' range is {:g} A", board_full_scale_A()));
    require(s.sampling_advance_s <= 0.0, "samples are taken when the period begins");
}

void check_dead_time(const InverterSettings &i)
{
    const double dead_s = i.dead_time_s.value_or(board_dead_time_s);
    require(dead_s <= 0.0 || std::abs(dead_s - board_dead_time_s) < 1e-12,
            fmt::format("the dead time is {} us, or 0 for an ideal inverter", CLOCK_DEAD_TIME_us));
}

} // namespace

BoardScenario for_board(const Scenario &scenario)
{
    BoardScenario b{scenario, 0.0, {}};
    Scenario     &s = b.scenario;
    require(std::abs(s.drive.inverter.pwm_frequency_Hz - board_pwm_Hz) < 1e-6 &&
                s.drive.inverter.updates_per_period <= static_cast<int>(BOARD_UPDATES_MAX),
            fmt::format("the board's PWM runs at {:g} kHz", 1e-3 * board_pwm_Hz));
    if (s.sensors.ideal) {
        const bool edge_time        = s.sensors.encoder_edge_time;
        s.sensors                   = sensors_of_drive(s.drive);
        s.sensors.ideal             = false;
        s.sensors.encoder_edge_time = edge_time;
        s.inverter.dead_time_s      = s.inverter.dead_time_s.value_or(0.0);
        b.notes.emplace_back("ideal sensors: run with the board's sensors and an ideal inverter");
    }
    check_sensors(s.sensors, s.drive.encoder.lines);
    require(s.sensors.encoder_edge_time == s.drive.encoder.edge_times,
            "edge times are a matter of the drive file, which the firmware follows");
    if (!s.inverter.dead_time_s) {
        s.inverter.dead_time_s = s.drive.inverter.dead_time_s;
    }
    check_dead_time(s.inverter);
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
            check_sensors(*change.sensors, s.drive.encoder.lines);
        }
        if (change.inverter) {
            require(change.inverter->dead_time_s.value_or(b.dead_time_s) >= b.dead_time_s,
                    "the dead time cannot become shorter than that of the gates");
        }
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
