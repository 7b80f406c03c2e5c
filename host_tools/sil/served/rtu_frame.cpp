// SPDX-License-Identifier: MIT
#include "sil/served/rtu_frame.hpp"

#include "sil/f28335/modbus_master.hpp"

namespace sdre {
namespace {

constexpr std::size_t crc_octets    = 2;
constexpr std::size_t least_frame   = 4;   // unit, function, checksum
constexpr std::size_t header_octets = 6;   // transaction, protocol, length
constexpr std::size_t longest       = 254; // unit and PDU

} // namespace

Octets rtu_frame(Octets unit_and_pdu)
{
    const std::uint16_t crc = f28335::modbus_crc(unit_and_pdu);
    unit_and_pdu.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    unit_and_pdu.push_back(static_cast<std::uint8_t>(crc >> 8U));
    return unit_and_pdu;
}

std::optional<Octets> rtu_content(const Octets &frame)
{
    if (frame.size() < least_frame) {
        return {};
    }
    const Octets content(frame.begin(), frame.end() - crc_octets);
    if (rtu_frame(content) != frame) {
        return {};
    }
    return content;
}

std::optional<TcpRequest> take_tcp_request(Octets &come, bool &broken)
{
    if (come.size() < header_octets) {
        return {};
    }
    const auto        number = [&come](std::size_t at) { return (come[at] << 8U) | come[at + 1]; };
    const std::size_t length = static_cast<std::size_t>(number(4));
    broken                   = number(2) != 0 || length < 2 || length > longest;
    if (broken || come.size() < header_octets + length) {
        return {};
    }
    const auto begin = come.begin() + header_octets;
    const auto end   = begin + static_cast<std::ptrdiff_t>(length);
    TcpRequest request{static_cast<std::uint16_t>(number(0)), Octets(begin, end)};
    come.erase(come.begin(), end);
    return request;
}

Octets tcp_answer(std::uint16_t transaction, const Octets &unit_and_pdu)
{
    const auto high = [](std::size_t x) { return static_cast<std::uint8_t>(x >> 8U); };
    const auto low  = [](std::size_t x) { return static_cast<std::uint8_t>(x & 0xFFU); };
    Octets     out;
    out.reserve(header_octets + unit_and_pdu.size());
    for (const std::uint8_t octet :
         {high(transaction), low(transaction), std::uint8_t{0}, std::uint8_t{0},
          high(unit_and_pdu.size()), low(unit_and_pdu.size())}) {
        out.push_back(octet);
    }
    for (const std::uint8_t octet : unit_and_pdu) {
        out.push_back(octet);
    }
    return out;
}

} // namespace sdre
