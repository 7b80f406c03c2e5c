// SPDX-License-Identifier: MIT
/// The B-G431B-ESC1 with the motor of the simulation at its pins.
#pragma once

#include "sil/run/motor_bench.hpp"
#include "stm32g431/circuit.hpp"

namespace iss::stm32g431 {

class MotorCircuit : public Circuit {
public:
    /// @param ideal_inverter The bridge needs no dead time: what the gates leave out is not taken from the voltage.
    MotorCircuit(sdre::MotorBench &bench, const sdre::Drive &drive, bool ideal_inverter);

    void   period_begins(const PwmPeriod &period) override;
    void   gates_change(bool enabled, double into_period_s) override;
    Shaft  shaft() override;
    int    code(int converter, int input) override;
    double shunt_V(int phase, double into_period_s) override;

    /// Compare values of the present period.
    const std::array<int, 3> &duty_cnt() const
    {
        return duty_cnt_;
    }
    void set_temperature_degC(double temperature_degC)
    {
        temperature_degC_ = temperature_degC;
    }
    /// The amplifiers' zero, in codes from the middle.
    void set_zero_cnt(int cnt)
    {
        zero_cnt_ = cnt;
    }

private:
    int current_code(int signed_code) const;
    int temperature_code() const;

    sdre::MotorBench      &bench_;
    sdre::BoardDescription board_;
    bool                   ideal_inverter_;
    double                 temperature_degC_ = 25.0;
    int                    zero_cnt_         = 0;
    std::array<int, 3>     duty_cnt_{};
};

} // namespace iss::stm32g431
