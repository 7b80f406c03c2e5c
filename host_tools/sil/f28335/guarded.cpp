// SPDX-License-Identifier: MIT
#include "sil/f28335/guarded.hpp"

#include <cstring>

#include <fmt/format.h>

#include "sil/f28335/registers.hpp"

namespace sdre::f28335 {

Guard::Guard()
{
    const auto words = [](volatile void *from, volatile void *past) {
        return static_cast<std::size_t>(static_cast<volatile char *>(past) -
                                        static_cast<volatile char *>(from));
    };
    add("SysCtrlRegs", &SysCtrlRegs, sizeof(SysCtrlRegs), true);
    add("FlashRegs", &FlashRegs, sizeof(FlashRegs), true);
    add("PieVectTable", &PieVectTable, sizeof(PieVectTable), true);
    add("GpioCtrlRegs", &GpioCtrlRegs, sizeof(GpioCtrlRegs), true);
    int n = 0;
    for (volatile EPWM_REGS *r :
         {&EPwm1Regs, &EPwm2Regs, &EPwm3Regs, &EPwm4Regs, &EPwm5Regs, &EPwm6Regs}) {
        const std::string name    = fmt::format("EPwm{}Regs", n + 1);
        const auto        clocked = [n] { return ((SysCtrlRegs.PCLKCR1.all >> n) & 1U) != 0U; };
        add(name, r, sizeof(*r), false, clocked);
        add(name + ".TZ", &r->TZSEL, words(&r->TZSEL, &r->ETSEL), true);
        add(name + ".HRCNFG", &r->HRCNFG, sizeof(r->HRCNFG), true);
        n++;
    }
    add("EQep1Regs", &EQep1Regs, sizeof(EQep1Regs), false,
        [] { return SysCtrlRegs.PCLKCR1.bit.EQEP1ENCLK != 0U; });
    add("AdcRegs", &AdcRegs, sizeof(AdcRegs), false,
        [] { return SysCtrlRegs.PCLKCR0.bit.ADCENCLK != 0U; });
    add("SciaRegs", &SciaRegs, sizeof(SciaRegs), false,
        [] { return SysCtrlRegs.PCLKCR0.bit.SCIAENCLK != 0U; });
    add_can();
    add("CpuTimer0Regs", &CpuTimer0Regs, sizeof(CpuTimer0Regs), false,
        [] { return SysCtrlRegs.PCLKCR3.bit.CPUTIMER0ENCLK != 0U; });
    add("CpuTimer1Regs", &CpuTimer1Regs, sizeof(CpuTimer1Regs), false,
        [] { return SysCtrlRegs.PCLKCR3.bit.CPUTIMER1ENCLK != 0U; });
    remember();
}

/// A write to the mailboxes without a clock is not reported: their copies would cost every device time.
void Guard::add_can()
{
    auto &r = ECanaRegs;
    add("ECanaRegs", &r, sizeof(r), false, [] { return SysCtrlRegs.PCLKCR0.bit.ECANAENCLK != 0U; });
    const auto protect = [&](const char *name, const volatile Uint32 &all) {
        const auto offset = reinterpret_cast<const volatile char *>(&all) -
                            reinterpret_cast<const volatile char *>(&r);
        regions_.back().parts.push_back({name, static_cast<std::size_t>(offset), sizeof(all)});
    };
    protect("CANMC", r.CANMC.all);
    protect("CANBTC", r.CANBTC.all);
    protect("CANGIM", r.CANGIM.all);
    protect("CANMIM", r.CANMIM.all);
    protect("CANTIOC", r.CANTIOC.all);
    protect("CANRIOC", r.CANRIOC.all);
    protect("CANTSC", r.CANTSC);
}

void Guard::add(const std::string &name, volatile void *data, std::size_t bytes, bool eallow,
                const std::function<bool()> &clocked)
{
    regions_.push_back({name,
                        static_cast<unsigned char *>(const_cast<void *>(data)),
                        bytes,
                        eallow,
                        clocked,
                        std::vector<unsigned char>(bytes),
                        {}});
}

void Guard::remember()
{
    for (Region &r : regions_) {
        std::memcpy(r.copy.data(), r.data, r.bytes);
    }
}

void Guard::restore_parts(Region &r, Findings &findings, double time_s)
{
    for (const Part &p : r.parts) {
        if (std::memcmp(r.copy.data() + p.offset, r.data + p.offset, p.bytes) != 0) {
            findings.add(Finding::eallow, fmt::format("{}: written without EALLOW", p.name),
                         time_s);
            std::memcpy(r.data + p.offset, r.copy.data() + p.offset, p.bytes);
        }
    }
}

void Guard::check(bool eallow, Findings &findings, double time_s)
{
    for (Region &r : regions_) {
        if (std::memcmp(r.copy.data(), r.data, r.bytes) == 0) {
            continue;
        }
        if (!eallow && !r.parts.empty()) {
            restore_parts(r, findings, time_s);
            if (std::memcmp(r.copy.data(), r.data, r.bytes) == 0) {
                continue;
            }
        }
        std::size_t at = 0;
        while (r.copy[at] == r.data[at]) {
            at++;
        }
        if (r.eallow && !eallow) {
            findings.add(Finding::eallow,
                         fmt::format("{}: word {:02X} written without EALLOW", r.name, at / 2),
                         time_s);
            std::memcpy(r.data, r.copy.data(), r.bytes);
        } else if (r.clocked && !r.clocked()) {
            findings.add(
                Finding::no_clock,
                fmt::format("{}: word {:02X} written while its clock is off", r.name, at / 2),
                time_s);
            std::memcpy(r.data, r.copy.data(), r.bytes);
        } else {
            std::memcpy(r.copy.data(), r.data, r.bytes);
        }
    }
}

} // namespace sdre::f28335
