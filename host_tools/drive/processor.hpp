// SPDX-License-Identifier: MIT
/// This file tells what the counters and registers of a processor hold. A board file names its processor. No other part of
/// the host tools knows one by name, but its virtual device.
#pragma once

#include <string>

namespace sdre {

struct Drive;

/// Half a PWM period counts up, the other half down.
struct Processor {
    std::string name;        ///< key `processor` of a board file, and a directory of firmware/board
    double      clock_Hz;    ///< its cycles
    double      counter_Hz;  ///< of the PWM
    double      most_cycles; ///< of a PWM period
    double      most_dead_time_cnt; ///< of the counter
    int         adc_bits;
    int         most_positions; ///< of the encoder a turn, four a line

    double cycles_per_cnt() const ///< of half a PWM period: the counter goes up and down
    {
        return 2.0 * clock_Hz / counter_Hz;
    }
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
