// SPDX-License-Identifier: MIT
/// Permanent faults in a run: [[fault]] entries.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "common/toml_reader.hpp"

namespace sdre {

enum class FaultKind {
    tick_hung,        ///< the control interrupt does not end; --board f28335 only
    interrupt_masked, ///< the program masks interrupts and goes on otherwise; --board f28335 only
    trigger_lost,     ///< conversions stop; --board f28335 only
    phase_open,       ///< a motor wire is broken
    current_zero,     ///< a current sensor reads no current
    current_frozen,   ///< a current sensor reads what it read last
    current_drift,    ///< a current sensor's zero moves by value A/s up to limit A
    current_gain,     ///< a current sensor reads value times the current
    encoder_losing,   ///< the counter misses value counts per second
    index_missing     ///< index pulses stop
};

struct InjectedFault {
    double      time_s = 0.0;
    FaultKind   kind   = FaultKind::tick_hung;
    std::size_t phase  = 0;   ///< 0 .. 2
    double      value  = 0.0; ///< see FaultKind
    double      limit  = 0.0;
};

/// The [[fault]] entries.
std::vector<InjectedFault> read_injected_faults(TomlReader &t);

/// "phase_open" and so on.
const char *fault_kind_name(FaultKind kind);

/// Whether it is one of a phase.
bool needs_phase(FaultKind kind);

/// Whether it is one of a current sensor.
bool is_of_a_sensor(FaultKind kind);

/// Whether the kind is one of the processor's, which the core alone has none of.
bool needs_processor(FaultKind kind);

/// The faults that are active at a time.
class InjectedFaults {
public:
    explicit InjectedFaults(std::vector<InjectedFault> entries) : entries_(std::move(entries)) {}

    /// From now on; the time of the entry is that of the present tick.
    void add(InjectedFault entry)
    {
        entry.time_s = time_s_;
        entries_.push_back(entry);
    }
    /// Removes all faults.
    void mend()
    {
        entries_.clear();
    }
    void begin_tick(double time_s)
    {
        time_s_ = time_s;
    }
    /// The entry of this kind, and phase, that holds now; null: none.
    const InjectedFault *active(FaultKind kind, std::size_t phase = 0) const;
    /// Reading of a current sensor for a current; call once per sample.
    double sensed_A(std::size_t phase, double current_A);
    /// Counts that the encoder has lost by now.
    int lost_counts() const;

private:
    std::vector<InjectedFault> entries_;
    double                     time_s_ = 0.0;
    std::array<double, 3>      held_A_{}; ///< of a, b, c: what was sensed last
};

} // namespace sdre
