/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"

#define HSPCLKDIV_BY_2    1U
#define HALT_AT_CYCLE_END 1U /* a debugger's halt leaves all upper switches on: zero voltage */

static uint16_t full_cnt; /* compare counts of duty one: TBPRD */

/* The counter goes 0 .. TBPRD .. 0. The upper switch is on around 0, all lower ones around TBPRD: there the
 * currents are sampled, and there a control period begins. */
static void set_up_leg(volatile struct EPWM_REGS *leg, uint16_t dead_time_cnt)
{
    leg->TBCTL.bit.CTRMODE   = TB_FREEZE;
    leg->TBCTL.bit.FREE_SOFT = HALT_AT_CYCLE_END;
    leg->TBCTL.bit.CLKDIV    = TB_DIV1;
    leg->TBCTL.bit.HSPCLKDIV = HSPCLKDIV_BY_2; /* 75 MHz */
    leg->TBCTL.bit.PHSEN     = TB_DISABLE;     /* TBCLKSYNC starts the legs together */
    leg->TBCTL.bit.SYNCOSEL  = TB_SYNC_DISABLE;
    leg->TBCTL.bit.PRDLD     = TB_IMMEDIATE; /* written once, here */
    leg->TBPRD               = full_cnt;
    leg->TBCTR               = 0U;
    leg->TBPHS.all           = 0U;

    leg->CMPCTL.bit.SHDWAMODE = CC_SHADOW;
    leg->CMPA.half.CMPA       = 0U;

    leg->AQCTLA.all     = 0U;
    leg->AQCTLA.bit.CAU = AQ_CLEAR;
    leg->AQCTLA.bit.CAD = AQ_SET; /* at full duty it meets PRD, and goes before it */
    leg->AQCTLA.bit.ZRO = AQ_SET; /* a half that begins here starts high, at no duty CAU beats it */
    leg->AQCTLA.bit.PRD = AQ_CLEAR; /* and one that begins there low: full duty leaves it high */
    leg->AQCTLB.all     = 0U;       /* output B is made from A by the dead band */

    leg->DBCTL.bit.IN_MODE  = DBA_ALL;
    leg->DBCTL.bit.POLSEL   = DB_ACTV_HIC;
    leg->DBRED              = dead_time_cnt;
    leg->DBFED              = dead_time_cnt;
    leg->DBCTL.bit.OUT_MODE = DB_FULL_ENABLE;

    leg->ETSEL.all         = 0U; /* no interrupt, no trigger */
    leg->TBCTL.bit.CTRMODE = TB_COUNT_UPDOWN;
}

static uint16_t at_most_full(uint16_t duty_cnt)
{
    return (duty_cnt < full_cnt) ? duty_cnt : full_cnt;
}

void pwm_init(const board_setup_t *setup)
{
    full_cnt = setup->duty_full_cnt;
    set_up_leg(&EPwm1Regs, setup->dead_time_cnt);
    set_up_leg(&EPwm2Regs, setup->dead_time_cnt);
    set_up_leg(&EPwm3Regs, setup->dead_time_cnt);
}

/* Samples are taken while all lower switches are on; with two updates also while all upper ones are, for which a unit
 * has no second trigger of its own. A new duty acts from the start of the next control period on. */
static void one_update(void)
{
    EPwm1Regs.CMPCTL.bit.LOADAMODE = CC_CTR_PRD;
    EPwm2Regs.CMPCTL.bit.LOADAMODE = CC_CTR_PRD;
    EPwm3Regs.CMPCTL.bit.LOADAMODE = CC_CTR_PRD;
}

static void two_updates(void)
{
    EPwm1Regs.CMPCTL.bit.LOADAMODE = CC_CTR_ZERO_PRD;
    EPwm2Regs.CMPCTL.bit.LOADAMODE = CC_CTR_ZERO_PRD;
    EPwm3Regs.CMPCTL.bit.LOADAMODE = CC_CTR_ZERO_PRD;

    EPwm2Regs.ETPS.bit.SOCAPRD  = ET_1ST;
    EPwm2Regs.ETSEL.bit.SOCASEL = ET_CTR_ZERO;
    EPwm2Regs.ETSEL.bit.SOCAEN  = 1U;
}

void pwm_start(uint16_t updates_per_period)
{
    if (updates_per_period == 2U) {
        two_updates();
    } else {
        one_update();
    }

    EPwm1Regs.ETPS.bit.SOCAPRD  = ET_1ST;
    EPwm1Regs.ETSEL.bit.SOCASEL = ET_CTR_PRD;
    EPwm1Regs.ETSEL.bit.SOCAEN  = 1U;

    EALLOW;
    SysCtrlRegs.PCLKCR0.bit.TBCLKSYNC = 1U;
    EDIS;
}

void board_duty_write(const board_duty_t *duty)
{
    EPwm1Regs.CMPA.half.CMPA = at_most_full(duty->a_cnt);
    EPwm2Regs.CMPA.half.CMPA = at_most_full(duty->b_cnt);
    EPwm3Regs.CMPA.half.CMPA = at_most_full(duty->c_cnt);
}
