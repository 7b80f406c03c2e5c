// SPDX-License-Identifier: MIT
/// The device's pins on the motor bench.
#pragma once

#include "sil/f28335/surroundings.hpp"
#include "sil/run/motor_bench.hpp"

namespace sdre::f28335 {

class MotorSurroundings : public Surroundings {
public:
    /// @param ideal_inverter  The bridge needs no dead time: what the gates leave out is not taken from the voltage.
    /// @param dc_link_range_V Range of the dc link's converter.
    /// @param duty_full_cnt   Compare counts of duty one, for duty_cnt().
    MotorSurroundings(MotorBench &bench, bool ideal_inverter, double dc_link_range_V,
                      int duty_full_cnt);

    void       period_begins(const ControlPeriod &period) override;
    void       legs_change(const std::array<bool, 3> &enabled, double into_period_s) override;
    void       brake_changes(bool high, double into_period_s) override;
    void       chopper_changes(bool on, double into_period_s) override;
    double     analog_V(int side, int number) override;
    ShaftCount shaft(double into_period_s) override;

    /// Duty ratios of the present period, in compare counts, from the edges.
    const std::array<int, 3> &duty_cnt() const
    {
        return duty_cnt_;
    }

private:
    MotorBench        &bench_;
    bool               ideal_inverter_;
    double             dc_link_range_V_;
    int                duty_full_cnt_;
    std::array<int, 3> duty_cnt_{};
};

} // namespace sdre::f28335
