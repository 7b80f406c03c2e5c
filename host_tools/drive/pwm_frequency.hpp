// SPDX-License-Identifier: MIT
/// PWM frequencies that a processor's counter has: it counts up and down, so that a period is an even number of counts.
#pragma once

#include <string>

namespace sdre {

struct Drive;
struct Inverter;
struct Processor;

/// The nearest number of counts in half a period, as a whole number. EQ-BOARD-1
double pwm_full_cnt(const Processor &processor, double pwm_Hz);

/// The frequency of so many counts.
double counted_pwm_Hz(const Processor &processor, double full_cnt);

/// Counts in half a period: at least what the whole period's cycles take, where they are recorded, at most what the processor allows. EQ-BOARD-6
struct FullCountRange {
    double least;
    double most;
};
FullCountRange pwm_full_cnt_range(const Drive &drive);

/// Why a drive cannot have this frequency, with both ends of what it can; empty when it can.
std::string pwm_refusal(const Drive &drive, double pwm_Hz);

/// That no cycles of a control period are recorded for the drive's processor, as a line; else nothing.
std::string cycles_note(const Drive &drive);

/// "5000 Hz", or "7999.147 Hz, the nearest to 8000 Hz that the counter has".
std::string pwm_words(const Inverter &inverter);

/// "PWM at ..." as a line, where the frequency is not the one of the drive file; else nothing.
std::string pwm_note(const Inverter &inverter);

} // namespace sdre
