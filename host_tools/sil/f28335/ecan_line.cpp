// SPDX-License-Identifier: MIT
// eCAN-A as a member of the bus: frames, error states, bus-off.
#include <algorithm>
#include <cmath>

#include "sil/f28335/ecan_registers.hpp"
#include "sil/f28335/ecan_unit.hpp"

namespace sdre::f28335 {
namespace {

constexpr int join_bits    = 11;
constexpr int recover_bits = 128 * 11;

constexpr std::uint32_t bit_of(int number)
{
    return 1U << static_cast<unsigned>(number);
}

} // namespace

std::int64_t EcanUnit::ticks(int bits) const
{
    return rate_Hz_ > 0.0 ? std::llround(bits * tick_Hz / rate_Hz_) : 0;
}

/// Mailboxes with a request that can go onto the wire now.
std::uint32_t EcanUnit::sendable() const
{
    const std::uint32_t requested = trs_ & ECanaRegs.CANME_word[0].all;
    std::uint32_t       go        = requested & ~ECanaRegs.CANMD.all;
    for (int n = 0; n < mailboxes && go != requested; n++) {
        const bool asks = (requested & bit_of(n)) != 0U && mailbox(n).MSGCTRL.bit.RTR != 0U;
        go |= asks ? bit_of(n) : 0U;
    }
    return ECanaRegs.CANMC.bit.CDR != 0U ? go & ~bit_of(ECanaRegs.CANMC.bit.MBNR) : go;
}

bool EcanUnit::wants() const
{
    return trs_ != 0U && sendable() != 0U;
}

std::optional<CanFrame> EcanUnit::next()
{
    const std::optional<int> first = mailbox_first(sendable());
    return first ? std::optional<CanFrame>(mailbox_message(*first)) : std::nullopt;
}

void EcanUnit::began(bool sends)
{
    sending_ = sends ? mailbox_first(sendable()) : std::nullopt;
    hears_   = !sends;
}

void EcanUnit::sent()
{
    counters_.sent();
    count_bits(now_);
    const int           n   = sending_.value_or(0);
    const std::uint32_t bit = bit_of(n);
    trs_ &= ~bit;
    trr_ &= ~bit;
    ta_ |= bit & ~ECanaRegs.CANMD.all; // a request of a receive mailbox is answered by RMP
    time_stamp(n) = tsc_;
    tsc_          = n == 16 && ECanaRegs.CANMC.bit.MBCC != 0U ? 0U : tsc_;
    sending_.reset();
}

void EcanUnit::received(const CanFrame &frame)
{
    counters_.received();
    count_bits(now_);
    hears_                     = false;
    const std::optional<int> n = mailbox_for(frame, ECanaRegs.CANME_word[0].all, rmp_);
    if (!n) {
        return;
    }
    const std::uint32_t bit = bit_of(*n);
    if ((ECanaRegs.CANMD.all & bit) == 0U) { // answers by itself
        rfp_ |= bit;
        trs_ |= bit;
        return;
    }
    rml_ |= rmp_ & bit;
    rmp_ |= bit;
    mailbox_store(*n, frame);
    time_stamp(*n) = tsc_;
    tsc_           = *n == 16 && ECanaRegs.CANMC.bit.MBCC != 0U ? 0U : tsc_;
    remember();
}

void EcanUnit::failed(CanError error, bool sends)
{
    counters_.failed(error, sends);
    if ((flags_ & es::bus_errors) == 0U) { // the first one stays until it is acknowledged
        flags_ |= error == CanError::ack ? es::acke : error == CanError::stuff ? es::se : es::be;
    }
    if (sends && sending_ && error != CanError::stuck) {
        abort(trr_ & bit_of(*sending_));
        sending_.reset();
    }
    hears_ = false;
    if (counters_.bus_off() && !bus_off_) {
        enter_bus_off();
    }
}

void EcanUnit::abort(std::uint32_t boxes)
{
    trs_ &= ~boxes;
    trr_ &= ~boxes;
    aa_ |= boxes;
}

void EcanUnit::enter_bus_off()
{
    bus_off_      = true;
    on_bus_       = false;
    bus_off_from_ = bus_.recessive_ticks(now_);
    flags_ |= es::bo | es::sa1;
    sending_.reset();
    if (ECanaRegs.CANMC.bit.ABO == 0U) {
        ECanaRegs.CANMC.bit.CCR = 1;
        mode_                   = Mode::configuration;
    }
}

/// The unit joins the bus, and leaves bus-off, when the wires have been recessive for long enough.
void EcanUnit::update_mode()
{
    const std::int64_t recessive = bus_.recessive_ticks(now_);
    if (mode_ == Mode::joining && recessive - joining_from_ >= ticks(join_bits)) {
        mode_ = Mode::running;
        flags_ &= ~es::sa1;
    }
    if (bus_off_ && mode_ != Mode::configuration &&
        recessive - bus_off_from_ >= ticks(recover_bits)) {
        bus_off_ = false;
        flags_   = 0;
        counters_.reset();
    }
    on_bus_ = ecan_is_clocked() && mode_ == Mode::running && !bus_off_ && ecan_is_connected();
}

void EcanUnit::pass(std::int64_t now)
{
    now_ = now;
    bus_.pass(now);
    if (ecan_is_clocked()) {
        count_bits(now);
        update_mode();
        present();
    }
}

std::int64_t EcanUnit::ticks_to_event(std::int64_t now) const
{
    std::int64_t next = bus_.ticks_to_event(now);
    const auto   wait = [&](std::int64_t from, int bits) {
        const std::int64_t left = ticks(bits) - (bus_.recessive_ticks(now) - from);
        next = next < 0 || left < next ? std::max<std::int64_t>(0, left) : next;
    };
    if (ecan_is_clocked() && bus_.idle()) {
        if (mode_ == Mode::joining) {
            wait(joining_from_, join_bits);
        }
        if (bus_off_ && mode_ != Mode::configuration) {
            wait(bus_off_from_, recover_bits);
        }
    }
    return next;
}

/// The time stamp counter goes on with the bits, except in configuration.
void EcanUnit::count_bits(std::int64_t now)
{
    const std::int64_t bit = ticks(1);
    if (mode_ == Mode::configuration || bit == 0) {
        tsc_at_ = now;
        return;
    }
    const std::int64_t bits = (now - tsc_at_) / bit;
    tsc_ += static_cast<std::uint32_t>(bits);
    tsc_at_ += bits * bit;
}

void EcanUnit::set_far_end(std::optional<double> bit_rate_Hz, bool present)
{
    if (present) {
        bus_.far_end().open(bit_rate_Hz);
    } else {
        bus_.far_end().close();
    }
}

} // namespace sdre::f28335
