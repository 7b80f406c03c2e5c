// SPDX-License-Identifier: MIT
/// The tables of a scenario that describe board, motor effects and load. Every key is optional; what is not
/// given keeps the value it had, so the same functions read a [[change]].
#pragma once

#include <vector>

#include "common/toml_reader.hpp"
#include "sil/setup/board_settings.hpp"
#include "sil/setup/load_settings.hpp"
#include "sil/setup/motor_scale.hpp"

namespace sdre {

struct Drive;

/// Exact signals; everything else from the drive file.
SensorSettings sensors_of_drive(const Drive &drive);

SensorSettings read_sensors(TomlReader t, SensorSettings now, const Drive &drive);
/// The shaft of a coupling whose resonance the drive file knows; else none. The resonance stays where the inertia is
/// `inertia_factor` times the believed one: it was measured on the machine as it is.
MotorEffects effects_of_drive(const Drive &drive, double inertia_factor = 1.0);
/// The keys of the table, on top of `effects`.
MotorEffects     read_motor_effects(TomlReader t, MotorEffects effects);
InverterSettings read_board_inverter(TomlReader t, InverterSettings now, const Drive &drive);

/// An elastic shaft whose oscillation the plant's steps follow, with the motor's inertia so scaled.
void     require_slow_shaft(const TomlReader &t, const MotorEffects &effects, const Drive &drive,
                            const MotorScale &scale);
LoadSine read_load_sine(TomlReader t, LoadSine now);
/// Iron losses are told at the magnet's flux: a motor without one has none.
void require_magnet(const TomlReader &t, const MotorEffects &effects, const Drive &drive);
std::vector<LoadRamp> read_load_ramps(TomlReader &t);

} // namespace sdre
