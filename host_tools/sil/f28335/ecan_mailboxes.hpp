// SPDX-License-Identifier: MIT
/// The mailboxes of eCAN-A as messages: what they send, what they accept, what they store. In eCAN mode.
#pragma once

#include <cstdint>
#include <optional>

#include "sil/f28335/can_frame.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

constexpr int mailboxes = 32;

/// @param number 0 .. 31.
volatile MBOX          &mailbox(int number);
volatile std::uint32_t &time_stamp(int number);

/// The message as it would be sent.
CanFrame mailbox_message(int number);
/// Identifier and acceptance mask fit the frame.
bool mailbox_accepts(int number, const CanFrame &frame);
/// Data beyond the length of the frame become something else, as on the device.
void mailbox_store(int number, const CanFrame &frame);
/// The mailbox among these that is sent first: by TPL, then by number.
std::optional<int> mailbox_first(std::uint32_t candidates);
/// The receive mailbox that takes the frame, or the transmit mailbox that answers it. The highest number comes first.
/// Full ones that are protected are passed over.
std::optional<int> mailbox_for(const CanFrame &frame, std::uint32_t enabled, std::uint32_t full);

} // namespace sdre::f28335
