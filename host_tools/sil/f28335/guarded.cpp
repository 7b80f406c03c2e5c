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

void Guard::add_can()
{
    const auto clocked = [] { return SysCtrlRegs.PCLKCR0.bit.ECANAENCLK != 0U; };
    auto      &r       = ECanaRegs;
    add("ECanaRegs", &r, sizeof(r), false, clocked);
    add("ECanaMboxes", &ECanaMboxes, sizeof(ECanaMboxes), false, clocked);
    add("ECanaLAMRegs", &ECanaLAMRegs, sizeof(ECanaLAMRegs), false, clocked);
    add("ECanaMOTSRegs", &ECanaMOTSRegs, sizeof(ECanaMOTSRegs), false, clocked);
    add("ECanaMOTORegs", &ECanaMOTORegs, sizeof(ECanaMOTORegs), false, clocked);
    add("CANMC", &r.CANMC, sizeof(r.CANMC), true);
    add("CANBTC", &r.CANBTC, sizeof(r.CANBTC), true);
    add("CANGIM", &r.CANGIM, sizeof(r.CANGIM), true);
    add("CANMIM", &r.CANMIM, sizeof(r.CANMIM), true);
    add("CANTIOC", &r.CANTIOC, sizeof(r.CANTIOC), true);
    add("CANRIOC", &r.CANRIOC, sizeof(r.CANRIOC), true);
    add("CANTSC", &r.CANTSC, sizeof(r.CANTSC), true);
}

void Guard::add(const std::string &name, volatile void *data, std::size_t bytes, bool eallow,
                const std::function<bool()> &clocked)
{
    regions_.push_back({name, static_cast<unsigned char *>(const_cast<void *>(data)), bytes, eallow,
                        clocked, std::vector<unsigned char>(bytes)});
}

void Guard::remember()
{
    for (Region &r : regions_) {
        std::memcpy(r.copy.data(), r.data, r.bytes);
    }
}

void Guard::check(bool eallow, Findings &findings, double time_s)
{
    for (Region &r : regions_) {
        if (std::memcmp(r.copy.data(), r.data, r.bytes) == 0) {
            continue;
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
