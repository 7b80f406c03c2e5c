// SPDX-License-Identifier: MIT
/// eQEP1: position counter 0 .. QPOSMAX, latch at the unit timer and at the index, phase error, and the edge capture:
///
///     QCTMR counts SYSCLK / 2^CCPS from one unit position event to the next, which comes every 2^UPPS edges
///     event:   QCTMR -> QCPRD, UPEVNT is set
///     COEF:    QCTMR overflowed since the previous event
///     CDEF:    the direction changed
#pragma once

#include <cstdint>
#include <vector>

#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

/// An edge on track A or B.
struct ShaftEdge {
    double age_s     = 0.0; ///< time since the edge
    int    direction = 1;   ///< +-1
};

/// Signals from the encoder since the last look.
struct ShaftCount {
    std::int64_t           count       = 0;     ///< edges since any start, with sign
    bool                   index       = false; ///< the index went high since the last look
    std::int64_t           index_count = 0;     ///< count at which it did
    bool                   phase_error = false; ///< both tracks changed at once since the last look
    std::vector<ShaftEdge> edges; ///< since the last look, oldest first; none: all of them now
};

class EncoderUnit {
public:
    void sync(Findings &findings, double time_s);
    /// Counts what the shaft did up to now.
    void         move(const ShaftCount &shaft, std::int64_t now_ticks);
    std::int64_t cycles_to_timeout() const; ///< -1: the unit timer stands
    /// True: the unit timer has timed out now; call latch() once the shaft's count is up to date.
    bool step(std::int64_t cycles);
    void latch(std::int64_t now_ticks);
    /// An enabled event has set its flag since the last look.
    bool take_interrupt();

private:
    void present();
    void raise(std::uint16_t flag);
    void capture(std::int64_t edge_ticks, bool forward);
    /// QCTMR as it would be without its sixteen bits.
    std::int64_t capture_timer(std::int64_t now_ticks) const;
    bool         connected(int pin) const;

    std::int64_t  last_               = 0; ///< count of the shaft at the last move()
    bool          have_last_          = false;
    std::int64_t  position_           = 0;
    std::uint32_t index_latch_        = 0;
    std::uint32_t latch_              = 0;
    std::int64_t  timer_              = 0;
    std::uint16_t flags_              = 0;
    bool          interrupt_          = false;
    bool          forward_            = true;
    std::uint32_t presented_position_ = 0;
    std::uint32_t presented_timer_    = 0;
    std::int64_t  event_ticks_        = 0; ///< of the last unit position event
    bool          event_forward_      = true;
    int           edges_to_event_     = 0; ///< since that event
    std::uint16_t status_             = 0; ///< UPEVNT, COEF, CDEF
    std::uint16_t presented_status_   = 0;
    std::uint16_t capture_period_     = 0;
    std::uint16_t timer_latch_        = 0;
    std::uint16_t period_latch_       = 0;
    std::uint16_t capture_settings_   = 0;
};

} // namespace sdre::f28335
