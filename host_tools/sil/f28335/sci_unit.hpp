// SPDX-License-Identifier: MIT
/// SCI-A with its two FIFOs, at the speed of the line.
#pragma once

#include <cstdint>
#include <deque>

#include "sil/f28335/clock.hpp"
#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

class SciUnit {
public:
    void sync(Findings &findings, double time_s);
    /// The firmware is about to read SCIRXBUF, or to write SCITXBUF.
    void read_access();
    void write_access();

    /// Moves octets along the line up to now.
    void         pass(std::int64_t now_ticks, const Clock &clock);
    std::int64_t ticks_to_event(std::int64_t now_ticks) const; ///< -1: the line is quiet

    /// The other end of the line: octets for the firmware, sent one after the other from now on.
    void send(std::uint16_t octet)
    {
        coming_.push_back(octet);
    }
    /// A receive error, now: nothing more is received until a software reset of the port.
    void fail_receiver()
    {
        error_ = true;
    }
    /// An octet that the firmware has sent; -1: none.
    int          take();
    std::int64_t octet_ticks(const Clock &clock) const;

private:
    void take_written();
    void present();
    bool connected(int pin) const;

    std::deque<std::uint16_t> coming_;
    std::deque<std::uint16_t> rx_;
    std::deque<std::uint16_t> tx_;
    std::deque<std::uint16_t> sent_;
    bool                      receiving_      = false;
    std::int64_t              received_at_    = 0;
    bool                      shifting_       = false;
    std::uint16_t             shifted_        = 0;
    std::int64_t              shifted_at_     = 0;
    bool                      write_pending_  = false;
    bool                      overflow_       = false;
    bool                      error_          = false;
    std::uint16_t             presented_ffrx_ = 0x201F;
};

} // namespace sdre::f28335
