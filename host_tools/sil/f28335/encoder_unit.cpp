// SPDX-License-Identifier: MIT
#include "sil/f28335/encoder_unit.hpp"

#include <cmath>
#include <cstdlib>

#include "sil/f28335/clock.hpp"
#include "sil/f28335/gpio.hpp"
#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {
namespace {

constexpr std::uint16_t flag_int   = 0x0001;
constexpr std::uint16_t flag_phase = 0x0004;
constexpr std::uint16_t flag_index = 0x0400;
constexpr std::uint16_t flag_unit  = 0x0800;

constexpr std::uint16_t status_direction = 0x0004; // CDEF
constexpr std::uint16_t status_overflow  = 0x0008; // COEF
constexpr std::uint16_t status_event     = 0x0080; // UPEVNT
constexpr std::uint16_t status_forward   = 0x0020; // QDF
constexpr std::int64_t  timer_most       = 65535;
constexpr std::uint16_t capture_enable   = 0x8000; // QCAPCTL

constexpr int pin_a     = 20;
constexpr int pin_b     = 21;
constexpr int pin_index = 23;

bool clocked()
{
    return SysCtrlRegs.PCLKCR1.bit.EQEP1ENCLK != 0U;
}

std::int64_t wrapped(std::int64_t x)
{
    const std::int64_t states = static_cast<std::int64_t>(EQep1Regs.QPOSMAX) + 1;
    const std::int64_t y      = x % states;
    return y < 0 ? y + states : y;
}

} // namespace

bool EncoderUnit::connected(int pin) const
{
    return Gpio::is_muxed(pin, 1);
}

void EncoderUnit::present()
{
    auto &r             = EQep1Regs;
    presented_position_ = static_cast<std::uint32_t>(position_);
    presented_timer_    = static_cast<std::uint32_t>(timer_);
    r.QPOSCNT           = presented_position_;
    r.QUTMR             = presented_timer_;
    r.QPOSLAT           = latch_;
    r.QPOSILAT          = index_latch_;
    r.QFLG.all          = flags_;
    presented_status_   = static_cast<std::uint16_t>(status_ | (forward_ ? status_forward : 0U));
    r.QEPSTS.all        = presented_status_;
    r.QCTMRLAT          = timer_latch_;
    r.QCPRDLAT          = period_latch_;
    r.QCPRD             = capture_period_;
}

void EncoderUnit::raise(std::uint16_t flag)
{
    flags_ = static_cast<std::uint16_t>(flags_ | flag);
    if ((EQep1Regs.QEINT.all & flag) != 0U && (flags_ & flag_int) == 0U) {
        flags_     = static_cast<std::uint16_t>(flags_ | flag_int);
        interrupt_ = true;
    }
}

void EncoderUnit::sync(Findings &findings, double time_s)
{
    auto      &r      = EQep1Regs;
    const auto refuse = [&](bool wrong, const char *what) {
        if (wrong && r.QEPCTL.bit.QPEN != 0U) {
            findings.add(Finding::unsupported, what, time_s);
        }
    };
    refuse(r.QEPCTL.bit.PCRM != 1U, "EQep1Regs: only a reset at QPOSMAX is modelled");
    refuse(r.QDECCTL.bit.QSRC != 0U, "EQep1Regs: only quadrature counting is modelled");
    refuse(r.QEPCTL.bit.IEL > 1U,
           "EQep1Regs: of the index latches only the rising edge is modelled");
    const std::uint16_t settings = r.QCAPCTL.all;
    refuse((settings & capture_settings_ & capture_enable) != 0U && settings != capture_settings_,
           "EQep1Regs: QCAPCTL changed while the capture runs");
    capture_settings_ = settings;
    if (r.QEPSTS.all != presented_status_) { // written: ones clear
        status_ = static_cast<std::uint16_t>(status_ & ~r.QEPSTS.all);
    }
    if (r.QPOSCNT != presented_position_) {
        position_ = r.QPOSCNT;
    }
    if (r.QUTMR != presented_timer_) {
        timer_ = r.QUTMR;
    }
    flags_     = static_cast<std::uint16_t>(flags_ & ~r.QCLR.all);
    r.QCLR.all = 0;
    present();
}

