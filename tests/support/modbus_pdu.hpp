// SPDX-License-Identifier: MIT
/// Requests of Modbus for one or several registers, without unit and check sum.
#pragma once

#include <cstdint>
#include <vector>

#include "sil/served/rtu_frame.hpp"

namespace support {

/// Function 16: holding registers from `first` on.
inline sdre::Octets write_pdu(unsigned first, const std::vector<std::uint16_t> &words)
{
    sdre::Octets pdu{
        16, static_cast<std::uint8_t>(first >> 8U),  static_cast<std::uint8_t>(first),
        0,  static_cast<std::uint8_t>(words.size()), static_cast<std::uint8_t>(2 * words.size())};
    for (const unsigned word : words) {
        pdu.push_back(static_cast<std::uint8_t>(word >> 8U));
        pdu.push_back(static_cast<std::uint8_t>(word));
    }
    return pdu;
}

/// True if the answer's PDU says that they are written.
inline bool is_written(const sdre::Octets &answer)
{
    return !answer.empty() && answer[0] == 16;
}

/// One register by function 3, holding, or 4, input.
inline sdre::Octets read_pdu(std::uint8_t function, unsigned number)
{
    return {function, static_cast<std::uint8_t>(number >> 8U), static_cast<std::uint8_t>(number), 0,
            1};
}

/// Its value in the answer's PDU; -1: there is none.
inline int value_of(const sdre::Octets &answer)
{
    return answer.size() == 4 ? 256 * answer[2] + answer[3] : -1;
}

} // namespace support
