// SPDX-License-Identifier: MIT
/// Control port of a served drive: load, supply, faults, and the true state of the motor. One line
/// of text in, one line of JSON out.
///
///     load 1.2                                   N m, against positive speed
///     dc_link 280                                V of the supply
///     fault kind = "current_zero", phase = "a"   keys as in a scenario's [[fault]], without the time
///     mend                                       nothing is broken any more
///     state                                      the motor now
///     trace 2.0                                  the motor in the last seconds, 20 at most, a sample per millisecond
#pragma once

#include <deque>
#include <string>

#include "sil/serve/served_drive.hpp"

namespace sdre {

/// The last seconds of the motor.
class MotorRecord {
public:
    struct Sample {
        double time_s;
        double omega_e_radps;
        double iq_A;
        double id_A;
        double torque_Nm;
        double load_Nm;
        double dc_link_V;
    };
    /// After each control period.
    void                      note(const ServedDrive &drive);
    const std::deque<Sample> &samples() const
    {
        return samples_;
    }

private:
    std::deque<Sample> samples_;
    double             next_s_ = 0.0;
};

/// Pace of the simulation.
struct PaceReport {
    double speed_factor = 1.0;
    double slipped_s    = 0.0; ///< time that was left out because the machine was late
};

/// Never throws: what is wrong is {"error": ..}.
std::string control_answer(const std::string &line, ServedDrive &drive, const MotorRecord &record,
                           const PaceReport &pace);

} // namespace sdre
