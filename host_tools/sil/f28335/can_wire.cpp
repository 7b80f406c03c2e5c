// SPDX-License-Identifier: MIT
#include "sil/f28335/can_wire.hpp"

#include <algorithm>
#include <cmath>

#include "sil/f28335/clock.hpp"

namespace sdre::f28335 {
namespace {

constexpr int intermission_bits = 3;
constexpr int suspend_bits      = 8; // of a sender that is error passive
constexpr int flag_bits         = 6;
constexpr int echo_bits         = 6; // the flags of the others follow
constexpr int delimiter_bits    = 8;
constexpr int gap_bits          = 11; // end of frame or delimiter, and intermission: all recessive
constexpr int after_ack_bits    = 8;  // delimiter of the acknowledgement and end of frame
constexpr int stuck_bits        = 8;
constexpr int first_bits        = 1; // a sender that cannot drive the wires notices at once
constexpr int clash_bits =
    20; // chosen: at another rate six equal bits are seen within the identifier
constexpr double same_rate  = 0.005; // of each other: more than bit timings with 15 quanta tolerate
constexpr double default_Hz = 500e3; // for times without any frame
constexpr auto   window_ticks = static_cast<std::int64_t>(0.1 * tick_Hz);

bool rates_agree(double one_Hz, double other_Hz)
{
    return std::abs(one_Hz / other_Hz - 1.0) <= same_rate;
}

} // namespace

std::int64_t CanWire::ticks(int bits) const
{
    return std::llround(bits * tick_Hz / (bit_rate_Hz_ > 0.0 ? bit_rate_Hz_ : default_Hz));
}

void CanWire::attach(CanMember &member)
{
    members_.push_back(&member);
}

void CanWire::detach(const CanMember &member)
{
    const auto drop = [&member](std::vector<CanMember *> &all) {
        all.erase(std::remove(all.begin(), all.end(), &member), all.end());
    };
    drop(members_);
    const bool sent = is_sender(member);
    drop(senders_);
    if (sent && senders_.empty() && phase_ == Phase::frame) {
        outcome_ = Outcome::destroyed;
    }
}

void CanWire::restart()
{
    senders_.clear();
    phase_      = level_ == CanLevel::dominant ? Phase::dominant : Phase::idle;
    end_        = 0;
    idle_since_ = 0;
    now_load_   = {};
    last_load_  = {};
}

void CanWire::set_level(CanLevel level, std::int64_t now)
{
    const CanLevel was = level_;
    level_             = level;
    if (level == was) {
        return;
    }
    if (level == CanLevel::dominant) {
        recessive_ = recessive_ticks(now);
        phase_     = Phase::dominant;
        end_       = now + ticks(stuck_bits);
        return;
    }
    if (phase_ == Phase::frame) {
        outcome_ = Outcome::destroyed;
        end_     = now;
    } else if (was == CanLevel::dominant) {
        senders_.clear();
        rest(now, gap_bits);
    }
}

std::int64_t CanWire::recessive_ticks(std::int64_t now) const
{
    return recessive_ + (phase_ == Phase::idle ? now - idle_since_ : 0);
}

bool CanWire::is_sender(const CanMember &member) const
{
    return std::find(senders_.begin(), senders_.end(), &member) != senders_.end();
}

std::int64_t CanWire::suspended_until(const CanMember &member) const
{
    return is_sender(member) && member.passive() ? idle_since_ + ticks(suspend_bits) : idle_since_;
}

bool CanWire::may_begin(const CanMember &member, std::int64_t now) const
{
    return member.wants() && member.bit_rate_Hz() > 0.0 && now >= suspended_until(member);
}

/// All who begin now and have the winning identifier.
void CanWire::choose_senders(std::int64_t now)
{
    std::vector<CanMember *> winners;
    std::vector<bool>        best;
    for (CanMember *m : members_) {
        const std::optional<CanFrame> wanted = may_begin(*m, now) ? m->next() : std::nullopt;
        if (!wanted) {
            continue;
        }
        std::vector<bool> bits = can_arbitration_bits(*wanted);
        if (winners.empty() || bits < best) {
            winners = {m};
            best    = std::move(bits);
            frame_  = *wanted;
        } else if (bits == best) {
            winners.push_back(m);
        }
    }
    senders_ = std::move(winners);
}

/// The member destroys the frame, because it has another rate. One that is error passive cannot.
bool CanWire::is_clash(const CanMember &member) const
{
    const double rate_Hz = member.bit_rate_Hz();
    return rate_Hz > 0.0 && member.drives() && (!member.passive() || is_sender(member)) &&
           !rates_agree(rate_Hz, bit_rate_Hz_);
}

void CanWire::plan(std::int64_t now)
{
    const int  length = can_frame_length_bits(frame_);
    const bool clash  = std::any_of(members_.begin(), members_.end(),
                                    [this](const CanMember *m) { return is_clash(*m); });
    const bool unlike = std::any_of(senders_.begin(), senders_.end(),
                                    [this](CanMember *m) { return !(m->next() == frame_); });
    const bool heard  = std::any_of(members_.begin(), members_.end(), [this](const CanMember *m) {
        return !is_sender(*m) && m->drives() && m->bit_rate_Hz() > 0.0 &&
               rates_agree(m->bit_rate_Hz(), bit_rate_Hz_);
    });
    const bool acknowledged = heard || senders_.size() > 1; // senders acknowledge each other
    int        bits         = length;
    outcome_                = Outcome::sent;
    if (level_ == CanLevel::recessive) {
        outcome_ = Outcome::destroyed;
        bits     = first_bits + flag_bits + delimiter_bits;
    } else if (clash || unlike) {
        outcome_ = Outcome::destroyed;
        bits     = (unlike ? length / 2 : clash_bits) + flag_bits + echo_bits + delimiter_bits;
    } else if (!acknowledged) {
        outcome_ = Outcome::no_ack;
        bits     = length - after_ack_bits + flag_bits + delimiter_bits;
    }
    end_ = now + ticks(bits);
}

void CanWire::begin(std::int64_t now)
{
    const bool any = std::any_of(members_.begin(), members_.end(),
                                 [&](const CanMember *m) { return may_begin(*m, now); });
    if (!any) {
        return;
    }
    choose_senders(now);
    bit_rate_Hz_ = senders_.front()->bit_rate_Hz();
    recessive_   = recessive_ticks(now);
    began_       = now;
    plan(now);
    phase_ = Phase::frame;
    for (CanMember *m : members_) {
        if (m->bit_rate_Hz() > 0.0) {
            m->began(is_sender(*m));
        }
    }
}

void CanWire::fail(CanError error)
{
    for (CanMember *m : members_) {
        const bool sends = is_sender(*m);
        const bool heard = level_ != CanLevel::recessive && error != CanError::ack;
        if (m->bit_rate_Hz() > 0.0 && (sends || heard)) {
            m->failed(sends || error == CanError::stuck ? error : CanError::stuff, sends);
        }
    }
}

void CanWire::end_frame(std::int64_t now)
{
    if (outcome_ == Outcome::sent) {
        for (CanMember *m : members_) {
            if (is_sender(*m)) {
                m->sent();
            } else if (m->bit_rate_Hz() > 0.0 && rates_agree(m->bit_rate_Hz(), bit_rate_Hz_)) {
                m->received(frame_);
            } else if (m->bit_rate_Hz() > 0.0) {
                m->failed(CanError::stuff, false);
            }
        }
    } else {
        fail(outcome_ == Outcome::no_ack ? CanError::ack : CanError::bit);
    }
    rest(now, intermission_bits);
    note_busy(began_, end_);
}

/// The wire is recessive for so many bits, and then idle.
void CanWire::rest(std::int64_t now, int bits)
{
    phase_ = Phase::gap;
    end_   = now + ticks(bits);
}

void CanWire::go_idle(std::int64_t now)
{
    recessive_ += ticks(gap_bits);
    phase_      = Phase::idle;
    idle_since_ = now;
}

void CanWire::stay_dominant(std::int64_t now)
{
    fail(CanError::stuck);
    note_busy(end_ - ticks(stuck_bits), end_);
    end_ = now + ticks(stuck_bits);
}

void CanWire::pass(std::int64_t now)
{
    if (phase_ != Phase::idle && now < end_) {
        return;
    }
    switch (phase_) {
    case Phase::dominant:
        stay_dominant(now);
        return;
    case Phase::frame:
        end_frame(now);
        return;
    case Phase::gap:
        go_idle(now);
        break;
    case Phase::idle:
        break;
    }
    begin(now);
}

std::int64_t CanWire::ticks_to_event(std::int64_t now) const
{
    const bool alone = members_.empty();
    if (phase_ != Phase::idle) {
        return alone && phase_ == Phase::dominant ? -1 : std::max<std::int64_t>(0, end_ - now);
    }
    std::int64_t next = -1;
    for (const CanMember *m : members_) {
        if (m->wants() && m->bit_rate_Hz() > 0.0) {
            const std::int64_t left = std::max<std::int64_t>(0, suspended_until(*m) - now);
            next                    = next < 0 ? left : std::min(next, left);
        }
    }
    return next;
}

void CanWire::note_busy(std::int64_t from, std::int64_t to)
{
    const std::int64_t number = to / window_ticks;
    if (number != now_load_.number) {
        last_load_ = now_load_;
        now_load_  = {number, 0};
    }
    now_load_.busy += to - from; // a frame counts for the window of its end
}

double CanWire::load(std::int64_t now) const
{
    const std::int64_t wanted = now / window_ticks - 1;
    for (const Window &w : {now_load_, last_load_}) {
        if (w.number == wanted) {
            return std::min(1.0, static_cast<double>(w.busy) / static_cast<double>(window_ticks));
        }
    }
    return 0.0;
}

} // namespace sdre::f28335
