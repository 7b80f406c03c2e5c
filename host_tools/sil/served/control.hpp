// SPDX-License-Identifier: MIT
/// Control port of a served drive: load, supply, faults, and the true state of the motor. One line
/// of text in, one line of JSON out.
///
///     load 1.2                                   N m of a brake: against the motion, it holds at rest
///     load -1.2 active                           N m against positive speed, whatever the shaft does
///     dc_link 280                                V of the supply
///     fault kind = "current_zero", phase = "a"   keys as in a scenario's [[fault]], without the time
///     can open                                   a fault of the CAN cable: open, shorted, dominant; none
///     holding_brake 3 0.05 0.03                  N m of a brake at the drive's output, s to release and to close; 0: none
///     mend                                       nothing is broken, load 0; without the bridge the shaft comes to rest
///     power_cycle                                off and on
///     state                                      the motor and the bench now
///     trace 2.0                                  the motor in the last seconds, 20 at most, a sample per millisecond
#pragma once

#include <optional>
#include <string>

#include "sil/served/motor_record.hpp"
#include "sil/served/pace.hpp"
#include "sil/served/served_drive.hpp"

namespace sdre {

/// The server's own part of the state.
struct ServerReport {
    Pace               pace;
    std::optional<int> tcp_port; ///< of Modbus/TCP: which drive this is the bench of
};

/// Never throws: what is wrong is {"error": ..}.
std::string control_answer(const std::string &line, ServedDrive &drive, const MotorRecord &record,
                           const ServerReport &server);

} // namespace sdre
