// SPDX-License-Identifier: MIT
/// Joins the CAN bus of this process to that of another `sdre-sil serve`, as a client of its slcan port. POSIX.
#pragma once

#include <string>

#include "sil/f28335/can_bus.hpp"
#include "sil/serve/endpoints.hpp"

namespace sdre {

class CanJoin {
public:
    /// Connects; frames pass after open(). InputError: nobody listens there.
    CanJoin(f28335::CanBus &bus, int port);
    ~CanJoin();
    CanJoin(const CanJoin &)            = delete;
    CanJoin &operator=(const CanJoin &) = delete;

    void open();
    /// Moves what has come on either side. InputError: the connection is lost.
    void exchange();
    int  fd() const
    {
        return socket_.get();
    }

private:
    void take(const Octets &come);

    f28335::CanBus  &bus_;
    f28335::CanNode &node_;
    int              port_;
    Descriptor       socket_;
    std::string      line_;
    Octets           go_;
};

} // namespace sdre
