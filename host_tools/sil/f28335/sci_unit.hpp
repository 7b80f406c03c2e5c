// SPDX-License-Identifier: MIT
/// SCI-A with its two FIFOs, at the speed of the line.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "sil/f28335/clock.hpp"
#include "sil/f28335/findings.hpp"
#include "sil/f28335/octet_line.hpp"

namespace sdre::f28335 {

/// Settings of the other end of the line.
struct LineEnd {
    double baud_Bd = 115200.0;
    char   parity  = 'E'; ///< E, O, or N with two stop bits: 11 bits always
};

/// Timing of a transceiver's direction pin, in ticks, at its last use.
struct Direction {
    int          rises       = 0;
    std::int64_t lead_ticks  = -1; ///< from the rise to the first bit
    std::int64_t tail_ticks  = -1; ///< from the end of the last stop bit to the fall
    int          cut_octets  = 0;  ///< sent while it was low, hence lost
    int          deaf_octets = 0;  ///< received while it was high, hence lost
    std::int64_t longest_gap = 0;  ///< between two octets of an answer
};

class SciUnit : public OctetLine {
public:
    void sync(Findings &findings, double time_s);
    /// The firmware is about to read SCIRXBUF, or to write SCITXBUF.
    void read_access();
    void write_access();

    /// Moves octets along the line up to now.
    void         pass(std::int64_t now_ticks, const Clock &clock);
    std::int64_t ticks_to_event(std::int64_t now_ticks) const; ///< -1: the line is quiet

    void send(std::uint16_t octet) override
    {
        coming_.push_back(octet);
    }
    /// An end with settings of its own; without this call it has those of the device.
    void set_far_end(const LineEnd &end)
    {
        far_ = end;
    }
    /// Level of the direction pin; nothing: it is no output, and the line has two pairs.
    void             drive_direction(std::optional<bool> high, std::int64_t now_ticks);
    const Direction &direction() const
    {
        return direction_;
    }
    /// A receive error, now: nothing more is received until a software reset of the port.
    void fail_receiver()
    {
        error_ = true;
    }
    int          take() override;
    std::int64_t octet_ticks(const Clock &clock) const;

private:
    void take_written();
    void present();
    bool connected(int pin) const;
    bool ends_agree(const Clock &clock) const;
    void end_reception(const Clock &clock);
    void end_shift(const Clock &clock);
    void begin_shift(std::int64_t now, std::int64_t octet);

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
    std::optional<LineEnd>    far_;
    std::optional<bool>       pin_;
    std::int64_t              risen_at_ = 0;
    bool                      fresh_    = false; ///< nothing was sent since the pin rose
    bool                      whole_    = false; ///< the pin was high all the time of this octet
    Direction                 direction_;
};

} // namespace sdre::f28335
