// SPDX-License-Identifier: MIT
#include "sil/serve/can_join.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/served/slcan.hpp"

namespace sdre {
namespace {

constexpr std::size_t longest_line = 64;
constexpr std::size_t most_unread  = 1'000'000; // chosen: seconds of a full bus

} // namespace

CanJoin::CanJoin(f28335::CanBus &bus, int port)
    : bus_(bus), node_(bus.join()), port_(port), socket_(connect_to_loopback(port))
{
    if (!socket_) {
        bus_.leave(node_);
        throw InputError(
            fmt::format("serve: --join {}: no drive with --slcan-tcp {} answers", port, port));
    }
}

CanJoin::~CanJoin()
{
    bus_.leave(node_);
}

void CanJoin::open()
{
    const std::string begin = "\rC\rO\r";
    go_.insert(go_.end(), begin.begin(), begin.end());
    node_.open();
}

/// Frames of the other bus; answers to this client's lines are nothing to it.
void CanJoin::take(const Octets &come)
{
    for (const std::uint8_t octet : come) {
        if (octet != '\r' && octet != '\a') {
            line_.push_back(static_cast<char>(octet));
        } else {
            if (const auto frame = slcan_frame(line_)) {
                node_.send(*frame);
            }
            line_.clear();
        }
        if (line_.size() > longest_line) {
            line_.clear();
        }
    }
}

void CanJoin::exchange()
{
    Octets come;
    bool   there = read_available(socket_.get(), come);
    take(come);
    while (const std::optional<f28335::CanFrame> frame = node_.take()) {
        const std::string line = slcan_line(*frame);
        go_.insert(go_.end(), line.begin(), line.end());
    }
    there = write_some(socket_.get(), go_) && there;
    if (!there || go_.size() > most_unread) {
        throw InputError(fmt::format("serve: --join {}: the connection is lost", port_));
    }
}

} // namespace sdre
