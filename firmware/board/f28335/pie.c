/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"
#include "yield.h"

#define VECTORS ((uint16_t)(sizeof(PieVectTable) / sizeof(PINT)))

/* Only the control interrupt and its watch are enabled. Any other one is a trap, an NMI or a
 * program error. The loop does not serve the watchdog, which then resets the device. */
static __interrupt void unexpected(void)
{
    board_gate_trip();
    for (;;) {
        BOARD_YIELD();
    }
}

void pie_init(void)
{
    DINT;
    IER = 0U;
    IFR = 0U;

    EALLOW;
    volatile PINT *const vectors = (volatile PINT *)&PieVectTable;
    for (uint16_t vector = 0U; vector < VECTORS; vector++) {
        vectors[vector] = &unexpected;
    }
    PieVectTable.SEQ1INT = &control_isr;
    EDIS;

    PieCtrlRegs.PIEIER1.all  = 0U;
    PieCtrlRegs.PIEIER2.all  = 0U;
    PieCtrlRegs.PIEIER3.all  = 0U;
    PieCtrlRegs.PIEIER4.all  = 0U;
    PieCtrlRegs.PIEIER5.all  = 0U;
    PieCtrlRegs.PIEIER6.all  = 0U;
    PieCtrlRegs.PIEIER7.all  = 0U;
    PieCtrlRegs.PIEIER8.all  = 0U;
    PieCtrlRegs.PIEIER9.all  = 0U;
    PieCtrlRegs.PIEIER10.all = 0U;
    PieCtrlRegs.PIEIER11.all = 0U;
    PieCtrlRegs.PIEIER12.all = 0U;
    PieCtrlRegs.PIEIFR1.all  = 0U;

    PieCtrlRegs.PIECTRL.bit.ENPIE = 1U; /* traps use this vector table from here on */
}

void pie_start(void)
{
    PieCtrlRegs.PIEIER1.bit.INTx1 = 1U; /* ADC sequencer 1 */
    PieCtrlRegs.PIEACK.all        = PIEACK_GROUP1;
    IER                           = M_INT1 | M_INT13; /* CPU timer 1: tick_watch.c */
    EINT;
    ERTM; /* interrupts stay on under a debugger */
}
