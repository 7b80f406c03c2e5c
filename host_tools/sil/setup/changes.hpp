// SPDX-License-Identifier: MIT
/// Changes of motor, board and load in a run.
#pragma once

#include <optional>
#include <vector>

#include "common/toml_reader.hpp"
#include "sil/setup/board_settings.hpp"
#include "sil/setup/load_settings.hpp"
#include "sil/setup/motor_scale.hpp"

namespace sdre {

/// Motor, board or load change at a time. A table that is there holds all values from then on, not only
/// the keys that the file names.
struct PlantChange {
    double                          time_s = 0.0;
    MotorScale                      plant_scale; ///< replaces the scale before when changes_plant
    bool                            changes_plant = true;
    std::optional<SensorSettings>   sensors;
    int                             lost_counts = 0; ///< the encoder's counter misses these, now
    std::optional<InverterSettings> inverter;
    std::optional<LoadSine>         load_sine;
};

/// The [[change]] entries; `start` is what holds before the first.
std::vector<PlantChange> read_changes(TomlReader &t, const PlantChange &start, const Drive &drive);

} // namespace sdre
