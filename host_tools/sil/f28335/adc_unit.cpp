// SPDX-License-Identifier: MIT
#include "sil/f28335/adc_unit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {
namespace {

constexpr std::int64_t power_up_ticks = 750000; // 5 ms
constexpr unsigned     all_powered    = 0xE0;
constexpr double       fastest_Hz     = 25e6;
constexpr int          states         = 8;
constexpr double       window_s       = 160e-9; // advisory: a first pair needs a longer one
constexpr unsigned     overstated     = 4095;   // and is often read as full scale otherwise

std::uint16_t code_of(double V)
{
    return static_cast<std::uint16_t>(
        std::clamp(std::floor(4096.0 * V / 3.0), 0.0, 4095.0)); // EQ-CONVERTER-1
}

double adcclk_Hz(const Clock &clock)
{
    const unsigned ps = AdcRegs.ADCTRL3.bit.ADCCLKPS;
    return clock.hspclk_Hz() / (ps == 0U ? 1.0 : 2.0 * ps) / (AdcRegs.ADCTRL1.bit.CPS + 1.0);
}

int channel_of(int state)
{
    const volatile std::uint16_t *select = &AdcRegs.ADCCHSELSEQ1.all;
    return (select[state / 4] >> (4 * (state % 4))) & 7;
}

} // namespace

AdcUnit::AdcUnit(Input input) : input_(std::move(input)) {}

int AdcUnit::pairs() const
{
    return AdcRegs.ADCMAXCONV.bit.MAX_CONV1 + 1;
}

void AdcUnit::present() const
{
    AdcRegs.ADCST.all     = static_cast<std::uint16_t>((flag_ ? 1U : 0U) | (busy_ ? 4U : 0U));
    AdcRegs.ADCASEQSR.all = static_cast<std::uint16_t>(state_);
}

void AdcUnit::sync(std::int64_t now_ticks)
{
    const bool powered = (AdcRegs.ADCTRL3.all & all_powered) == all_powered;
    if (!powered) {
        powered_at_ = -1;
    } else if (powered_at_ < 0) {
        powered_at_ = now_ticks;
    }
    if (AdcRegs.ADCTRL2.bit.RST_SEQ1 != 0U) {
        state_                       = 0;
        busy_                        = false;
        AdcRegs.ADCTRL2.bit.RST_SEQ1 = 0;
    }
    if (AdcRegs.ADCST.bit.INT_SEQ1_CLR != 0U) {
        flag_ = false;
    }
    present();
}

void AdcUnit::calibrate(Findings &findings, double time_s)
{
    if (SysCtrlRegs.PCLKCR0.bit.ADCENCLK == 0U) {
        findings.add(Finding::adc, "ADC_cal() while the converter's clock is off", time_s);
        return;
    }
    calibrated_ = true;
}

void AdcUnit::start_of_conversion(std::int64_t now, const Clock &clock, Findings &findings,
                                  double time_s)
{
    if (SysCtrlRegs.PCLKCR0.bit.ADCENCLK == 0U || AdcRegs.ADCTRL2.bit.EPWM_SOCA_SEQ1 == 0U) {
        return;
    }
    const auto check = [&](bool wrong, Finding kind, const char *what) {
        if (wrong) {
            findings.add(kind, what, time_s);
        }
    };
    check(AdcRegs.ADCTRL3.bit.SMODE_SEL == 0U, Finding::unsupported,
          "AdcRegs: only simultaneous sampling is modelled");
    check(AdcRegs.ADCTRL1.bit.CONT_RUN != 0U, Finding::unsupported,
          "AdcRegs: continuous run is not modelled");
    check(adcclk_Hz(clock) > fastest_Hz * 1.0001, Finding::adc, "ADCCLK above 25 MHz");
    check(powered_at_ < 0 || now - powered_at_ < power_up_ticks, Finding::adc,
          "converter used within 5 ms after power-up");
    check(!calibrated_, Finding::adc, "converter used without ADC_cal()");
    check(busy_, Finding::adc, "triggered while a conversion runs");
    if (busy_) {
        return;
    }
    busy_                     = true;
    first_                    = state_;
    running_pairs_            = pairs();
    const double acq          = AdcRegs.ADCTRL1.bit.ACQ_PS;
    const bool   short_window = (1.0 + acq) / adcclk_Hz(clock) < 1.0001 * window_s;
    for (int n = 0; n < running_pairs_; n++) {
        const int state = (first_ + n) % states;
        for (int side = 0; side < 2; side++) {
            codes_[static_cast<std::size_t>(2 * state + side)] =
                n == 0 && short_window ? overstated : code_of(input_(side, channel_of(state)));
        }
    }
    const double clocks = 2.5 + (1.0 + acq) + 5.0 + (running_pairs_ - 1) * (3.0 + acq);
    end_ticks_          = now + static_cast<std::int64_t>(
                           std::ceil(clocks / adcclk_Hz(clock) * tick_Hz)); // EQ-CONVERTER-2
    present();
}

std::int64_t AdcUnit::ticks_to_end(std::int64_t now) const
{
    return busy_ ? std::max<std::int64_t>(0, end_ticks_ - now) : -1;
}

bool AdcUnit::finish()
{
    volatile std::uint16_t *left  = &AdcRegs.ADCRESULT0;
    volatile std::uint16_t *right = &AdcMirror.ADCRESULT0;
    for (int n = 0; n < running_pairs_; n++) {
        for (int side = 0; side < 2; side++) {
            const int at = 2 * ((first_ + n) % states) + side;
            right[at]    = codes_[static_cast<std::size_t>(at)];
            left[at]     = static_cast<std::uint16_t>(codes_[static_cast<std::size_t>(at)] << 4U);
        }
    }
    busy_            = false;
    state_           = (first_ + running_pairs_) % states;
    const bool first = !flag_;
    flag_            = true;
    present();
    return first && AdcRegs.ADCTRL2.bit.INT_ENA_SEQ1 != 0U; // a flag that stands makes no new edge
}

} // namespace sdre::f28335
