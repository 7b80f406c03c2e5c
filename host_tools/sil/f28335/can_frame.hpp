// SPDX-License-Identifier: MIT
/// A frame of a CAN bus (ISO 11898-1, classical), and its bits on the wire.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace sdre::f28335 {

struct CanFrame {
    std::uint32_t id       = 0; ///< 11 bits, or 29 when extended
    bool          extended = false;
    bool          remote   = false;
    std::uint8_t  length   = 0; ///< octets, 0 .. 8; of a remote frame those that it asks for
    std::array<std::uint8_t, 8> data{};
};

/// Same identifier and content; octets beyond the length do not count.
bool operator==(const CanFrame &one, const CanFrame &other);

/// Start of frame to CRC sequence without stuff bits; true is recessive.
std::vector<bool> can_frame_bits(const CanFrame &frame);
/// The bits that decide who goes on: start of frame to identifier extension, or to the second request bit.
std::vector<bool> can_arbitration_bits(const CanFrame &frame);
/// Remainder over x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1.
std::uint16_t can_crc(const std::vector<bool> &bits);
/// Bits of the frame on the wire, stuff bits and end of frame included, without intermission.
int can_frame_length_bits(const CanFrame &frame);

} // namespace sdre::f28335
