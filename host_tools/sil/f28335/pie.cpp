// SPDX-License-Identifier: MIT
#include "sil/f28335/pie.hpp"

#include <fmt/format.h>

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {
namespace {

// PIEIERn and PIEIFRn alternate from the third word on.
volatile std::uint16_t &enable_of(int group)
{
    return (&PieCtrlRegs.PIEIER1.all)[2 * (group - 1)];
}

volatile std::uint16_t &flag_of(int group)
{
    return (&PieCtrlRegs.PIEIER1.all)[2 * (group - 1) + 1];
}

constexpr int groups       = 12;
constexpr int first_of_pie = 32; // vectors below belong to the core
constexpr int per_group    = 8;

} // namespace

void Pie::sync()
{
    busy_                  = static_cast<std::uint16_t>(busy_ & ~PieCtrlRegs.PIEACK.all);
    PieCtrlRegs.PIEACK.all = 0; // reads as nothing pending, so that every written 1 shows
}

void Pie::request(int group, int channel, bool serving, Findings &findings, double time_s)
{
    const auto     bit       = static_cast<std::uint16_t>(1U << (channel - 1));
    const unsigned group_bit = 1U << (group - 1);
    const bool     armed     = (enable_of(group) & bit) != 0U && (IER & group_bit) != 0U;
    if (armed && !serving && (busy_ & group_bit) != 0U) {
        findings.add(Finding::interrupt,
                     fmt::format("PIE {}.{} asks while its group waits for PIEACK", group, channel),
                     time_s);
    }
    flag_of(group) = static_cast<std::uint16_t>(flag_of(group) | bit);
}

std::optional<int> Pie::take()
{
    if (PieCtrlRegs.PIECTRL.bit.ENPIE == 0U) {
        return std::nullopt;
    }
    for (int group = 1; group <= groups; group++) {
        const unsigned group_bit = 1U << (group - 1);
        const unsigned pending   = flag_of(group) & enable_of(group);
        if (pending == 0U || (IER & group_bit) == 0U || (busy_ & group_bit) != 0U) {
            continue;
        }
        int channel = 0;
        while (((pending >> channel) & 1U) == 0U) {
            channel++;
        }
        flag_of(group) = static_cast<std::uint16_t>(flag_of(group) & ~(1U << channel));
        busy_          = static_cast<std::uint16_t>(busy_ | group_bit);
        return first_of_pie + per_group * (group - 1) + channel;
    }
    return std::nullopt;
}

} // namespace sdre::f28335
