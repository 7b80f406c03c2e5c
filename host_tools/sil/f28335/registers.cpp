// SPDX-License-Identifier: MIT
#include "sil/f28335/registers.hpp"

#include <cstdint>
#include <cstring>
#include <initializer_list>

volatile struct ADC_REGS               AdcRegs;
volatile struct ADC_RESULT_MIRROR_REGS AdcMirror;
volatile struct CPUTIMER_REGS          CpuTimer0Regs;
volatile struct CPUTIMER_REGS          CpuTimer1Regs;
volatile struct CPUTIMER_REGS          CpuTimer2Regs;
volatile struct ECAN_REGS              ECanaRegs;
volatile struct ECAN_MBOXES            ECanaMboxes;
volatile struct LAM_REGS               ECanaLAMRegs;
volatile struct MOTS_REGS              ECanaMOTSRegs;
volatile struct MOTO_REGS              ECanaMOTORegs;
volatile struct EPWM_REGS              EPwm1Regs;
volatile struct EPWM_REGS              EPwm2Regs;
volatile struct EPWM_REGS              EPwm3Regs;
volatile struct EPWM_REGS              EPwm4Regs;
volatile struct EPWM_REGS              EPwm5Regs;
volatile struct EPWM_REGS              EPwm6Regs;
volatile struct EQEP_REGS              EQep1Regs;
volatile struct EQEP_REGS              EQep2Regs;
volatile struct FLASH_REGS             FlashRegs;
volatile struct GPIO_CTRL_REGS         GpioCtrlRegs;
volatile struct GPIO_DATA_REGS         GpioDataRegs;
volatile struct PIE_CTRL_REGS          PieCtrlRegs;
struct PIE_VECT_TABLE                  PieVectTable;
volatile struct SCI_REGS               SciaRegs;
volatile struct SCI_REGS               ScibRegs;
volatile struct SCI_REGS               ScicRegs;
volatile struct SYS_CTRL_REGS          SysCtrlRegs;
volatile Uint16                        IER;
volatile Uint16                        IFR;

namespace sdre::f28335 {
namespace {

template <typename T> void clear(volatile T &x)
{
    std::memset(const_cast<T *>(&x), 0, sizeof(T));
}

void reset_pwm(volatile EPWM_REGS &r)
{
    clear(r);
    r.TBCTL.all = 0x0083; // frozen, TBCLK = SYSCLK / 2
}

void reset_sci(volatile SCI_REGS &r)
{
    clear(r);
    r.SCICTL2.all = 0x00C0; // ready to send
    r.SCIFFTX.all = 0xA000;
    r.SCIFFRX.all = 0x201F;
}

/// Memory without a value after power-on.
template <typename T> void scramble(volatile T &x)
{
    auto         *words = reinterpret_cast<volatile std::uint32_t *>(&x);
    std::uint32_t word  = 0;
    for (std::size_t n = 0; n < sizeof(T) / sizeof(word); n++) {
        word += 0x9E3779B9U;
        words[n] = word;
    }
}

void reset_can()
{
    clear(ECanaRegs);
    ECanaRegs.CANMC.bit.CCR = 1; // it begins in configuration
    scramble(ECanaMboxes);
    scramble(ECanaLAMRegs);
    scramble(ECanaMOTSRegs);
    scramble(ECanaMOTORegs);
}

void reset_timer(volatile CPUTIMER_REGS &r)
{
    clear(r);
    r.TIM.all = 0x0000FFFF;
    r.PRD.all = 0x0000FFFF;
}

} // namespace

void reset_registers()
{
    clear(AdcRegs);
    clear(AdcMirror);
    for (volatile CPUTIMER_REGS *r : {&CpuTimer0Regs, &CpuTimer1Regs, &CpuTimer2Regs}) {
        reset_timer(*r);
    }
    for (volatile EPWM_REGS *r :
         {&EPwm1Regs, &EPwm2Regs, &EPwm3Regs, &EPwm4Regs, &EPwm5Regs, &EPwm6Regs}) {
        reset_pwm(*r);
    }
    reset_can();
    clear(EQep1Regs);
    clear(EQep2Regs);
    clear(GpioCtrlRegs);
    GpioCtrlRegs.GPAPUD.all = 0x00000FFF; // pull-ups of the PWM pins are off, all others on
    clear(GpioDataRegs);
    clear(PieCtrlRegs);
    clear(PieVectTable);
    for (volatile SCI_REGS *r : {&SciaRegs, &ScibRegs, &ScicRegs}) {
        reset_sci(*r);
    }
    clear(SysCtrlRegs);
    SysCtrlRegs.PLLSTS.bit.PLLLOCKS = 1;      // nothing to lock while the PLL is bypassed
    SysCtrlRegs.HISPCP.all          = 0x0001; // SYSCLKOUT / 2
    SysCtrlRegs.LOSPCP.all          = 0x0002; // SYSCLKOUT / 4
    clear(FlashRegs);
    FlashRegs.FSTDBYWAIT.all  = 0x01FF; // the slowest of everything
    FlashRegs.FACTIVEWAIT.all = 0x01FF;
    FlashRegs.FBANKWAIT.all   = 0x0F0F;
    FlashRegs.FOTPWAIT.all    = 0x001F;
    IER                       = 0;
    IFR                       = 0;
}

} // namespace sdre::f28335
