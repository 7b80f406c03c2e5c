// SPDX-License-Identifier: MIT
#include "sil/f28335/sci_unit.hpp"

#include <algorithm>
#include <cmath>

#include "sil/f28335/gpio.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {
namespace {

constexpr std::size_t   depth       = 16;
constexpr std::uint16_t overflow    = 0x8000;
constexpr std::uint16_t not_reset   = 0x2000;
constexpr unsigned      count_shift = 8;
constexpr unsigned      count_mask  = 0x1F00;
constexpr double        octet_bits  = 11.0;
constexpr double        baud_room   = 0.045; // half a bit in eleven
constexpr double        frame_gap   = 3.5;   // octets: a longer gap begins another answer

double device_baud_Bd(const Clock &clock)
{
    const unsigned brr = ((SciaRegs.SCIHBAUD & 0xFFU) << 8U) | (SciaRegs.SCILBAUD & 0xFFU);
    return clock.lspclk_Hz() / (brr == 0U ? 16.0 : 8.0 * (brr + 1.0));
}

char device_parity()
{
    if (SciaRegs.SCICCR.bit.PARITYENA == 0U) {
        return 'N';
    }
    return SciaRegs.SCICCR.bit.PARITY != 0U ? 'E' : 'O';
}

} // namespace

std::int64_t SciUnit::octet_ticks(const Clock &clock) const
{
    const auto    &c    = SciaRegs.SCICCR.bit;
    const unsigned bits = 1U + c.SCICHAR + 1U + c.PARITYENA + 1U + c.STOPBITS;
    return static_cast<std::int64_t>(std::llround(bits * tick_Hz / device_baud_Bd(clock)));
}

bool SciUnit::ends_agree(const Clock &clock) const
{
    return !far_ || (std::abs(far_->baud_Bd / device_baud_Bd(clock) - 1.0) <= baud_room &&
                     far_->parity == device_parity());
}

void SciUnit::drive_direction(std::optional<bool> high, std::int64_t now_ticks)
{
    const bool was = pin_.value_or(false);
    const bool is  = high.value_or(false);
    if (is && !was) {
        direction_.rises++;
        risen_at_ = now_ticks;
        fresh_    = true;
    } else if (was && !is) {
        direction_.tail_ticks = now_ticks - shifted_at_;
    }
    whole_ = whole_ && (!high || is);
    pin_   = high;
}

bool SciUnit::connected(int pin) const
{
    return Gpio::is_muxed(pin, 1);
}

void SciUnit::present()
{
    const auto with_count = [](unsigned value, std::size_t n) {
        return static_cast<std::uint16_t>((value & ~count_mask) | (n << count_shift));
    };
    SciaRegs.SCIFFTX.all =
        with_count(SciaRegs.SCIFFTX.all, tx_.size() + (write_pending_ ? 1U : 0U));
    unsigned ffrx        = with_count(SciaRegs.SCIFFRX.all, rx_.size());
    ffrx                 = overflow_ ? ffrx | overflow : ffrx & ~static_cast<unsigned>(overflow);
    SciaRegs.SCIFFRX.all = static_cast<std::uint16_t>(ffrx);
    presented_ffrx_      = SciaRegs.SCIFFRX.all;
    SciaRegs.SCICTL2.bit.TXRDY   = tx_.size() < depth ? 1U : 0U;
    SciaRegs.SCICTL2.bit.TXEMPTY = tx_.empty() && !shifting_ ? 1U : 0U;
    SciaRegs.SCIRXST.bit.RXRDY   = rx_.empty() ? 0U : 1U;
    SciaRegs.SCIRXST.bit.RXERROR = error_ ? 1U : 0U;
}

void SciUnit::take_written()
{
    if (write_pending_) {
        write_pending_ = false;
        if (tx_.size() < depth) {
            tx_.push_back(SciaRegs.SCITXBUF_word[0] & 0xFFU);
        }
    }
}