std::int64_t EncoderUnit::capture_timer(std::int64_t now_ticks) const
{
    return (now_ticks - event_ticks_) >> EQep1Regs.QCAPCTL.bit.CCPS;
}

void EncoderUnit::capture(std::int64_t edge_ticks, bool forward)
{
    if (EQep1Regs.QCAPCTL.bit.CEN == 0U || ++edges_to_event_ < 1 << EQep1Regs.QCAPCTL.bit.UPPS) {
        return;
    }
    const std::int64_t passed = capture_timer(edge_ticks);
    const auto         set    = [this](bool wrong, std::uint16_t flag) {
        status_ = static_cast<std::uint16_t>(status_ | (wrong ? flag : 0U));
    };
    set(true, status_event);
    set(passed > timer_most, status_overflow);
    set(forward != event_forward_, status_direction);
    capture_period_ = static_cast<std::uint16_t>(passed & timer_most);
    edges_to_event_ = 0;
    event_ticks_    = edge_ticks;
    event_forward_  = forward;
}

void EncoderUnit::move(const ShaftCount &shaft, std::int64_t now_ticks)
{
    const std::int64_t sign        = EQep1Regs.QDECCTL.bit.SWAP != 0U ? -1 : 1;
    const std::int64_t moved       = have_last_ ? shaft.count - last_ : 0;
    const std::int64_t since_index = shaft.count - shaft.index_count;
    last_                          = shaft.count;
    have_last_                     = true;
    if (!clocked() || EQep1Regs.QEPCTL.bit.QPEN == 0U) {
        return;
    }
    if (connected(pin_a) && connected(pin_b)) {
        position_ = wrapped(position_ + sign * moved);
        if (moved != 0) {
            forward_ = sign * moved > 0;
        }
        for (const ShaftEdge &edge : shaft.edges) {
            forward_ = sign * edge.direction > 0;
            capture(now_ticks - std::llround(edge.age_s * tick_Hz), forward_);
        }
        for (std::int64_t n = 0; shaft.edges.empty() && n < std::abs(moved); n++) {
            capture(now_ticks, forward_);
        }
        if (shaft.phase_error) {
            raise(flag_phase);
        }
    }
    if (shaft.index && connected(pin_index) && EQep1Regs.QEPCTL.bit.IEL == 1U) {
        index_latch_ = static_cast<std::uint32_t>(wrapped(position_ - sign * since_index));
        raise(flag_index);
    }
    present();
}

std::int64_t EncoderUnit::cycles_to_timeout() const
{
    if (!clocked() || EQep1Regs.QEPCTL.bit.UTE == 0U || EQep1Regs.QUPRD == 0U) {
        return -1;
    }
    const std::int64_t left = static_cast<std::int64_t>(EQep1Regs.QUPRD) - timer_;
    return left > 0 ? left : 1;
}

bool EncoderUnit::step(std::int64_t cycles)
{
    if (cycles_to_timeout() < 0) {
        return false;
    }
    timer_ += cycles;
    const bool out = timer_ >= static_cast<std::int64_t>(EQep1Regs.QUPRD);
    if (out) {
        timer_ = 0;
    }
    present();
    return out;
}

void EncoderUnit::latch(std::int64_t now_ticks)
{
    if (EQep1Regs.QEPCTL.bit.QCLM != 0U) {
        latch_        = static_cast<std::uint32_t>(position_);
        timer_latch_  = static_cast<std::uint16_t>(capture_timer(now_ticks) & timer_most);
        period_latch_ = capture_period_;
    }
    raise(flag_unit);
    present();
}

bool EncoderUnit::take_interrupt()
{
    const bool now = interrupt_;
    interrupt_     = false;
    return now;
}

} // namespace sdre::f28335
