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
    return 1;
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
    if (is(i, 0xFFD0F0F0U, 0xFB90F0F0U)) { // SDIV, UDIV
        return divide;
    }
    return 1;
}

// -- one register to or from memory --

constexpr std::uint32_t counter = 15; // of the program
constexpr std::uint32_t nothing = 16;

struct Access {
    bool          is        = false;
    bool          loads     = false;
    bool          by_offset = false; ///< in a register
    std::uint32_t data      = nothing;
    std::uint32_t base      = nothing;
    std::uint32_t offset    = nothing;
};

Access narrow_access(std::uint32_t i)
{
    const std::uint32_t low = i & 7U;
    if (is(i, 0xF800U, 0x4800U)) {
        return {true, true, false, (i >> 8U) & 7U, counter, nothing};
    }
    if (is(i, 0xF000U, 0x5000U)) {
        return {true, (i & 0xE00U) >= 0x600U, true, low, (i >> 3U) & 7U, (i >> 6U) & 7U};
    }
    if (is(i, 0xE000U, 0x6000U) || is(i, 0xF000U, 0x8000U)) {
        return {true, (i & 0x800U) != 0U, false, low, (i >> 3U) & 7U, nothing};
    }
    if (is(i, 0xF000U, 0x9000U)) {
        return {true, (i & 0x800U) != 0U, false, (i >> 8U) & 7U, 13U, nothing};
    }
    return {};
}

Access wide_access(std::uint32_t i)
{
    if (!is(i, 0xFE000000U, 0xF8000000U)) {
        return {};
    }
    const std::uint32_t base      = (i >> 16U) & 15U;
    const bool          by_offset = base != counter && is(i, 0x00800FC0U, 0U);
    return {true, (i & 0x00100000U) != 0U,      by_offset, (i >> 12U) & 15U,
            base, by_offset ? i & 15U : nothing};
}

/// A store by a constant offset is done while the next instruction runs. A load or store behind a load hides a cycle, unless
/// it needs what was loaded for its address.
std::uint32_t cost_of_access(const Access &a, const Access &before)
{
    const bool          needs = before.data == a.base || before.data == a.offset;
    const std::uint32_t alone = a.loads || a.by_offset ? load : 1U;
    const std::uint32_t jump  = a.loads && a.data == counter ? refill : 0U;
    return (before.loads && !needs ? 1U : alone) + jump;
}

/// A load of the FPU relative to the program counter.
bool is_fpu_literal(std::uint32_t i)
{
    return is(i, 0xFF3F0E00U, 0xED1F0A00U);
}

/// A branch with a condition, or CBZ and CBNZ.
bool is_conditional(std::uint32_t i, bool long_)
{
    return long_ ? is(i, 0xF800D000U, 0xF0008000U) && !is(i, 0x03800000U, 0x03800000U)
                 : is(i, 0xF500U, 0xB100U) || (is(i, 0xF000U, 0xD000U) && !is(i, 0xFE00U, 0xDE00U));
}

std::uint32_t half(const std::uint8_t *code)
{
    return code[0] | (static_cast<std::uint32_t>(code[1]) << 8U);
}

} // namespace

BlockCost cost_of(const std::uint8_t *code, std::size_t octets)
{
    BlockCost cost;
    Access    before;
    for (std::size_t at = 0; at + 2 <= octets;) {
        const std::uint32_t first = half(code + at);
        const bool          long_ = (first >> 11U) >= 0x1DU && at + 4 <= octets;
        const std::uint32_t i     = long_ ? (first << 16U) | half(code + at + 2) : first;
        const Access        now   = long_ ? wide_access(i) : narrow_access(i);
        cost.cycles += now.is ? cost_of_access(now, before) : long_ ? wide(i) : narrow(i);
        cost.uses_fpu = cost.uses_fpu || (long_ && is_fpu(i));
        cost.literals +=
            (now.loads && now.base == counter) || (long_ && is_fpu_literal(i)) ? 1U : 0U;
        cost.not_taken = is_conditional(i, long_) ? refill : 0U;
        cost.instructions++;
        before = now;
        at += long_ ? 4 : 2;
    }
    return cost;
}

} // namespace iss
