// SPDX-License-Identifier: MIT
#include "sil/f28335/can_frame.hpp"

#include <algorithm>

namespace sdre::f28335 {
namespace {

constexpr unsigned base_bits      = 11;
constexpr unsigned extension_bits = 18;
constexpr unsigned length_bits    = 4;
constexpr unsigned crc_bits       = 15;
constexpr unsigned crc_polynomial = 0x4599;
constexpr int      same_bits      = 5; // after so many equal bits a stuff bit follows
constexpr int      tail_bits = 10; // CRC delimiter, acknowledgement with delimiter, end of frame

void append(std::vector<bool> &bits, std::uint32_t value, unsigned count)
{
    for (unsigned n = count; n > 0; n--) {
        bits.push_back(((value >> (n - 1U)) & 1U) != 0U);
    }
}

int stuff_bits(const std::vector<bool> &bits)
{
    int  stuffed = 0;
    int  run     = 0;
    bool last    = !bits.front();
    for (const bool bit : bits) {
        run  = bit == last ? run + 1 : 1;
        last = bit;
        if (run == same_bits) {
            stuffed++;
            last = !bit; // the stuff bit begins the next run
            run  = 1;
        }
    }
    return stuffed;
}

} // namespace

bool operator==(const CanFrame &one, const CanFrame &other)
{
    const auto octets = [](const CanFrame &f) { return f.remote ? 0 : std::min<int>(f.length, 8); };
    return one.id == other.id && one.extended == other.extended && one.remote == other.remote &&
           one.length == other.length &&
           std::equal(one.data.begin(), one.data.begin() + octets(one), other.data.begin());
}

std::vector<bool> can_arbitration_bits(const CanFrame &frame)
{
    std::vector<bool> bits{false};
    if (!frame.extended) {
        append(bits, frame.id, base_bits);
        bits.push_back(frame.remote);
        bits.push_back(false); // identifier extension
        return bits;
    }
    append(bits, frame.id >> extension_bits, base_bits);
    bits.push_back(true); // substitute remote request
    bits.push_back(true);
    append(bits, frame.id, extension_bits);
    bits.push_back(frame.remote);
    return bits;
}

std::vector<bool> can_frame_bits(const CanFrame &frame)
{
    std::vector<bool> bits   = can_arbitration_bits(frame);
    const unsigned    length = std::min<unsigned>(frame.length, 8U);
    append(bits, 0, frame.extended ? 2 : 1); // reserved
    append(bits, length, length_bits);
    for (unsigned n = 0; n < length && !frame.remote; n++) {
        append(bits, frame.data[n], 8);
    }
    append(bits, can_crc(bits), crc_bits);
    return bits;
}

std::uint16_t can_crc(const std::vector<bool> &bits)
{
    unsigned remainder = 0;
    for (const bool bit : bits) {
        const bool out = bit != (((remainder >> (crc_bits - 1U)) & 1U) != 0U);
        remainder      = (remainder << 1U) & 0x7FFFU;
        remainder ^= out ? crc_polynomial : 0U;
    }
    return static_cast<std::uint16_t>(remainder);
}

int can_frame_length_bits(const CanFrame &frame)
{
    const std::vector<bool> bits = can_frame_bits(frame);
    return static_cast<int>(bits.size()) + stuff_bits(bits) + tail_bits;
}

} // namespace sdre::f28335
