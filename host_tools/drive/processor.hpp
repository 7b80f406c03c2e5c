// SPDX-License-Identifier: MIT
/// This file tells what the counters and registers of a processor hold. A board file names its processor. No other part of
/// the host tools knows one by name, but its virtual device.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sdre {

struct Drive;

/// Dead times from `least_cnt` to `most_cnt` in steps from 0.
struct DeadTimeRange {
    double least_cnt;
    double most_cnt;
    double step_cnt;
};

/// Half a PWM period counts up, the other half down.
struct Processor {
    std::string name;        ///< key `processor` of a board file, and a directory of firmware/board
    double      clock_Hz;    ///< its cycles
    double      counter_Hz;  ///< of the PWM
    double      most_cycles; ///< of a PWM period
    std::vector<DeadTimeRange> dead_times; ///< that its PWM makes, upwards
    int                        adc_bits;
    int                        most_positions; ///< of the encoder a turn, four a line
    int                        most_updates;   ///< of the voltage in a PWM period
    bool                       has_chopper_pin;
    bool                       has_cycle_budget; ///< cycle_budget.hpp is of this processor
    /// Address of the store's first word, where addresses count words of 16 bits and each is written by itself.
    std::optional<std::uint32_t> store_address;

    double cycles_per_cnt() const ///< of half a PWM period: the counter goes up and down
    {
        return 2.0 * clock_Hz / counter_Hz;
    }
    double least_dead_time_cnt() const
    {
        return dead_times.front().least_cnt;
    }
    double most_dead_time_cnt() const
    {
        return dead_times.back().most_cnt;
    }
    /// The shortest dead time that is no less than `wanted`; nothing: there is none.
    std::optional<double> dead_time_cnt(double wanted) const;
};

/// The processor of this name; nullptr: none.
const Processor *find_processor(const std::string &name);

/// "a, b".
std::string processor_names();

/// The one that a board file without the key has, and a drive without board.
const Processor &default_processor();

/// The one on the drive's board.
const Processor &processor_of(const Drive &drive);

} // namespace sdre
