// SPDX-License-Identifier: MIT
#include "tune/added_section.hpp"

#include <optional>

#include "common/errors.hpp"
#include "tune/position_weights.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {

namespace {

/// The section, if the tools read the file with it: its ranges, and the time of a period.
AddedSection readable(const std::string &section, const std::string &text, const std::string &file)
{
    try {
        (void)read_drive_text(text + section, file, file);
    } catch (const InputError &e) {
        return {"", e.what()};
    }
    return {section, ""};
}

} // namespace

AddedSection position_section(const Drive &drive, const std::string &text, const std::string &file)
{
    const std::optional<PositionSpec> position = start_position(drive);
    if (!position) {
        return {"", "with no weight of the angle is it certified; a finer encoder would help"};
    }
    return readable(position_text(*position), text, file);
}

AddedSection torque_section(Drive drive, const std::string &text, const std::string &file)
{
    drive.torque.emplace();
    if (!is_certified(drive)) {
        return {"", "with them it is not certified"};
    }
    return readable("\n# Torques; the weights follow the control period.\n[torque]\n", text, file);
}

} // namespace sdre
