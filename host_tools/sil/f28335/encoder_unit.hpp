// SPDX-License-Identifier: MIT
/// eQEP1: position counter 0 .. QPOSMAX, latch at the unit timer and at the index, phase error.
#pragma once

#include <cstdint>

#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

/// What came in on the encoder's wires.
struct ShaftCount {
    std::int64_t count       = 0;     ///< edges since any start, with sign
    bool         index       = false; ///< the index went high since the last look
    std::int64_t index_count = 0;     ///< count at which it did
    bool         phase_error = false; ///< both tracks changed at once since the last look
};

class EncoderUnit {
public:
    void sync(Findings &findings, double time_s);
    /// Counts what the shaft did up to now.
    void         move(const ShaftCount &shaft);
    std::int64_t cycles_to_timeout() const; ///< -1: the unit timer stands
    /// True: the unit timer has timed out now; call latch() once the shaft's count is up to date.
    bool step(std::int64_t cycles);
    void latch();
    /// An enabled event has set its flag since the last look.
    bool take_interrupt();

private:
    void present();
    void raise(std::uint16_t flag);
    bool connected(int pin) const;

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
};

} // namespace sdre::f28335
