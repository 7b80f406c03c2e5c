// SPDX-License-Identifier: MIT
/// Cycles of straight code on a Cortex-M4F, from the instruction table of its technical reference manual (ARM DDI 0439,
/// 3.3.1, 3.3.2 and 7.2.3). Not counted: waits of the flash, an FPU result that the next instruction needs, and an address
/// that the instruction before has computed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iss {

struct BlockCost {
    std::uint32_t cycles       = 0;
    std::uint32_t instructions = 0;
    std::uint32_t literals     = 0; ///< loads from the code's own memory
    std::uint32_t not_taken    = 0; ///< less, if what follows in memory comes next
    bool          uses_fpu     = false;
};

/// A block of Thumb code: it ends with its first branch, which is counted as taken.
/// @param code Its octets, a whole number of instructions.
BlockCost cost_of(const std::uint8_t *code, std::size_t octets);

} // namespace iss
