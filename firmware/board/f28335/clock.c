/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"
#include "yield.h"

/* The PLL locks within 131072 crystal cycles (data sheet). The processor then runs at a quarter of
 * the crystal rate, so these are 32768 processor cycles. A poll takes four or more cycles: the
 * limit is at least five times the lock time. */
#define LOCK_POLLS 40000U

static bool wait_for_lock(void)
{
    for (uint16_t poll = 0U; poll < LOCK_POLLS; poll++) {
        if (SysCtrlRegs.PLLSTS.bit.PLLLOCKS != 0U) {
            return true;
        }
        BOARD_YIELD();
    }
    return false;
}

bool clock_init(void)
{
    if (!clock_is_good()) {
        return false; /* limp mode: a few MHz from the PLL alone */
    }

    EALLOW;
    SysCtrlRegs.PLLSTS.bit.DIVSEL  = 0U; /* a quarter: no step to full speed while locking */
    SysCtrlRegs.PLLSTS.bit.MCLKOFF = 1U; /* the detector would misread the change */
    SysCtrlRegs.PLLCR.bit.DIV      = CLOCK_PLL_MULTIPLIER;
    EDIS;

    const bool locked = wait_for_lock();

    EALLOW;
    SysCtrlRegs.PLLSTS.bit.MCLKOFF = 0U; /* watch the crystal from here on */
    if (locked) {
        SysCtrlRegs.PLLSTS.bit.DIVSEL = CLOCK_PLL_DIVSEL; /* 150 MHz */
    }
    EDIS;

    return locked && clock_is_good();
}

void clock_peripherals(void)
{
    EALLOW;
    SysCtrlRegs.PCLKCR0.bit.TBCLKSYNC = 0U; /* PWM counters stand still */

    SysCtrlRegs.HISPCP.all = CLOCK_HISPCP; /* ADC: 25 MHz */
    SysCtrlRegs.LOSPCP.all = CLOCK_LOSPCP; /* SCI: 37.5 MHz */

    SysCtrlRegs.PCLKCR0.bit.ADCENCLK       = 1U;
    SysCtrlRegs.PCLKCR0.bit.SCIAENCLK      = 1U;
    SysCtrlRegs.PCLKCR0.bit.ECANAENCLK     = 1U;
    SysCtrlRegs.PCLKCR1.bit.EPWM1ENCLK     = 1U;
    SysCtrlRegs.PCLKCR1.bit.EPWM2ENCLK     = 1U;
    SysCtrlRegs.PCLKCR1.bit.EPWM3ENCLK     = 1U;
    SysCtrlRegs.PCLKCR1.bit.EPWM6ENCLK     = 1U;
    SysCtrlRegs.PCLKCR1.bit.EQEP1ENCLK     = 1U;
    SysCtrlRegs.PCLKCR3.bit.CPUTIMER0ENCLK = 1U;
    SysCtrlRegs.PCLKCR3.bit.CPUTIMER1ENCLK = 1U;
    EDIS;
}
