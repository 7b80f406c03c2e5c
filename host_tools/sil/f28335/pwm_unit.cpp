// SPDX-License-Identifier: MIT
#include "sil/f28335/pwm_unit.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace sdre::f28335 {
namespace {

constexpr std::uint16_t flag_int = 1;
constexpr std::uint16_t flag_cbc = 2;
constexpr std::uint16_t flag_ost = 4;
constexpr std::uint16_t et_int   = 1;
constexpr std::uint16_t et_soc_a = 4;

} // namespace

PwmUnit::PwmUnit(volatile EPWM_REGS &registers, int number) : r_(registers), number_(number) {}

bool PwmUnit::running() const
{
    const bool clocked = ((SysCtrlRegs.PCLKCR1.all >> (number_ - 1)) & 1U) != 0U;
    return clocked && SysCtrlRegs.PCLKCR0.bit.TBCLKSYNC != 0U &&
           r_.TBCTL.bit.CTRMODE == TB_COUNT_UPDOWN && r_.TBPRD != 0U;
}

int PwmUnit::cycles_per_count() const
{
    const int high = r_.TBCTL.bit.HSPCLKDIV;
    return (high == 0 ? 1 : 2 * high) << r_.TBCTL.bit.CLKDIV;
}

std::int64_t PwmUnit::half_cycles() const
{
    return static_cast<std::int64_t>(r_.TBPRD) * cycles_per_count();
}

void PwmUnit::present()
{
    const auto count = position_ / cycles_per_count();
    const auto top   = static_cast<std::int64_t>(r_.TBPRD);
    r_.TBCTR         = static_cast<std::uint16_t>(count < top ? count : 2 * top - count);
    presented_ctr_   = r_.TBCTR;
    r_.TBSTS.all     = count < top ? 1U : 0U;
    r_.TZFLG.all     = tz_flags_;
    r_.ETFLG.all     = et_flags_;
}

void PwmUnit::check_settings(Findings &findings, double time_s) const
{
    const auto refuse = [&](bool wrong, const char *what) {
        if (wrong) {
            findings.add(Finding::unsupported, fmt::format("EPwm{}Regs: {}", number_, what),
                         time_s);
        }
    };
    refuse(r_.TBCTL.bit.CTRMODE != TB_COUNT_UPDOWN && r_.TBCTL.bit.CTRMODE != TB_FREEZE,
           "only up-down counting is modelled");
    refuse(r_.TBCTL.bit.PHSEN != 0U, "synchronisation is not modelled");
    refuse((r_.TZSEL.all & 0x3EFFU) != 0U, "of the trips only OSHT1 is modelled");
    refuse(r_.ETSEL.bit.SOCBEN != 0U, "SOCB is not modelled");
    refuse(r_.ETSEL.bit.SOCASEL > 2U && r_.ETSEL.bit.SOCAEN != 0U,
           "SOCA at a compare is not modelled");
    refuse(r_.AQSFRC.all != 0U || r_.AQCSFRC.all != 0U, "software forcing is not modelled");
    // AQCTLA has no shadow. Only its actions at the ends of a control period may change within it.
    const unsigned at_ends = two_updates() ? 0xFU : 0xCU;
    refuse(began_ && ((r_.AQCTLA.all ^ aqctla_) & ~at_ends) != 0U,
           "AQCTLA changes within a control period");
    refuse(r_.PCCTL.bit.CHPEN != 0U, "the chopper is not modelled");
}

void PwmUnit::sync_trip(bool fault_pin_low)
{
    const bool before = one_shot_;
    tz_flags_         = static_cast<std::uint16_t>(tz_flags_ & ~r_.TZCLR.all);
    one_shot_         = one_shot_ && (r_.TZCLR.all & flag_ost) == 0U;
    one_shot_ = one_shot_ || r_.TZFRC.bit.OST != 0U || (fault_pin_low && r_.TZSEL.bit.OSHT1 != 0U);
    r_.TZCLR.all = 0U;
    r_.TZFRC.all = 0U;
    if (one_shot_) {
        const bool tell = !before && r_.TZEINT.bit.OST != 0U && (tz_flags_ & flag_int) == 0U;
        tz_flags_       = static_cast<std::uint16_t>(tz_flags_ | flag_ost);
        if (tell) {
            tz_flags_       = static_cast<std::uint16_t>(tz_flags_ | flag_int);
            trip_interrupt_ = true;
        }
    }
    tz_flags_ = static_cast<std::uint16_t>(tz_flags_ & ~flag_cbc);
}

