// SPDX-License-Identifier: MIT
/// CPU timer 0: counts SYSCLKOUT down.
#pragma once

#include <cstdint>

namespace sdre::f28335 {

class CpuTimer {
public:
    void sync();
    /// True when it reached zero with its interrupt enabled.
    bool step(std::int64_t cycles);

private:
    void present();

    std::int64_t  count_         = 0xFFFF;
    std::int64_t  prescaled_     = 0;
    std::uint32_t presented_tim_ = 0xFFFF;
    bool          flag_          = false;
};

} // namespace sdre::f28335
