// SPDX-License-Identifier: MIT
#include "sil/f28335/ecan_mailboxes.hpp"

#include <algorithm>

namespace sdre::f28335 {
namespace {

constexpr std::uint32_t identifier_bits = 0x1FFFFFFF;
constexpr std::uint32_t standard_bits   = 0x1FFC0000;
constexpr unsigned      standard_shift  = 18;
constexpr std::uint32_t extended_flag   = 0x80000000;
constexpr std::uint32_t stale           = 0xA5A5A5A5; // chosen: data that nobody has sent

bool is_set(std::uint32_t word, int bit)
{
    return ((word >> static_cast<unsigned>(bit)) & 1U) != 0U;
}

/// Place of an octet: DBO = 1 begins with the least significant one of MDL.
unsigned shift_of(unsigned octet)
{
    const unsigned place = octet % 4U;
    return 8U * (ECanaRegs.CANMC.bit.DBO != 0U ? place : 3U - place);
}

volatile std::uint32_t &data_word(int number, unsigned octet)
{
    return octet < 4U ? mailbox(number).MDL.all : mailbox(number).MDH.all;
}

std::uint32_t msgid_of(const CanFrame &frame)
{
    return frame.extended ? extended_flag | frame.id : frame.id << standard_shift;
}

} // namespace

volatile MBOX &mailbox(int number)
{
    return reinterpret_cast<volatile MBOX *>(&ECanaMboxes)[number];
}

volatile std::uint32_t &time_stamp(int number)
{
    return reinterpret_cast<volatile std::uint32_t *>(&ECanaMOTSRegs)[number];
}

CanFrame mailbox_message(int number)
{
    const volatile MBOX &box = mailbox(number);
    const std::uint32_t  id  = box.MSGID.all;
    CanFrame             frame;
    frame.extended = (id & extended_flag) != 0U;
    frame.id       = (id & identifier_bits) >> (frame.extended ? 0U : standard_shift);
    frame.remote   = box.MSGCTRL.bit.RTR != 0U;
    frame.length   = static_cast<std::uint8_t>(std::min<unsigned>(box.MSGCTRL.bit.DLC, 8U));
    for (unsigned n = 0; n < 8; n++) {
        frame.data[n] = static_cast<std::uint8_t>(data_word(number, n) >> shift_of(n));
    }
    return frame;
}

bool mailbox_accepts(int number, const CanFrame &frame)
{
    const std::uint32_t own   = mailbox(number).MSGID.all;
    const bool          masks = mailbox(number).MSGID.bit.AME != 0U;
    const std::uint32_t mask =
        masks ? reinterpret_cast<const volatile std::uint32_t *>(&ECanaLAMRegs)[number] : 0U;
    const bool any_kind = (mask & extended_flag) != 0U;
    const bool kind     = ((own & extended_flag) != 0U) == frame.extended;
    const auto compared = frame.extended ? identifier_bits : standard_bits;
    return (any_kind || kind) && ((own ^ msgid_of(frame)) & compared & ~mask) == 0U;
}

void mailbox_store(int number, const CanFrame &frame)
{
    volatile MBOX          &box  = mailbox(number);
    constexpr std::uint32_t kept = 0x60000000; // AME, AAM
    const std::uint32_t     other =
        frame.extended ? 0U : box.MSGID.all & (identifier_bits ^ standard_bits);
    box.MSGID.all       = (box.MSGID.all & kept) | msgid_of(frame) | other;
    box.MSGCTRL.bit.DLC = frame.length & 0xFU;
    box.MSGCTRL.bit.RTR = frame.remote ? 1U : 0U;
    if (frame.remote) {
        return;
    }
    box.MDL.all = stale;
    box.MDH.all = stale;
    for (unsigned n = 0; n < frame.length && n < 8U; n++) {
        volatile std::uint32_t &word  = data_word(number, n);
        const unsigned          shift = shift_of(n);
        word = (word & ~(0xFFU << shift)) | (std::uint32_t{frame.data[n]} << shift);
    }
}

std::optional<int> mailbox_first(std::uint32_t candidates)
{
    std::optional<int> first;
    for (int n = mailboxes - 1; n >= 0; n--) {
        if (is_set(candidates, n) &&
            (!first || mailbox(n).MSGCTRL.bit.TPL > mailbox(*first).MSGCTRL.bit.TPL)) {
            first = n;
        }
    }
    return first;
}

std::optional<int> mailbox_for(const CanFrame &frame, std::uint32_t enabled, std::uint32_t full)
{
    for (int n = mailboxes - 1; n >= 0; n--) {
        const bool receives = is_set(ECanaRegs.CANMD.all, n);
        if (!is_set(enabled, n) || (!receives && !frame.remote) || !mailbox_accepts(n, frame)) {
            continue;
        }
        if (!receives) { // a request ends the search, answered or not
            return mailbox(n).MSGID.bit.AAM != 0U ? std::optional<int>(n) : std::nullopt;
        }
        if (!is_set(full & ECanaRegs.CANOPC.all, n)) {
            return n;
        }
    }
    return std::nullopt;
}

} // namespace sdre::f28335
