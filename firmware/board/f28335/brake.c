/* SPDX-License-Identifier: MIT */
/* Holding brake at EPWM6A. Two things end its release without the program. The unit has the trip of
 * the legs (trip.c): a bridge that is off, by TZ1 too, forces the output low. And the counter holds
 * the pin as that of the chopper does: a debugger's halt stops the commands, and CMPA clears it. */
#include "DSP28x_Project.h"
#include "peripherals.h"

#define HSPCLKDIV_BY_2 1U
#define CLKDIV_BY_32   5U /* 2.34 MHz */
#define RUNS_IN_HALT   2U
#define TOP_cnt        0xFFFFU
#define HOLD_cnt       23438U  /* 10 ms, chosen: commands come within 2.2 ms, app_slow.h */
#define LOW_AT_CMPA    0x0010U /* AQCTLA: CAU clears; nothing sets */
#define FORCE_LOW      0x0005U /* AQSFRC: output A, once */
#define FORCE_HIGH     0x0006U

/* The trip is armed, and forces the output low. */
void brake_init(void)
{
    EPwm6Regs.TBCTL.bit.CTRMODE    = TB_FREEZE;
    EPwm6Regs.TBCTL.bit.FREE_SOFT  = RUNS_IN_HALT;
    EPwm6Regs.TBCTL.bit.CLKDIV     = CLKDIV_BY_32;
    EPwm6Regs.TBCTL.bit.HSPCLKDIV  = HSPCLKDIV_BY_2;
    EPwm6Regs.TBCTL.bit.PHSEN      = TB_DISABLE;
    EPwm6Regs.TBCTL.bit.SYNCOSEL   = TB_SYNC_DISABLE;
    EPwm6Regs.TBCTL.bit.PRDLD      = TB_IMMEDIATE;
    EPwm6Regs.TBPRD                = TOP_cnt;
    EPwm6Regs.TBCTR                = 0U;
    EPwm6Regs.CMPCTL.bit.SHDWAMODE = CC_IMMEDIATE;
    EPwm6Regs.CMPA.half.CMPA       = HOLD_cnt;
    EPwm6Regs.AQCTLA.all           = LOW_AT_CMPA;
    EPwm6Regs.AQCTLB.all           = 0U;
    EPwm6Regs.AQSFRC.all           = FORCE_LOW;
    EPwm6Regs.TBCTL.bit.CTRMODE    = TB_COUNT_UP;
}

void board_brake_write(bool release)
{
    if (release) {
        EPwm6Regs.TBCTR = 0U; /* first: the old count may be close to CMPA */
    }
    EPwm6Regs.AQSFRC.all = release ? FORCE_HIGH : FORCE_LOW;
}
