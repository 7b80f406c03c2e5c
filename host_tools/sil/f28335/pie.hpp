// SPDX-License-Identifier: MIT
/// The interrupt expander: flags, enables, and the acknowledge without which a group stays silent.
#pragma once

#include <cstdint>
#include <optional>

#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

class Pie {
public:
    /// Takes the acknowledges that were written.
    void sync();
    /// A peripheral asks, 1-based group and channel.
    /// @param serving An ISR is running, so that a busy group may still be acknowledged.
    void request(int group, int channel, bool serving, Findings &findings, double time_s);
    /// Vector number of the interrupt to serve now, if any; marks its group as busy and drops its flag.
    std::optional<int> take();

private:
    std::uint16_t busy_ = 0; ///< groups that wait for their acknowledge
};

} // namespace sdre::f28335
