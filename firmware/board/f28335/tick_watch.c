/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"

/* Time limit in quarters of a control period. A control interrupt that is later than 1.5 periods
 * trips by itself (control_isr.c). This limit, 1.75 periods, detects a tick that is missing or
 * never ends. */
#define QUARTERS 7UL

/* ISR of CPU timer 1. It bypasses the PIE and may interrupt a tick. The timer reloads by itself. */
static __interrupt void tick_is_missing(void)
{
    trip_overdue();
}

void tick_watch_start(uint32_t period_cycles)
{
    EALLOW;
    PieVectTable.XINT13 = &tick_is_missing;
    EDIS;
    CpuTimer1Regs.TCR.bit.TSS = 1U; /* stop */
    CpuTimer1Regs.PRD.all     = QUARTERS * (period_cycles / 4UL);
    CpuTimer1Regs.TPR.all     = 0U;
    CpuTimer1Regs.TPRH.all    = 0U;
    CpuTimer1Regs.TCR.bit.TIE = 1U;
    tick_watch_serve();
    CpuTimer1Regs.TCR.bit.TSS = 0U;
}