void PwmUnit::sync(bool fault_pin_low, Findings &findings, double time_s)
{
    check_settings(findings, time_s);
    if (r_.TBCTR != presented_ctr_) { // written: counts up from there
        position_ = std::min<std::int64_t>(r_.TBCTR, r_.TBPRD) * cycles_per_count();
    }
    if (r_.CMPCTL.bit.SHDWAMODE != CC_SHADOW) {
        cmpa_ = r_.CMPA.half.CMPA;
    }
    if (r_.CMPCTL.bit.SHDWBMODE != CC_SHADOW) {
        cmpb_ = r_.CMPB;
    }
    sync_trip(fault_pin_low);
    et_flags_    = static_cast<std::uint16_t>(et_flags_ & ~r_.ETCLR.all);
    r_.ETCLR.all = 0U;
    present();
}

std::int64_t PwmUnit::cycles_to_event() const
{
    if (!running()) {
        return -1;
    }
    const std::int64_t half = half_cycles();
    return position_ < half ? half - position_ : 2 * half - position_;
}

bool PwmUnit::at_period() const
{
    return running() && position_ == half_cycles();
}

bool PwmUnit::count_event(unsigned select, unsigned enable, unsigned every, int &count,
                          const PwmEvents &now) const
{
    const bool hit = enable != 0U &&
                     ((select == ET_CTR_ZERO && now.zero) || (select == ET_CTR_PRD && now.period));
    if (!hit || every == 0U || ++count < static_cast<int>(every)) {
        return false;
    }
    count = 0;
    return true;
}

PwmEvents PwmUnit::step(std::int64_t cycles)
{
    PwmEvents now;
    if (!running()) {
        return now;
    }
    const std::int64_t half   = half_cycles();
    const std::int64_t before = position_;
    position_                 = (position_ + cycles) % (2 * half);
    now.period                = before < half && before + cycles >= half;
    now.zero                  = before + cycles >= 2 * half;

    const auto loads = [&](unsigned mode) {
        return (now.zero && (mode == CC_CTR_ZERO || mode == CC_CTR_ZERO_PRD)) ||
               (now.period && (mode == CC_CTR_PRD || mode == CC_CTR_ZERO_PRD));
    };
    if (now.zero || now.period) {
        cmpa_before_ = cmpa_;
        cmpb_before_ = cmpb_;
    }
    if (loads(r_.CMPCTL.bit.LOADAMODE)) {
        cmpa_ = r_.CMPA.half.CMPA;
    }
    if (loads(r_.CMPCTL.bit.LOADBMODE)) {
        cmpb_ = r_.CMPB;
    }
    now.soc_a = count_event(r_.ETSEL.bit.SOCASEL, r_.ETSEL.bit.SOCAEN, r_.ETPS.bit.SOCAPRD,
                            soc_a_count_, now);
    if (now.soc_a) {
        et_flags_ = static_cast<std::uint16_t>(et_flags_ | et_soc_a);
    }
    now.interrupt =
        count_event(r_.ETSEL.bit.INTSEL, r_.ETSEL.bit.INTEN, r_.ETPS.bit.INTPRD, int_count_, now) &&
        (et_flags_ & et_int) == 0U;
    if (now.interrupt) {
        et_flags_ = static_cast<std::uint16_t>(et_flags_ | et_int);
    }
    present();
    return now;
}

bool PwmUnit::take_trip_interrupt()
{
    const bool now  = trip_interrupt_;
    trip_interrupt_ = false;
    return now;
}

bool PwmUnit::at_zero() const
{
    return running() && position_ == 0;
}

LegPeriod PwmUnit::begin_period(Count count, AtLoad at_load)
{
    LegRegisters now{r_.TBPRD,      cmpa_,        cmpb_,    r_.AQCTLA.all,
                     r_.AQCTLB.all, r_.DBCTL.all, r_.DBRED, r_.DBFED};
    if (at_load == AtLoad::old_values) {
        now.cmpa_at_start = cmpa_before_;
        now.cmpb_at_start = cmpb_before_;
    }
    aqctla_ = r_.AQCTLA.all;
    began_  = true;
    return leg_period(now, count, memory_);
}

int PwmUnit::trip_action_a() const
{
    return r_.TZCTL.bit.TZA;
}

int PwmUnit::trip_action_b() const
{
    return r_.TZCTL.bit.TZB;
}

} // namespace sdre::f28335
