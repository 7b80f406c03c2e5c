// SPDX-License-Identifier: MIT
/// One pair of wires with the members that are connected to it: who sends, how long, and with what success. Time is
/// in ticks of the device (clock.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "sil/f28335/can_member.hpp"

namespace sdre::f28335 {

enum class CanLevel {
    free,
    recessive, ///< both wires are connected: nobody can drive the pair
    dominant
};

class CanWire {
public:
    void attach(CanMember &member);
    /// A frame that the member has begun is over for the others, too.
    void detach(const CanMember &member);
    void set_level(CanLevel level, std::int64_t now_ticks);
    /// Time begins at 0 again; a frame that was on the wire begins again.
    void restart();

    void         pass(std::int64_t now_ticks);
    std::int64_t ticks_to_event(std::int64_t now_ticks) const; ///< -1: the wire is quiet
    /// How long the wire has been recessive in gaps of eleven bits and more.
    std::int64_t recessive_ticks(std::int64_t now_ticks) const;
    bool         idle() const
    {
        return phase_ == Phase::idle;
    }
    /// Share of the last whole 100 ms with a frame, its intermission, or an error on the wire.
    double load(std::int64_t now_ticks) const;

private:
    enum class Phase { idle, frame, gap, dominant };
    enum class Outcome { sent, no_ack, destroyed };
    struct Window {
        std::int64_t number = 0;
        std::int64_t busy   = 0;
    };

    bool         may_begin(const CanMember &member, std::int64_t now) const;
    std::int64_t suspended_until(const CanMember &member) const;
    void         begin(std::int64_t now);
    void         choose_senders(std::int64_t now);
    void         plan(std::int64_t now);
    bool         is_clash(const CanMember &member) const;
    bool         is_sender(const CanMember &member) const;
    void         end_frame(std::int64_t now);
    void         fail(CanError error);
    void         stay_dominant(std::int64_t now);
    void         rest(std::int64_t now, int bits);
    void         go_idle(std::int64_t now);
    void         note_busy(std::int64_t from, std::int64_t to);
    std::int64_t ticks(int bits) const;

    std::vector<CanMember *> members_;
    std::vector<CanMember *> senders_;
    CanLevel                 level_   = CanLevel::free;
    Phase                    phase_   = Phase::idle;
    Outcome                  outcome_ = Outcome::sent;
    CanFrame                 frame_;
    double                   bit_rate_Hz_ = 0.0; ///< of the frame on the wire, or of the last one
    std::int64_t             began_       = 0;
    std::int64_t             end_         = 0; ///< of the phase
    std::int64_t             idle_since_  = 0;
    std::int64_t             recessive_   = 0; ///< before idle_since_
    Window                   now_load_;
    Window                   last_load_;
};

} // namespace sdre::f28335
