// SPDX-License-Identifier: MIT
/// The circuit around the chip.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace iss::stm32g431 {

struct Edge {
    double age_s; ///< before the latch
    int    direction;
};

struct Shaft {
    std::int64_t      count       = 0;
    bool              index       = false; ///< its mark passed since the latch before
    std::int64_t      index_count = 0;
    bool              phase_error = false;
    std::vector<Edge> edges; ///< since the latch before, in their order
};

/// One PWM period from the counter's top to the next. The upper switch of a leg is on while the counter is below on_cnt.
struct PwmPeriod {
    std::array<int, 3> on_cnt{};
    int                full_cnt    = 0;
    double             count_s     = 0.0;
    double             dead_time_s = 0.0;
};

class Circuit {
public:
    Circuit()                           = default;
    Circuit(const Circuit &)            = delete;
    Circuit &operator=(const Circuit &) = delete;
    virtual ~Circuit()                  = default;

    /// The counter is at its top: the period before is over, and its end is what shaft() and code() tell.
    virtual void  period_begins(const PwmPeriod &period)           = 0;
    virtual void  gates_change(bool enabled, double into_period_s) = 0;
    virtual Shaft shaft()                                          = 0;
    /// 12-bit code at an input of a converter, 1 or 2.
    virtual int code(int converter, int input) = 0;
    /// At the pin that amplifier and comparator of a phase share, this long after the counter's top.
    virtual double shunt_V(int phase, double into_period_s)
    {
        (void)phase;
        (void)into_period_s;
        return no_current_V;
    }

    static constexpr double no_current_V =
        0.9 / 7.0; // docs/hardware_stm32g431.md, "Analog scaling"
};

} // namespace iss::stm32g431
