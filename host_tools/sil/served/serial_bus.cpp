// SPDX-License-Identifier: MIT
#include "sil/served/serial_bus.hpp"

#include <algorithm>

#include "sil/served/served_drive.hpp"

namespace sdre {
namespace {

constexpr std::size_t most_waiting = 64;   // chosen: a second of the line
constexpr double      silence_s    = 2e-3; // by the protocol 1.75 ms at 115200 Bd, and a tick
constexpr double      octet_s      = 11.0 / 115200.0;
constexpr std::size_t most_of_one = 8; // chosen: a master waits for its answer before it asks again
// Chosen: the firmware answers within a pass of its background.
constexpr double patience_s = 0.05;

/// An answer that came later than a request before had patience for: RTU has no other sign of what it answers.
bool is_of_another(const Octets &answer, const Octets &request)
{
    constexpr unsigned exception = 0x80;
    return answer.size() > 1 && request.size() > 1 &&
           (answer[1] & ~exception) != (request[1] & ~exception);
}

} // namespace

bool SerialBus::push(BusRequest request)
{
    const auto of_this = std::count_if(waiting_.begin(), waiting_.end(), [&](const BusRequest &r) {
        return r.client == request.client;
    });
    if (waiting_.size() >= most_waiting || static_cast<std::size_t>(of_this) >= most_of_one) {
        return false;
    }
    waiting_.push_back(std::move(request));
    return true;
}

void SerialBus::begin(ServedDrive &drive)
{
    const Octets &frame = waiting_.front().frame;
    for (const std::uint8_t octet : frame) {
        drive.send(octet);
    }
    busy_    = true;
    last_s_  = drive.time_s() + static_cast<double>(frame.size()) * octet_s;
    until_s_ = last_s_ + patience_s;
    answer_.clear();
}

void SerialBus::step(ServedDrive &drive, const Deliver &deliver)
{
    for (int octet = drive.take(); octet >= 0; octet = drive.take()) {
        answer_.push_back(static_cast<std::uint8_t>(octet));
        last_s_ = drive.time_s();
    }
    const bool quiet = drive.time_s() > last_s_ + silence_s;
    if (busy_ && quiet && is_of_another(answer_, waiting_.front().frame)) {
        answer_.clear();
    }
    if (busy_ && quiet && (!answer_.empty() || drive.time_s() > until_s_)) {
        busy_                    = false;
        const BusRequest request = std::move(waiting_.front());
        waiting_.pop_front();
        deliver(request, answer_);
        answer_.clear();
    } else if (!busy_ && quiet && !waiting_.empty()) {
        begin(drive);
    }
}

void SerialBus::forget(long client)
{
    const auto first = waiting_.begin() + (busy_ ? 1 : 0);
    waiting_.erase(std::remove_if(first, waiting_.end(),
                                  [client](const BusRequest &r) {
                                      return r.client == client && !rtu_content(r.frame);
                                  }),
                   waiting_.end());
    for (BusRequest &r : waiting_) {
        r.client = r.client == client ? -1 : r.client;
    }
}

} // namespace sdre
