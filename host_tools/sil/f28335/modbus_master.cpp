// SPDX-License-Identifier: MIT
#include "sil/f28335/modbus_master.hpp"

#include <utility>

namespace sdre::f28335 {
namespace {

constexpr std::uint8_t read_input_function = 4;
constexpr std::uint8_t write_function      = 6;
constexpr std::uint8_t write_many_function = 16;
constexpr std::uint8_t exception_flag      = 0x80;
constexpr std::size_t  exception_length    = 5;

void put_word(std::vector<std::uint8_t> &frame, std::uint16_t word)
{
    frame.push_back(static_cast<std::uint8_t>(word >> 8U));
    frame.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}

} // namespace

std::uint16_t modbus_crc(const std::vector<std::uint8_t> &octets)
{
    // Bit by bit over the reflected polynomial 0x8005.
    unsigned remainder = 0xFFFF;
    for (const std::uint8_t octet : octets) {
        for (unsigned bit = 0; bit < 8; bit++) {
            const bool in = ((octet >> bit) & 1U) != (remainder & 1U);
            remainder     = (remainder >> 1U) ^ (in ? 0xA001U : 0U);
        }
    }
    return static_cast<std::uint16_t>(remainder);
}

void ModbusMaster::send(std::vector<std::uint8_t> frame, std::size_t expected)
{
    const std::uint16_t crc = modbus_crc(frame);
    frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
    for (const std::uint8_t octet : frame) {
        line_.send(octet);
    }
    request_  = std::move(frame);
    expected_ = expected;
    got_.clear();
}

void ModbusMaster::write(std::uint16_t address, std::uint16_t value)
{
    std::vector<std::uint8_t> frame{server_, write_function};
    put_word(frame, address);
    put_word(frame, value);
    send(std::move(frame), 8);
}

void ModbusMaster::write(std::uint16_t first, const std::vector<std::uint16_t> &values)
{
    std::vector<std::uint8_t> frame{server_, write_many_function};
    put_word(frame, first);
    put_word(frame, static_cast<std::uint16_t>(values.size()));
    frame.push_back(static_cast<std::uint8_t>(2U * values.size()));
    for (const std::uint16_t value : values) {
        put_word(frame, value);
    }
    send(std::move(frame), 8);
}

void ModbusMaster::read_input(std::uint16_t address, std::uint16_t count)
{
    std::vector<std::uint8_t> frame{server_, read_input_function};
    put_word(frame, address);
    put_word(frame, count);
    values_.clear();
    send(std::move(frame), 5U + 2U * count);
}

void ModbusMaster::poll()
{
    for (int octet = line_.take(); octet >= 0; octet = line_.take()) {
        got_.push_back(static_cast<std::uint8_t>(octet));
    }
    if (!busy()) {
        errors_ += got_.empty() ? 0 : 1; // unsolicited octets
        got_.clear();
        return;
    }
    const bool exception = got_.size() >= 2 && (got_[1] & exception_flag) != 0U;
    if (got_.size() >= (exception ? exception_length : expected_)) {
        take_answer();
    }
}

void ModbusMaster::take_answer()
{
    const std::size_t               length = got_.size();
    const std::vector<std::uint8_t> body(got_.begin(), got_.end() - 2);
    const unsigned crc  = got_[length - 2] | (static_cast<unsigned>(got_[length - 1]) << 8U);
    const bool     good = length == expected_ && crc == modbus_crc(body) && got_[0] == server_ &&
                      got_[1] == request_[1];
    if (good && got_[1] == read_input_function) {
        for (std::size_t n = 3; n + 1 < body.size(); n += 2) {
            values_.push_back(static_cast<std::uint16_t>((body[n] << 8U) | body[n + 1]));
        }
    }
    (good ? answers_ : errors_)++;
    end_request();
}

} // namespace sdre::f28335
