// SPDX-License-Identifier: MIT
#include "sil/served/slcan.hpp"

#include <cmath>

#include <fmt/format.h>

namespace sdre {
namespace {

using f28335::CanFrame;

constexpr double      rates_Hz[]   = {10e3, 20e3, 50e3, 100e3, 125e3, 250e3, 500e3, 800e3, 1e6};
constexpr std::size_t longest_line = 64; // chosen: the longest command has 26 characters
constexpr char        cr           = '\r';
const std::string     good         = "\r";
const std::string     bad          = "\a";

/// Value of hexadecimal digits; nothing: something else is among them, or the line is too short.
std::optional<std::uint32_t> hex(const std::string &line, std::size_t first, std::size_t digits)
{
    std::uint32_t value = 0;
    if (line.size() < first + digits) {
        return std::nullopt;
    }
    for (const char c : line.substr(first, digits)) {
        const bool     digit = c >= '0' && c <= '9';
        const bool     upper = c >= 'A' && c <= 'F';
        const bool     lower = c >= 'a' && c <= 'f';
        const unsigned base  = digit ? '0' : upper ? 'A' - 10U : 'a' - 10U;
        if (!digit && !upper && !lower) {
            return std::nullopt;
        }
        value = value * 16U + static_cast<unsigned char>(c) - base;
    }
    return value;
}

bool is_filter_of_all(const std::string &line)
{
    const std::optional<std::uint32_t> value = hex(line, 1, 8);
    return value && line.size() == 9 && (line[0] == 'M' || *value == 0xFFFFFFFFU);
}

} // namespace

std::optional<CanFrame> slcan_frame(const std::string &line)
{
    if (line.empty() || std::string("tTrR").find(line[0]) == std::string::npos) {
        return std::nullopt;
    }
    CanFrame f;
    f.extended               = line[0] == 'T' || line[0] == 'R';
    f.remote                 = line[0] == 'r' || line[0] == 'R';
    const std::size_t digits = f.extended ? 8 : 3;
    const auto        id     = hex(line, 1, digits);
    const auto        length = hex(line, 1 + digits, 1);
    if (!id || !length || *length > 8U || *id > (f.extended ? 0x1FFFFFFFU : 0x7FFU)) {
        return std::nullopt;
    }
    f.id                     = *id;
    f.length                 = static_cast<std::uint8_t>(*length);
    const std::size_t octets = f.remote ? 0 : f.length;
    if (line.size() != 2 + digits + 2 * octets) {
        return std::nullopt;
    }
    for (std::size_t n = 0; n < octets; n++) {
        const auto octet = hex(line, 2 + digits + 2 * n, 2);
        if (!octet) {
            return std::nullopt;
        }
        f.data[n] = static_cast<std::uint8_t>(*octet);
    }
    return f;
}

std::string slcan_line(const CanFrame &frame)
{
    const char  kind = frame.remote ? (frame.extended ? 'R' : 'r') : (frame.extended ? 'T' : 't');
    std::string line =
        fmt::format("{}{:0{}X}{}", kind, frame.id, frame.extended ? 8 : 3, frame.length);
    for (std::size_t n = 0; n < frame.length && n < frame.data.size() && !frame.remote; n++) {
        line += fmt::format("{:02X}", frame.data[n]);
    }
    return line + cr;
}

/// Settings: they are taken while the channel is off the bus.
std::string SlcanChannel::set_up(const std::string &line)
{
    if (node_.is_open()) {
        return bad;
    }
    if (line.size() == 2 && line[0] == 'S' && line[1] >= '0' && line[1] <= '8') {
        rate_Hz_ = rates_Hz[line[1] - '0'];
        return good;
    }
    if (line == "Z0" || line == "Z1") {
        stamps_ = line == "Z1";
        return good;
    }
    return is_filter_of_all(line) ? good : bad;
}

std::string SlcanChannel::open(const std::string &line)
{
    if (node_.is_open() || line.size() != 1) {
        return bad;
    }
    node_.open(rate_Hz_, line == "L");
    return good;
}

std::string SlcanChannel::send(const std::string &line)
{
    const std::optional<CanFrame> frame = slcan_frame(line);
    if (!frame || !node_.send(*frame)) {
        return bad;
    }
    return (frame->extended ? "Z" : "z") + good;
}

std::string SlcanChannel::status()
{
    if (!node_.is_open()) {
        return bad;
    }
    const f28335::CanErrorCounters &errors = node_.errors();
    const unsigned flags = (errors.warning() ? 0x04U : 0U) | (node_.overrun() ? 0x08U : 0U) |
                           (errors.passive() ? 0x20U : 0U) | (errors.bus_off() ? 0x80U : 0U);
    node_.clear_overrun();
    return fmt::format("F{:02X}\r", flags);
}

std::string SlcanChannel::answer(const std::string &line)
{
    if (line.empty()) {
        return good; // clients begin with some, to end what was there before
    }
    switch (line[0]) {
    case 'S':
    case 'Z':
    case 'M':
    case 'm':
        return set_up(line);
    case 'O':
    case 'L':
        return open(line);
    case 't':
    case 'T':
    case 'r':
    case 'R':
        return send(line);
    default:
        break;
    }
    if (line == "C" && node_.is_open()) {
        node_.close();
        return good;
    }
    return line == "F"   ? status()
           : line == "V" ? "V1013\r"
           : line == "v" ? "v0101\r"
           : line == "N" ? "NSDRE\r"
                         : bad;
}

void SlcanChannel::take(const Octets &come, Octets &go)
{
    for (const std::uint8_t octet : come) {
        if (octet == cr) {
            const std::string said = line_.size() > longest_line ? bad : answer(line_);
            go.insert(go.end(), said.begin(), said.end());
            line_.clear();
        } else if (octet != '\n' && line_.size() <= longest_line) {
            line_.push_back(static_cast<char>(octet));
        }
    }
}

void SlcanChannel::collect(double time_s, Octets &go)
{
    while (const std::optional<CanFrame> frame = node_.take()) {
        std::string line = slcan_line(*frame);
        if (stamps_) {
            line.pop_back();
            line += fmt::format("{:04X}\r", static_cast<unsigned>(std::fmod(1e3 * time_s, 60e3)));
        }
        go.insert(go.end(), line.begin(), line.end());
    }
}

} // namespace sdre
