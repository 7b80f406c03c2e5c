// SPDX-License-Identifier: MIT
/// The last seconds of a served drive's motor.
#pragma once

#include <deque>

#include "sil/served/served_drive.hpp"

namespace sdre {

constexpr double longest_record_s = 20.0;

/// A sample per millisecond of the last seconds.
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

} // namespace sdre