void SciUnit::sync(Findings &findings, double time_s)
{
    take_written();
    if (SciaRegs.SCIFFTX.bit.SCIFFENA == 0U && SciaRegs.SCICTL1.bit.TXENA != 0U) {
        findings.add(Finding::unsupported, "SciaRegs: only the FIFO mode is modelled", time_s);
    }
    if ((SciaRegs.SCIFFTX.all & not_reset) == 0U) {
        tx_.clear();
    }
    if (SciaRegs.SCICTL1.bit.SWRESET == 0U) { // and cuts what is on the line
        error_    = false;
        shifting_ = false;
    }
    // Hold and release between two hooks leave only the release. A write while the overflow flag is
    // set counts as both.
    const bool written = SciaRegs.SCIFFRX.all != presented_ffrx_;
    if ((SciaRegs.SCIFFRX.all & not_reset) == 0U || (written && overflow_)) {
        rx_.clear();
        overflow_ = false;
    }
    present();
}

void SciUnit::read_access()
{
    if (!rx_.empty()) {
        SciaRegs.SCIRXBUF_word[0].all = rx_.front();
        rx_.pop_front();
    }
    present();
}

void SciUnit::write_access()
{
    take_written();
    write_pending_ = true;
    present();
}

void SciUnit::end_reception(const Clock &clock)
{
    const bool deaf  = pin_.value_or(false);
    const bool heard = connected(28) && SciaRegs.SCICTL1.bit.RXENA != 0U &&
                       SciaRegs.SCICTL1.bit.SWRESET != 0U && !error_ && !deaf;
    direction_.deaf_octets += deaf ? 1 : 0;
    if (heard && !ends_agree(clock)) {
        error_ = true; // of the frame, or of its parity
    } else if (heard && rx_.size() < depth) {
        rx_.push_back(coming_.front());
    } else if (heard) {
        overflow_ = true;
    }
    coming_.pop_front();
}

void SciUnit::begin_shift(std::int64_t now, std::int64_t octet)
{
    if (fresh_) {
        direction_.lead_ticks = now - risen_at_;
        fresh_                = false;
    }
    const std::int64_t gap = now - shifted_at_;
    if (static_cast<double>(gap) < frame_gap * static_cast<double>(octet)) {
        direction_.longest_gap = std::max(direction_.longest_gap, gap);
    }
    shifting_   = true;
    whole_      = pin_.value_or(true);
    shifted_    = tx_.front();
    shifted_at_ = now + octet;
    tx_.pop_front();
}

void SciUnit::end_shift(const Clock &clock)
{
    shifting_ = false;
    direction_.cut_octets += whole_ ? 0 : 1;
    if (connected(29) && whole_ && ends_agree(clock)) {
        sent_.push_back(shifted_);
    }
}

void SciUnit::pass(std::int64_t now, const Clock &clock)
{
    const std::int64_t octet = octet_ticks(clock);
    if (receiving_ && now >= received_at_) {
        receiving_ = false;
        end_reception(clock);
    }
    if (!receiving_ && !coming_.empty()) {
        receiving_   = true;
        received_at_ = now + (far_ ? std::llround(octet_bits * tick_Hz / far_->baud_Bd) : octet);
    }
    if (shifting_ && now >= shifted_at_) {
        end_shift(clock);
    }
    if (!shifting_ && !tx_.empty() && SciaRegs.SCICTL1.bit.TXENA != 0U &&
        SciaRegs.SCICTL1.bit.SWRESET != 0U) {
        begin_shift(now, octet);
    }
    present();
}

std::int64_t SciUnit::ticks_to_event(std::int64_t now) const
{
    std::int64_t next = -1;
    const auto   take = [&](bool active, std::int64_t at) {
        if (active) {
            const std::int64_t left = std::max<std::int64_t>(0, at - now);
            next                    = next < 0 ? left : std::min(next, left);
        }
    };
    take(receiving_, received_at_);
    take(shifting_, shifted_at_);
    take(!receiving_ && !coming_.empty(), now);
    take(!shifting_ && !tx_.empty(), now);
    return next;
}

int SciUnit::take()
{
    if (sent_.empty()) {
        return -1;
    }
    const int octet = sent_.front();
    sent_.pop_front();
    return octet;
}

} // namespace sdre::f28335
