/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"

/* A control interrupt that comes later than one and a half periods trips by itself (control_isr.c); a quarter more, so
 * that this one is the first to know only when there is none, or when it does not end. */
#define QUARTERS 7UL

/* CPU timer 1 asks the processor without the PIE in between, and may interrupt a tick. It starts anew on its own. */
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

void tick_watch_serve(void)
{
    CpuTimer1Regs.TCR.bit.TRB = 1U; /* reload */
}
