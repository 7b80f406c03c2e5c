/* SPDX-License-Identifier: MIT */
/* Brake chopper at EPWM5A. A plain pin would stay high when a debugger halts the processor or when
 * the tick stops. So the counter holds the pin: a command starts it at 0, and the output goes low
 * at CMPA unless the next command comes before. */
#include "DSP28x_Project.h"
#include "peripherals.h"

#if BOARD_CHOPPER

#define HSPCLKDIV_BY_2 1U
#define RUNS_IN_HALT   2U /* a debugger halt does not stop the counter: the pin goes low */
#define TOP_cnt        0xFFFFU
#define LOW_AT_CMPA    0x0010U /* AQCTLA: CAU clears; nothing sets */
#define FORCE_LOW      0x0005U /* AQSFRC: once, output A */

/* No trip acts on this unit: TZSEL stays 0. TZ1 opens the bridge, and a fast motor then charges the
 * dc link through the diodes. That is when the chopper is needed. */
void chopper_init(const board_setup_t *setup)
{
    EALLOW;
    SysCtrlRegs.PCLKCR1.bit.EPWM5ENCLK = 1U; /* TBCLKSYNC is 0: the counter stands */
    EDIS;
    EPwm5Regs.TBCTL.bit.CTRMODE    = TB_FREEZE;
    EPwm5Regs.TBCTL.bit.FREE_SOFT  = RUNS_IN_HALT;
    EPwm5Regs.TBCTL.bit.CLKDIV     = TB_DIV1;
    EPwm5Regs.TBCTL.bit.HSPCLKDIV  = HSPCLKDIV_BY_2; /* 75 MHz, as the legs */
    EPwm5Regs.TBCTL.bit.PHSEN      = TB_DISABLE;
    EPwm5Regs.TBCTL.bit.SYNCOSEL   = TB_SYNC_DISABLE;
    EPwm5Regs.TBCTL.bit.PRDLD      = TB_IMMEDIATE;
    EPwm5Regs.TBPRD                = TOP_cnt;
    EPwm5Regs.TBCTR                = 0U;
    EPwm5Regs.CMPCTL.bit.SHDWAMODE = CC_IMMEDIATE;
    EPwm5Regs.CMPA.half.CMPA       = (uint16_t)(3U * setup->duty_full_cnt); /* 1.5 PWM periods */
    EPwm5Regs.AQCTLA.all           = LOW_AT_CMPA;
    EPwm5Regs.AQCTLB.all           = 0U;
    EPwm5Regs.AQSFRC.all           = FORCE_LOW;
    EPwm5Regs.TBCTL.bit.CTRMODE    = TB_COUNT_UP;
    gpio_use_chopper();
}

#endif
