// SPDX-License-Identifier: MIT
#include "sil/setup/injected_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "sil/setup/sorted_times.hpp"

namespace sdre {
namespace {

constexpr Range  time_range_s{0.0, 1e4};
constexpr Range  rate_range_Aps{-1e6, 1e6};
constexpr Range  offset_range_A{0.0, 1e3};
constexpr Range  gain_range{-10.0, 10.0};
constexpr Range  counts_range_1ps{-1e5, 1e5};
constexpr double same_s = 1e-9; // an entry and a tick that mean the same instant

struct KindName {
    const char *name;
    FaultKind   kind;
    int         phases; ///< that it may have; 0: it has none
};

constexpr std::array<KindName, 10> kinds{{{"tick_hung", FaultKind::tick_hung, 0},
                                          {"interrupt_masked", FaultKind::interrupt_masked, 0},
                                          {"trigger_lost", FaultKind::trigger_lost, 0},
                                          {"phase_open", FaultKind::phase_open, 3},
                                          {"current_zero", FaultKind::current_zero, 3},
                                          {"current_frozen", FaultKind::current_frozen, 3},
                                          {"current_drift", FaultKind::current_drift, 3},
                                          {"current_gain", FaultKind::current_gain, 3},
                                          {"encoder_losing", FaultKind::encoder_losing, 0},
                                          {"index_missing", FaultKind::index_missing, 0}}};

const KindName &named(FaultKind kind)
{
    return *std::find_if(kinds.begin(), kinds.end(),
                         [&](const KindName &k) { return k.kind == kind; });
}

const KindName &read_kind(TomlReader &entry)
{
    const std::string name = entry.text("kind");
    const auto       *found =
        std::find_if(kinds.begin(), kinds.end(), [&](const KindName &k) { return name == k.name; });
    if (found == kinds.end()) {
        std::string all;
        for (const KindName &k : kinds) {
            all += fmt::format("{}\"{}\"", all.empty() ? "" : ", ", k.name);
        }
        entry.fail("kind", fmt::format("= \"{}\" is not allowed: must be one of {}", name, all));
    }
    return *found;
}

std::size_t read_phase(TomlReader &entry, int phases)
{
    const std::string name  = entry.text("phase");
    const std::string known = std::string("abc").substr(0, static_cast<std::size_t>(phases));
    if (name.size() != 1 || known.find(name) == std::string::npos) {
        entry.fail("phase", fmt::format("= \"{}\" is not allowed: must be one of {}", name, known));
    }
    return known.find(name);
}

} // namespace

const char *fault_kind_name(FaultKind kind)
{
    return named(kind).name;
}

bool needs_phase(FaultKind kind)
{
    return named(kind).phases > 0;
}

std::vector<InjectedFault> read_injected_faults(TomlReader &t)
{
    std::vector<InjectedFault> faults;
    for (TomlReader &entry : t.tables("fault")) {
        InjectedFault f;
        f.time_s         = entry.number("time_s", time_range_s);
        const KindName k = read_kind(entry);
        f.kind           = k.kind;
        f.phase          = k.phases > 0 ? read_phase(entry, k.phases) : 0;
        if (f.kind == FaultKind::current_drift) {
            f.value = entry.number("rate_Aps", rate_range_Aps);
            f.limit = entry.number("until_A", offset_range_A);
        } else if (f.kind == FaultKind::current_gain) {
            f.value = entry.number("gain", gain_range);
        } else if (f.kind == FaultKind::encoder_losing) {
            f.value = entry.number("counts_per_s", counts_range_1ps);
        }
        entry.reject_unknown_keys();
        faults.push_back(f);
    }
    require_sorted(t, "fault", faults);
    return faults;
}

bool is_of_a_sensor(FaultKind kind)
{
    return kind == FaultKind::current_zero || kind == FaultKind::current_frozen ||
           kind == FaultKind::current_drift || kind == FaultKind::current_gain;
}

bool needs_processor(FaultKind kind)
{
    return kind == FaultKind::tick_hung || kind == FaultKind::interrupt_masked ||
           kind == FaultKind::trigger_lost;
}

const InjectedFault *InjectedFaults::active(FaultKind kind, std::size_t phase) const
{
    for (const InjectedFault &f : entries_) {
        if (f.kind == kind && f.phase == phase && f.time_s <= time_s_ + same_s) {
            return &f;
        }
    }
    return nullptr;
}

double InjectedFaults::sensed_A(std::size_t phase, double current_A)
{
    double sensed_A = current_A;
    if (active(FaultKind::current_zero, phase) != nullptr) {
        sensed_A = 0.0;
    } else if (active(FaultKind::current_frozen, phase) != nullptr) {
        sensed_A = held_A_[phase];
    } else if (const InjectedFault *gain = active(FaultKind::current_gain, phase)) {
        sensed_A *= gain->value;
    } else if (const InjectedFault *drift = active(FaultKind::current_drift, phase)) {
        sensed_A +=
            std::clamp(drift->value * (time_s_ - drift->time_s), -drift->limit, drift->limit);
    }
    held_A_[phase] = sensed_A;
    return sensed_A;
}

int InjectedFaults::lost_counts() const
{
    const InjectedFault *losing = active(FaultKind::encoder_losing);
    return losing == nullptr
               ? 0
               : static_cast<int>(std::lround(losing->value * (time_s_ - losing->time_s)));
}

} // namespace sdre
