// SPDX-License-Identifier: MIT
#include "sil/run/faults.hpp"

#include <iterator>

#include "drive/core_types.hpp"

namespace sdre {
namespace {

const char *app_fault_name(int fault)
{
    // In the order of app_fault_t, which is part of the serial protocol.
    static const char *const names[] = {"none",
                                        "application: constant out of range",
                                        "application: board fault",
                                        "application: background stands still",
                                        "application: invalid sample",
                                        "application: current offset",
                                        "application: temperature sensor",
                                        "application: temperature",
                                        "application: index out of place",
                                        "application: alignment",
                                        "application: drive",
                                        "application: ticks stood still",
                                        "application: heat",
                                        "application: memory has changed"};
    return fault >= 0 && fault < static_cast<int>(std::size(names)) ? names[fault] : "unknown";
}

} // namespace

const char *fault_name(int fault)
{
    if (fault == device_reset_fault) {
        return "reset by the watchdog";
    }
    if (fault == runaway_fault) {
        return "the motor runs away: half an electrical turn or more per control period";
    }
    if (fault >= app_fault_base) {
        return app_fault_name(fault - app_fault_base);
    }
    switch (static_cast<drive_fault_t>(fault)) {
    case DRIVE_FAULT_NONE:
        return "none";
    case DRIVE_FAULT_SAMPLE:
        return "invalid sample";
    case DRIVE_FAULT_OVER_CURRENT:
        return "over current";
    case DRIVE_FAULT_DC_LINK:
        return "dc link out of range";
    case DRIVE_FAULT_OVER_SPEED:
        return "over speed";
    case DRIVE_FAULT_ENCODER:
        return "encoder implausible";
    case DRIVE_FAULT_COMMAND:
        return "command out of range";
    case DRIVE_FAULT_NUMERIC:
        return "law not a number";
    case DRIVE_FAULT_CURRENT_SENSOR:
        return "current sensor implausible";
    case DRIVE_FAULT_PHASE:
        return "phase without current";
    case DRIVE_FAULT_MODEL:
        return "voltage implausible: encoder or current sensor";
    case DRIVE_FAULT_STALL:
        return "stall";
    case DRIVE_FAULT_AWAY:
        return "the speed leaves its command";
    case DRIVE_FAULT_MEMORY:
        return "memory has changed";
    }
    return "unknown";
}

} // namespace sdre
