// SPDX-License-Identifier: MIT
/// One client of a CAN bus that speaks slcan, the text protocol of LAWICEL's adapters. Lines end with CR; the answer is
/// CR, or BEL for what is not possible.
///
///     S0 .. S8         10, 20, 50, 100, 125, 250, 500, 800 kbit/s, 1 Mbit/s; default: the rate of the bus
///     O  L  C          on the bus, on it to listen only, off it
///     t123211FF        data frame with 11 bits of identifier: three digits, length, octets; T has eight digits
///     r1232            request of two octets; R has eight digits
///     V  v  N          versions, serial number
///     F                status of an open channel: 04 warning, 08 overrun, 20 error passive, 80 bus-off
///     Z0  Z1           milliseconds, 0 .. 59999, behind each received frame
///     M00000000        acceptance code and mask: only the mask that accepts everything
///     mFFFFFFFF
///
/// A rate, Z, M and m are set while the channel is off the bus.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sil/f28335/can_bus.hpp"
#include "sil/served/rtu_frame.hpp"

namespace sdre {

/// Nothing: the line, without its CR, is no frame.
std::optional<f28335::CanFrame> slcan_frame(const std::string &line);
/// With its CR.
std::string slcan_line(const f28335::CanFrame &frame);

class SlcanChannel {
public:
    /// A member of this bus, which outlives it; off the bus at first.
    explicit SlcanChannel(f28335::CanBus &bus) : bus_(bus), node_(bus.join()) {}
    ~SlcanChannel()
    {
        bus_.leave(node_);
    }
    SlcanChannel(const SlcanChannel &)            = delete;
    SlcanChannel &operator=(const SlcanChannel &) = delete;

    /// Takes what the client has sent, in pieces of any size, and appends the answers.
    void take(const Octets &come, Octets &go);
    /// Appends the frames that the channel has received since.
    void collect(double time_s, Octets &go);

private:
    std::string answer(const std::string &line);
    std::string set_up(const std::string &line);
    std::string open(const std::string &line);
    std::string send(const std::string &line);
    std::string status();

    f28335::CanBus       &bus_;
    f28335::CanNode      &node_;
    std::string           line_;
    bool                  stamps_ = false;
    std::optional<double> rate_Hz_;
};

} // namespace sdre
