// SPDX-License-Identifier: MIT
/// From register values to the gates of one leg: action qualifier and dead band over one control period.
///
/// The counter counts up and down. A control period runs from TBPRD to TBPRD, with ZERO in its
/// middle. With two updates per PWM period, it is one direction of the counter.
///
///     output(t) = last action at or before t;  in the counter's direction B, A, the counter's own, then the
///                 compares of the other direction                                  EQ-GATES-1
///     delayed rise:  in(t) and t - last rise >= DBRED                              EQ-GATES-2
///     delayed fall:  in(t) or  t - last fall <  DBFED                              EQ-GATES-3
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sdre::f28335 {

/// Directions of the counter in a control period.
enum class Count { down_up, down, up };

/// Compare values that act at the instant of a load. TI's guide does not specify it and gives rules
/// that avoid the case: with loads at PRD no value TBPRD, with loads at ZERO no value 0.
enum class AtLoad { old_values, new_values };

/// Register values of a leg. The compare values are the active ones.
struct LegRegisters {
    int           tbprd  = 0;
    int           cmpa   = 0;
    int           cmpb   = 0;
    std::uint16_t aqctla = 0;
    std::uint16_t aqctlb = 0;
    std::uint16_t dbctl  = 0;
    std::uint16_t dbred  = 0; ///< only ten bits act
    std::uint16_t dbfed  = 0;
    /// Value at the first instant of the period only; none: as above.
    std::optional<int> cmpa_at_start{};
    std::optional<int> cmpb_at_start{};
};

/// Older changes have no effect: a dead band has at most 1023 counts.
constexpr int long_ago_cnt = -100000;

/// The level of a signal and its last changes, in counts before the coming control period (<= 0, >= long_ago_cnt).
struct SignalMemory {
    bool level     = false;
    int  last_rise = long_ago_cnt;
    int  last_fall = long_ago_cnt;
};

struct LegMemory {
    SignalMemory a;
    SignalMemory b;
};

/// A state from a time on; counts since the period's start.
struct SignalEdge {
    int  time_cnt;
    bool level;
};
struct GateEdge {
    int  time_cnt;
    bool upper;
    bool lower;
};

struct LegPeriod {
    std::vector<SignalEdge> a; ///< output of the action qualifier; the first is the state at 0
    std::vector<GateEdge>   gates;
    bool complementary  = false; ///< the dead band makes B from A: edges of `a` plus delays say all
    int  rise_delay_cnt = 0;
    int  fall_delay_cnt = 0;
};

/// Length of a control period in counts.
inline int period_counts(int tbprd, Count count)
{
    return count == Count::down_up ? 2 * tbprd : tbprd;
}

/// One control period; the memory goes on to the next.
LegPeriod leg_period(const LegRegisters &registers, Count count, LegMemory &memory);

/// Shortest time between one switch off and the other on [counts]; negative: both were on at once. None: the leg does
/// not change over. `before` is the last state of the period before.
std::optional<int> shortest_gap_cnt(const std::vector<GateEdge> &gates);

} // namespace sdre::f28335
