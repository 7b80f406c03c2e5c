// SPDX-License-Identifier: MIT
/// Diagnostics: misuse of the device that real hardware does not report.
#pragma once

#include <string>
#include <vector>

namespace sdre::f28335 {

enum class Finding {
    eallow,        ///< protected register written without EALLOW; the write has no effect
    no_clock,      ///< register of a unit written while its clock is off; no effect
    unsupported,   ///< a setting that the model lacks; results are then invalid
    clock,         ///< clock tree used out of order or out of range
    adc,           ///< converter used before it is ready, too fast, or triggered while busy
    interrupt,     ///< interrupt without vector, or a group without acknowledge
    trip,          ///< the fault pin is low, but a leg switches or its gates float
    dead_time,     ///< both switches of a leg on, or closer than the bridge needs
    can,           ///< a mailbox or a flag of the CAN controller used against its rules
    flash,         ///< flash changed with interrupts on, or beside the watchdog
    watchdog_reset ///< the device has reset itself
};

class Findings {
public:
    struct Entry {
        Finding     kind;
        std::string text;
        double      time_s;
    };
    /// The same text is kept once.
    void add(Finding kind, const std::string &text, double time_s)
    {
        for (const Entry &e : entries_) {
            if (e.kind == kind && e.text == text) {
                return;
            }
        }
        entries_.push_back({kind, text, time_s});
    }
    bool has(Finding kind) const
    {
        for (const Entry &e : entries_) {
            if (e.kind == kind) {
                return true;
            }
        }
        return false;
    }
    const std::vector<Entry> &all() const
    {
        return entries_;
    }

private:
    std::vector<Entry> entries_;
};

} // namespace sdre::f28335
