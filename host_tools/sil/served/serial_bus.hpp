// SPDX-License-Identifier: MIT
/// One serial line, many clients: requests one after the other, each answer to whom it belongs.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>

#include "sil/served/rtu_frame.hpp"

namespace sdre {

class ServedDrive;

struct BusRequest {
    long          client      = 0;
    std::uint16_t transaction = 0; ///< of Modbus/TCP
    std::uint8_t  unit        = 0; ///< as the client names the drive
    Octets        frame;           ///< as it goes over the line, whatever it is
};

class SerialBus {
public:
    /// Gets every answer; an empty one when there was none.
    using Deliver = std::function<void(const BusRequest &request, const Octets &answer)>;

    /// False: too many wait already, in all or of this client.
    bool push(BusRequest request);
    /// After each control period.
    void step(ServedDrive &drive, const Deliver &deliver);
    /// Executes the client's remaining requests, such as a last stop, without an answer. Its noise
    /// leaves the line.
    void forget(long client);

private:
    void begin(ServedDrive &drive);

    std::deque<BusRequest> waiting_; ///< the first one is on the line when busy_
    bool                   busy_    = false;
    double                 until_s_ = 0.0; ///< no answer after this
    double                 last_s_  = 0.0; ///< when the last octet came
    Octets                 answer_;
};

} // namespace sdre
