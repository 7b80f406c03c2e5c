// SPDX-License-Identifier: MIT
#include "cycle_table.hpp"

#include <bitset>

namespace iss {
namespace {

constexpr std::uint32_t refill = 2; // of the pipeline after a branch: the manual says 1 to 3
constexpr std::uint32_t load   = 2;
constexpr std::uint32_t divide = 7;  // 2 to 12, with the operands
constexpr std::uint32_t root   = 14; // VSQRT and VDIV
constexpr std::uint32_t fused  = 3;  // VMLA, VFMA and their kin

std::uint32_t ones(std::uint32_t bits)
{
    return static_cast<std::uint32_t>(std::bitset<32>(bits).count());
}

bool is(std::uint32_t value, std::uint32_t mask, std::uint32_t of)
{
    return (value & mask) == of;
}

// -- 16 bits --

std::uint32_t narrow(std::uint32_t i)
{
    if (is(i, 0xF500U, 0xB100U)) { // CBZ, CBNZ
        return 1 + refill;
    }
    if (is(i, 0xFE00U, 0xB400U)) { // PUSH
        return 1 + ones(i & 0x1FFU);
    }
    if (is(i, 0xFE00U, 0xBC00U)) { // POP
        return 1 + ones(i & 0x1FFU) + ((i & 0x100U) != 0U ? refill : 0);
    }
    if (is(i, 0xF000U, 0xC000U)) { // LDM, STM
        return 1 + ones(i & 0xFFU);
    }
    if (is(i, 0xF000U, 0xD000U) || is(i, 0xF800U, 0xE000U) ||
        is(i, 0xFF00U, 0x4700U)) { // B, BX, BLX
        return 1 + refill;
    }
    const bool moves_data = is(i, 0xF800U, 0x4800U) || is(i, 0xF000U, 0x5000U) ||
                            is(i, 0xE000U, 0x6000U) || is(i, 0xF000U, 0x8000U) ||
                            is(i, 0xF000U, 0x9000U);
    return moves_data ? load : 1;
}

// -- 32 bits: both halves, the first one high --

bool is_fpu(std::uint32_t i)
{
    return is(i, 0xEC000E00U, 0xEC000A00U);
}

std::uint32_t fpu(std::uint32_t i)
{
    if (is(i, 0xFE000E00U, 0xEC000A00U)) {
        const std::uint32_t words = i & 0xFFU;
        const bool          single =
            is(i, 0x01200000U, 0x01000000U); // VLDR, VSTR; else a list, or two registers
        return single ? load : 1 + (is(i, 0x01E00000U, 0x00400000U) ? 2U : words);
    }
    if (is(i, 0xEFB00C50U, 0xEE800800U) || is(i, 0xEFBF0ED0U, 0xEEB10AC0U)) { // VDIV, VSQRT
        return root;
    }
    const bool multiplies_too = is(i, 0xEFB00E10U, 0xEE000A00U) ||
                                is(i, 0xEFB00E10U, 0xEE100A00U) ||
                                is(i, 0xEFA00E10U, 0xEEA00A00U) || is(i, 0xEFB00E10U, 0xEE900A00U);
    return multiplies_too ? fused : 1;
}

std::uint32_t wide(std::uint32_t i)
{
    if (is_fpu(i)) {
        return fpu(i);
    }
    if (is(i, 0xFE400000U, 0xE8000000U)) { // LDM, STM
        const bool branches = is(i, 0x00108000U, 0x00108000U);
        return 1 + ones(i & 0xFFFFU) + (branches ? refill : 0);
    }
    if (is(i, 0xFFF0FFE0U, 0xE8D0F000U)) { // TBB, TBH
        return load + refill;
    }
    if (is(i, 0xFE400000U, 0xE8400000U)) { // LDRD, STRD, exclusive
        return 3;
    }
    if (is(i, 0xF8008000U, 0xF0008000U)) {
        const bool system =
            is(i, 0xD000U, 0x8000U) && is(i, 0x03800000U, 0x03800000U); // MSR, MRS, barriers
        return system ? 2 : 1 + refill;                                 // B, BL
    }
    if (is(i, 0xFE000000U, 0xF8000000U)) { // one register to or from memory
        const bool jumps = is(i, 0x0010F000U, 0x0010F000U);
        return load + (jumps ? refill : 0);
    }
    if (is(i, 0xFFD0F0F0U, 0xFB90F0F0U)) { // SDIV, UDIV
        return divide;
    }
    return 1;
}

std::uint32_t half(const std::uint8_t *code)
{
    return code[0] | (static_cast<std::uint32_t>(code[1]) << 8U);
}

} // namespace

BlockCost cost_of(const std::uint8_t *code, std::size_t octets)
{
    BlockCost cost;
    for (std::size_t at = 0; at + 2 <= octets;) {
        const std::uint32_t first = half(code + at);
        const bool          long_ = (first >> 11U) >= 0x1DU && at + 4 <= octets;
        if (long_) {
            const std::uint32_t both = (first << 16U) | half(code + at + 2);
            cost.cycles += wide(both);
            cost.uses_fpu = cost.uses_fpu || is_fpu(both);
        } else {
            cost.cycles += narrow(first);
        }
        cost.instructions++;
        at += long_ ? 4 : 2;
    }
    return cost;
}

} // namespace iss
