/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"
#include "yield.h"

void cycles_init(void)
{
    CpuTimer0Regs.TCR.bit.TSS = 1U; /* stop */
    CpuTimer0Regs.PRD.all     = 0xFFFFFFFFUL;
    CpuTimer0Regs.TPR.all     = 0U; /* every cycle counts */
    CpuTimer0Regs.TPRH.all    = 0U;
    CpuTimer0Regs.TCR.bit.TRB = 1U; /* reload */
    CpuTimer0Regs.TCR.bit.TSS = 0U; /* run */
}

uint32_t board_cycles(void)
{
    return 0xFFFFFFFFUL - cycles_left();
}

void cycles_wait(uint32_t cycles)
{
    const uint32_t start = board_cycles();
    while ((board_cycles() - start) < cycles) {
        BOARD_YIELD();
    }
}
