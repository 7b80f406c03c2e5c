// SPDX-License-Identifier: MIT
/// Gives a served drive its node number on the CAN bus. The number goes through a register on its serial line. The
/// firmware takes it after a command on the bus.
#pragma once

#include "sil/served/rtu_frame.hpp"
#include "sil/served/served_drive.hpp"

namespace sdre {

class NodeNumber {
public:
    /// @param number 1 .. 127.
    NodeNumber(ServedDrive &drive, int number) : drive_(drive), number_(number) {}
    ~NodeNumber();
    NodeNumber(const NodeNumber &)            = delete;
    NodeNumber &operator=(const NodeNumber &) = delete;

    /// The request for the serial line, with its checksum.
    Octets request() const;
    /// Its answer; empty: none. InputError when the drive has not taken the number.
    void answered(const Octets &answer);
    /// After each control period. InputError when nobody has acknowledged the command in time.
    void step();
    /// The drive has the number.
    bool done() const
    {
        return done_;
    }

private:
    ServedDrive     &drive_;
    int              number_;
    f28335::CanNode *master_  = nullptr; ///< sends the command
    double           until_s_ = 0.0;
    bool             done_    = false;
};

} // namespace sdre
