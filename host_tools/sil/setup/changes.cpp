// SPDX-License-Identifier: MIT
#include "sil/setup/changes.hpp"

#include "sil/setup/board_reader.hpp"
#include "sil/setup/sorted_times.hpp"

namespace sdre {

namespace {

constexpr Range time_range_s{0.0, 1e4};
constexpr Range counts_range{-1e6, 1e6};

PlantChange read_change_set(TomlReader set, const PlantChange &before, const Drive &drive)
{
    PlantChange change;
    change.sensors       = before.sensors;
    change.inverter      = before.inverter;
    change.load_sine     = before.load_sine;
    const bool other     = set.has("sensors") || set.has("inverter") || set.has("load_sine");
    change.changes_plant = set.has("plant_scale") || !other; // without any of them it is missing
    if (change.changes_plant) {
        change.plant_scale = read_scale(set.table("plant_scale"));
    }
    if (std::optional<TomlReader> sensors = set.table_if("sensors")) {
        change.lost_counts = sensors->integer_or("lost_counts", counts_range, 0);
        change.sensors     = read_sensors(*sensors, *before.sensors, drive);
    }
    if (std::optional<TomlReader> inverter = set.table_if("inverter")) {
        change.inverter = read_board_inverter(*inverter, *before.inverter, drive);
    }
    if (std::optional<TomlReader> sine = set.table_if("load_sine")) {
        change.load_sine = read_load_sine(*sine, *before.load_sine);
    }
    set.table_if("plant_scale");
    set.reject_unknown_keys();
    return change;
}

} // namespace

std::vector<PlantChange> read_changes(TomlReader &t, const PlantChange &start, const Drive &drive)
{
    std::vector<PlantChange> changes;
    PlantChange              now = start; // what a partial table adds to
    for (TomlReader &entry : t.tables("change")) {
        const double time_s = entry.number("time_s", time_range_s);
        now                 = read_change_set(entry.table("set"), now, drive);
        now.time_s          = time_s;
        entry.reject_unknown_keys();
        changes.push_back(now);
    }
    require_sorted(t, "change", changes);
    return changes;
}

} // namespace sdre
