// SPDX-License-Identifier: MIT
/// The circuit at the device's pins, as the device sees it.
#pragma once

#include <array>

#include "sil/f28335/encoder_unit.hpp"
#include "sil/f28335/gate_edges.hpp"

namespace sdre::f28335 {

/// The three legs over one control period.
struct ControlPeriod {
    std::array<LegPeriod, 3> legs;
    int                      counts           = 0; ///< length
    int                      cycles_per_count = 1;
    double                   sysclk_Hz        = 150e6;

    double seconds(int time_cnt) const
    {
        return static_cast<double>(time_cnt * cycles_per_count) / sysclk_Hz;
    }
};

class Surroundings {
public:
    Surroundings()                                = default;
    Surroundings(const Surroundings &)            = delete;
    Surroundings &operator=(const Surroundings &) = delete;
    virtual ~Surroundings()                       = default;

    /// The counters are at TBPRD. `period` has the gate signals until they reach TBPRD again.
    virtual void period_begins(const ControlPeriod &period) = 0;
    /// Legs that follow the PWM from now on. The others have both switches off.
    virtual void legs_change(const std::array<bool, 3> &enabled, double into_period_s) = 0;
    /// Level of the holding brake's output, GPIO10, from now on: high releases it.
    virtual void brake_changes(bool high, double into_period_s)
    {
        (void)high;
        (void)into_period_s;
    }
    /// Level of the brake chopper's output, GPIO8, from now on.
    virtual void chopper_changes(bool on, double into_period_s)
    {
        static_cast<void>(on);
        static_cast<void>(into_period_s);
    }
    /// Voltage at a converter input, now: side 0 = A, 1 = B.
    virtual double analog_V(int side, int number) = 0;
    /// The encoder, now.
    virtual ShaftCount shaft(double into_period_s) = 0;
};

} // namespace sdre::f28335
