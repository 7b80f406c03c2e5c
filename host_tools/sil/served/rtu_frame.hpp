// SPDX-License-Identifier: MIT
/// Frames of Modbus RTU and Modbus/TCP, as far as a gateway has to know them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace sdre {

using Octets = std::vector<std::uint8_t>;

/// With its checksum.
Octets rtu_frame(Octets unit_and_pdu);

/// Unit and PDU without the checksum; nothing when that is wrong or the frame too short.
std::optional<Octets> rtu_content(const Octets &frame);

/// A request over Modbus/TCP.
struct TcpRequest {
    std::uint16_t transaction = 0;
    Octets        unit_and_pdu;
};

/// Takes one whole request from the front of what has come; nothing when it is not all there yet. Sets `broken` when what
/// is there cannot become one.
std::optional<TcpRequest> take_tcp_request(Octets &come, bool &broken);

Octets tcp_answer(std::uint16_t transaction, const Octets &unit_and_pdu);

} // namespace sdre
