// SPDX-License-Identifier: MIT
// eCAN-A as the firmware sees it: what it writes, and what it may read.
#include "sil/f28335/ecan_unit.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "sil/f28335/ecan_registers.hpp"

namespace sdre::f28335 {
namespace {

constexpr std::uint64_t marker     = 0x5EC4A700; // in the upper word of a register of 64 bits
constexpr unsigned      word_shift = 32;

std::uint64_t marked(std::uint32_t shown)
{
    return (marker << word_shift) | shown;
}

unsigned quanta()
{
    const auto &btc = ECanaRegs.CANBTC.bit;
    return 3U + btc.TSEG1REG + btc.TSEG2REG;
}

/// Rules of the controller's manual for its bit timing.
bool timing_is_allowed()
{
    const auto    &btc   = ECanaRegs.CANBTC.bit;
    const unsigned tseg1 = btc.TSEG1REG + 1U;
    const unsigned tseg2 = btc.TSEG2REG + 1U;
    return btc.BRPREG > 0U && tseg2 >= 2U && tseg1 >= tseg2 && btc.SJWREG + 1U <= tseg2 &&
           (btc.SAM == 0U || btc.BRPREG >= 4U);
}

} // namespace

EcanUnit::EcanUnit(CanBus &bus) : bus_(bus)
{
    flags_ = es::sa1;
    bus_.connect(*this);
    present();
    remember();
}

EcanUnit::~EcanUnit()
{
    bus_.disconnect();
}

double EcanUnit::sample_point()
{
    return (2.0 + ECanaRegs.CANBTC.bit.TSEG1REG) / quanta();
}

void EcanUnit::sync(std::int64_t now, const Clock &clock, Findings &findings, double time_s)
{
    now_ = now;
    if (!ecan_is_clocked()) {
        on_bus_ = false;
        return;
    }
    const Report report{findings, time_s};
    count_bits(now); // at the rate until here
    rate_Hz_ = 0.5 * clock.sysclk_Hz() / ((ECanaRegs.CANBTC.bit.BRPREG + 1U) * quanta());
    take_time();
    take_flags(report);
    take_requests(report);
    take_status(report);
    take_mailboxes(report);
    take_mode(report);
    look_for_unsupported(report);
    update_mode();
    present();
}

/// Returns the word that the firmware has written into one of the registers of 64 bits; 0 if none.
std::uint32_t EcanUnit::taken(volatile Uint64 &reg, std::uint32_t shown, const char *name,
                              const Report &report) const
{
    const std::uint64_t value = reg;
    if (value == marked(shown)) {
        return 0;
    }
    if (value >> word_shift == marker) {
        report.say(fmt::format("{}: read-modify-write acts on other flags", name));
    } else if (value >> word_shift != 0U) {
        report.say(fmt::format("{}: more than 32 bits written", name));
    }
    return static_cast<std::uint32_t>(value);
}

void EcanUnit::take_requests(const Report &report)
{
    auto               &r       = ECanaRegs;
    const std::uint32_t enabled = r.CANME_word[0].all;
    const std::uint32_t set     = taken(r.CANTRS_word[0].all, trs_, "CANTRS", report);
    if ((set & ~enabled) != 0U) {
        report.say("CANTRS: the mailbox is not enabled");
    }
    trs_ |= set;
    if ((set & enabled & ~sendable()) != 0U && r.CANMC.bit.CDR == 0U) {
        report.say("CANTRS: the mailbox is one for receiving");
    }
    const std::uint32_t reset   = taken(r.CANTRR_word[0].all, trr_, "CANTRR", report) & trs_;
    const std::uint32_t on_wire = sending_ ? 1U << static_cast<unsigned>(*sending_) : 0U;
    trr_ |= reset & on_wire; // its end decides
    abort(reset & ~on_wire);
}

void EcanUnit::take_flags(const Report &report)
{
    auto &r = ECanaRegs;
    ta_ &= ~taken(r.CANTA_word[0].all, ta_, "CANTA", report);
    aa_ &= ~taken(r.CANAA_word[0].all, aa_, "CANAA", report);
    rfp_ &= ~taken(r.CANRFP_word[0].all, rfp_, "CANRFP", report);
    if (r.CANRML_word[0].all != marked(rml_)) {
        report.say("CANRML: only a write to CANRMP clears it");
    }
    const std::uint32_t read = taken(r.CANRMP_word[0].all, rmp_, "CANRMP", report);
    rmp_ &= ~read;
    rml_ &= ~read;
}

void EcanUnit::take_status(const Report &report)
{
    const std::uint32_t value = ECanaRegs.CANES.all;
    if (value == shown_es_) {
        return;
    }
    if ((value & es::reserved) == es::marker) {
        report.say("CANES: read-modify-write clears other flags");
    }
    flags_ &= ~(value & es::clearable);
}

void EcanUnit::take_time()
{
    auto &mc = ECanaRegs.CANMC.bit;
    tsc_     = ECanaRegs.CANTSC != shown_tsc_ ? ECanaRegs.CANTSC : tsc_;
    tsc_     = mc.TCC != 0U ? tsc_ & 0x7FFFFFFFU : tsc_;
    mc.TCC   = 0;
}

/// Why the mailbox cannot be written now; null: it can.
const char *EcanUnit::refusal(int number, const Words &was, const Words &is) const
{
    const auto         &r       = ECanaRegs;
    const std::uint32_t bit     = 1U << static_cast<unsigned>(number);
    const bool          enabled = (r.CANME_word[0].all & bit) != 0U;
    const bool changes = r.CANMC.bit.CDR != 0U && r.CANMC.bit.MBNR == static_cast<unsigned>(number);
    if (!enabled) {
        return nullptr;
    }
    if (is[0] != was[0]) {
        return "MSGID written while the mailbox is enabled";
    }
    if ((r.CANMD.all & bit) != 0U) {
        return "written while the mailbox receives";
    }
    return (trs_ & bit) != 0U && !changes ? "written while its request is pending" : nullptr;
}

void EcanUnit::take_mailboxes(const Report &report)
{
    const std::uint32_t enabled = ECanaRegs.CANME_word[0].all;
    if (((ECanaRegs.CANMD.all ^ shown_md_) & shown_me_ & enabled) != 0U) {
        report.say("CANMD: direction changed while the mailbox is enabled");
    }
    if (std::memcmp(boxes_.data(), const_cast<ECAN_MBOXES *>(&ECanaMboxes), sizeof(boxes_)) == 0) {
        return;
    }
    for (int n = 0; n < mailboxes; n++) {
        volatile MBOX &box = mailbox(n);
        const Words    is{box.MSGID.all, box.MSGCTRL.all, box.MDL.all, box.MDH.all};
        const Words   &was = boxes_[static_cast<std::size_t>(n)];
        const char    *why = is == was ? nullptr : refusal(n, was, is);
        if (why != nullptr) { // no effect
            report.say(fmt::format("MBOX{}: {}", n, why));
            box.MSGID.all   = was[0];
            box.MSGCTRL.all = was[1];
            box.MDL.all     = was[2];
            box.MDH.all     = was[3];
        }
    }
    remember();
}

void EcanUnit::remember()
{
    std::memcpy(boxes_.data(), const_cast<ECAN_MBOXES *>(&ECanaMboxes), sizeof(boxes_));
}

/// The bit timing belongs to the configuration.
void EcanUnit::take_timing(const Report &report)
{
    if (ECanaRegs.CANBTC.all != shown_btc_ && mode_ != Mode::configuration) {
        report.say("CANBTC: written while CCE is 0");
        ECanaRegs.CANBTC.all = shown_btc_;
    }
}

void EcanUnit::take_mode(const Report &report)
{
    take_timing(report);
    if (ECanaRegs.CANMC.bit.SRES != 0U) {
        soft_reset();
    }
    const bool wanted = ECanaRegs.CANMC.bit.CCR != 0U;
    if (wanted && mode_ != Mode::configuration && !sending_) {
        mode_ = Mode::configuration;
    } else if (!wanted && mode_ == Mode::configuration) {
        if (!timing_is_allowed()) {
            report.say("CANBTC: no allowed bit timing");
            return;
        }
        mode_         = Mode::joining;
        joining_from_ = bus_.recessive_ticks(now_);
        tsc_at_       = now_;
        if (!bus_off_) {
            counters_.reset();
        }
    }
}

void EcanUnit::look_for_unsupported(const Report &report) const
{
    const auto &r  = ECanaRegs;
    const auto &mc = r.CANMC.bit;
    if (mc.SCB == 0U && r.CANME_word[0].all != 0U) {
        report.say("ECanaRegs: only the eCAN mode is modelled", Finding::unsupported);
    }
    if (mc.STM != 0U || mc.PDR != 0U) {
        report.say("ECanaRegs: self-test and power-down are not modelled", Finding::unsupported);
    }
    if (r.CANMIM.all != 0U || r.CANGIM.bit.I0EN != 0U || r.CANGIM.bit.I1EN != 0U) {
        report.say("ECanaRegs: interrupts are not modelled", Finding::unsupported);
    }
    if (r.CANTOC.all != 0U) {
        report.say("ECanaRegs: time-outs are not modelled", Finding::unsupported);
    }
    for (std::uint32_t left = trs_, n = 0; left != 0U; left >>= 1U, n++) {
        if ((left & 1U) != 0U && mailbox(static_cast<int>(n)).MSGCTRL.bit.DLC > 8U) {
            report.say(fmt::format("MBOX{}: DLC above 8", n));
        }
    }
}

/// All but what is protected, the mailboxes and the error counters.
void EcanUnit::soft_reset()
{
    auto &r             = ECanaRegs;
    r.CANME_word[0].all = 0;
    r.CANMD.all         = 0;
    r.CANOPC.all        = 0;
    r.CANMIL.all        = 0;
    r.CANTOC.all        = 0;
    r.CANTOS.all        = 0;
    r.CANMC.bit.SRES    = 0;
    trs_ = trr_ = ta_ = aa_ = rmp_ = rml_ = rfp_ = 0;
    flags_                                       = es::sa1;
}

void EcanUnit::present()
{
    auto &r              = ECanaRegs;
    r.CANTRS_word[0].all = marked(trs_);
    r.CANTRR_word[0].all = marked(trr_);
    r.CANTA_word[0].all  = marked(ta_);
    r.CANAA_word[0].all  = marked(aa_);
    r.CANRMP_word[0].all = marked(rmp_);
    r.CANRML_word[0].all = marked(rml_);
    r.CANRFP_word[0].all = marked(rfp_);
    flags_ |= (counters_.warning() ? es::ew : 0U) | (counters_.passive() ? es::ep : 0U) |
              (bus_off_ ? es::bo : 0U);
    shown_es_ = es::marker | flags_ | (sending_ ? es::tm : 0U) | (hears_ ? es::rm : 0U) |
                (mode_ == Mode::configuration ? es::cce : 0U);
    const auto recovered =
        (bus_.recessive_ticks(now_) - bus_off_from_) / std::max<std::int64_t>(1, ticks(11));
    r.CANES.all  = shown_es_;
    r.CANTEC.all = static_cast<std::uint32_t>(counters_.transmit()) & 0xFFU;
    r.CANREC.all = static_cast<std::uint32_t>(bus_off_ ? recovered : counters_.receive()) & 0xFFU;
    r.CANTSC     = tsc_;
    shown_tsc_   = tsc_;
    shown_me_    = r.CANME_word[0].all;
    shown_md_    = r.CANMD.all;
    shown_btc_   = r.CANBTC.all;
}

} // namespace sdre::f28335
