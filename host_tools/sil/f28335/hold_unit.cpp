// SPDX-License-Identifier: MIT
#include "sil/f28335/hold_unit.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace sdre::f28335 {
namespace {

constexpr unsigned      clears_at_cmpa = 1U << 4;
constexpr std::uint16_t flag_ost       = 4;

} // namespace

bool HoldUnit::clocked() const
{
    return (SysCtrlRegs.PCLKCR1.all & (1U << (number_ - 1))) != 0U;
}

bool HoldUnit::running() const
{
    return clocked() && SysCtrlRegs.PCLKCR0.bit.TBCLKSYNC != 0U &&
           r_.TBCTL.bit.CTRMODE == TB_COUNT_UP && r_.TBPRD != 0U;
}

int HoldUnit::cycles_per_count() const
{
    const int high = r_.TBCTL.bit.HSPCLKDIV;
    return (high == 0 ? 1 : 2 * high) << r_.TBCTL.bit.CLKDIV;
}

void HoldUnit::check_settings(Findings &findings, double time_s) const
{
    const auto refuse = [&](bool wrong, const char *what) {
        if (wrong) {
            findings.add(Finding::unsupported, fmt::format("EPwm{}Regs: {}", number_, what),
                         time_s);
        }
    };
    const unsigned mode = r_.TBCTL.bit.CTRMODE;
    refuse(mode != TB_COUNT_UP && mode != TB_FREEZE, "only up counting is modelled");
    refuse(r_.TBCTL.bit.PHSEN != 0U, "synchronisation is not modelled");
    refuse(mode == TB_COUNT_UP && r_.CMPCTL.bit.SHDWAMODE != CC_IMMEDIATE,
           "CMPA has no shadow in the model");
    refuse((r_.AQCTLA.all != 0U && r_.AQCTLA.all != clears_at_cmpa) || r_.AQCTLB.all != 0U,
           "the only action that is modelled clears A at CMPA");
    refuse(r_.AQCSFRC.all != 0U || (r_.AQSFRC.all & ~0x7U) != 0U,
           "software forces output A once, or not at all");
    refuse(r_.DBCTL.all != 0U || r_.PCCTL.all != 0U, "dead band and chopper are not modelled");
    refuse((r_.TZSEL.all & 0x3EFFU) != 0U || r_.TZEINT.all != 0U,
           "of the trips only OSHT1 is modelled");
    refuse(r_.TZSEL.all != 0U && r_.TZCTL.bit.TZA != TZ_FORCE_LO, "a trip forces A low");
    refuse(r_.ETSEL.all != 0U, "events are not modelled");
}

void HoldUnit::present()
{
    r_.TBCTR       = static_cast<std::uint16_t>(position_ / cycles_per_count());
    presented_ctr_ = r_.TBCTR;
}

void HoldUnit::sync_trip(bool fault_pin_low)
{
    one_shot_ = one_shot_ && (r_.TZCLR.all & flag_ost) == 0U;
    one_shot_ = one_shot_ || r_.TZFRC.bit.OST != 0U || (fault_pin_low && r_.TZSEL.bit.OSHT1 != 0U);
    r_.TZCLR.all = 0U;
    r_.TZFRC.all = 0U;
    r_.TZFLG.all = one_shot_ ? flag_ost : std::uint16_t{0};
}

void HoldUnit::sync(bool fault_pin_low, Findings &findings, double time_s)
{
    if (!clocked()) {
        return;
    }
    sync_trip(fault_pin_low);
    check_settings(findings, time_s);
    if (r_.TBCTR != presented_ctr_) {
        position_ = static_cast<std::int64_t>(r_.TBCTR) * cycles_per_count();
    }
    if (r_.AQSFRC.bit.OTSFA != 0U) {
        const unsigned action = r_.AQSFRC.bit.ACTSFA;
        high_                 = action == AQ_SET || (action == AQ_TOGGLE      ? !high_
                                                     : action == AQ_NO_ACTION ? high_
                                                                              : false);
        r_.AQSFRC.bit.OTSFA   = 0U;
    }
    present();
}

std::int64_t HoldUnit::cycles_to_event() const
{
    if (!high_ || !running() || r_.AQCTLA.all != clears_at_cmpa) {
        return -1;
    }
    const std::int64_t compare = static_cast<std::int64_t>(r_.CMPA.half.CMPA) * cycles_per_count();
    const std::int64_t turn    = (static_cast<std::int64_t>(r_.TBPRD) + 1) * cycles_per_count();
    const std::int64_t left    = compare - position_;
    return left > 0 ? left : left + turn;
}

void HoldUnit::step(std::int64_t cycles)
{
    if (!running()) {
        return;
    }
    const std::int64_t event = cycles_to_event();
    const std::int64_t turn  = (static_cast<std::int64_t>(r_.TBPRD) + 1) * cycles_per_count();
    high_                    = high_ && (event < 0 || cycles < event);
    position_                = (position_ + cycles) % turn;
    present();
}

} // namespace sdre::f28335
