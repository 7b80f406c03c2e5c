/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"

#define HSPCLKDIV_BY_2    1U
#define HALT_AT_CYCLE_END 1U /* a debugger halt ends with all upper switches on: zero voltage */

/* CMPCTL: A and B with shadows. */
#define LOADS_AT_PRD  0x0005U
#define LOADS_AT_BOTH 0x000AU /* ZERO and PRD */

/* AQCTLA: CAD sets, CBU clears; and the level from PRD and from ZERO on. */
#define EDGES     0x0180U
#define PRD_LOW   0x0004U
#define PRD_HIGH  0x0008U
#define ZERO_LOW  0x0001U
#define ZERO_HIGH 0x0002U

static uint16_t full_cnt;      /* compare counts of duty one: TBPRD */
static bool     loads_at_zero; /* two updates per period */

/* The counter goes 0 .. TBPRD .. 0. The upper switch is on around 0, all lower ones are on around
 * TBPRD. At TBPRD the currents are sampled and a control period begins. */
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

    leg->CMPCTL.all     = LOADS_AT_PRD;
    leg->CMPA.half.CMPA = 0U;
    leg->CMPB           = 0U;

    leg->AQCTLA.all = EDGES | PRD_LOW;
    leg->AQCTLB.all = 0U; /* output B is made from A by the dead band */

    leg->DBCTL.bit.IN_MODE  = DBA_ALL;
    leg->DBCTL.bit.POLSEL   = DB_ACTV_HIC;
    leg->DBRED              = dead_time_cnt;
    leg->DBFED              = dead_time_cnt;
    leg->DBCTL.bit.OUT_MODE = DB_FULL_ENABLE;

    leg->ETSEL.all         = 0U; /* no interrupt, no trigger */
    leg->TBCTL.bit.CTRMODE = TB_COUNT_UPDOWN;
}

void pwm_init(const board_setup_t *setup)
{
    full_cnt = setup->duty_full_cnt;
    set_up_leg(&EPwm1Regs, setup->dead_time_cnt);
    set_up_leg(&EPwm2Regs, setup->dead_time_cnt);
    set_up_leg(&EPwm3Regs, setup->dead_time_cnt);
}

/* The converter samples while all lower switches are on. With two updates it also samples while all
 * upper ones are on; unit 2 triggers this, as unit 1 has no second trigger. A new duty acts from
 * the start of the next control period. */
void pwm_start(uint16_t updates_per_period)
{
    loads_at_zero = updates_per_period == 2U;

    const uint16_t loads = loads_at_zero ? LOADS_AT_BOTH : LOADS_AT_PRD;
    EPwm1Regs.CMPCTL.all = loads;
    EPwm2Regs.CMPCTL.all = loads;
    EPwm3Regs.CMPCTL.all = loads;

    if (loads_at_zero) {
        EPwm2Regs.ETPS.bit.SOCAPRD  = ET_1ST;
        EPwm2Regs.ETSEL.bit.SOCASEL = ET_CTR_ZERO;
        EPwm2Regs.ETSEL.bit.SOCAEN  = 1U;
    }
    EPwm1Regs.ETPS.bit.SOCAPRD  = ET_1ST;
    EPwm1Regs.ETSEL.bit.SOCASEL = ET_CTR_PRD;
    EPwm1Regs.ETSEL.bit.SOCAEN  = 1U;

    EALLOW;
    SysCtrlRegs.PCLKCR0.bit.TBCLKSYNC = 1U;
    EDIS;
}

/* The guide does not say whether the old or the new compare value acts at the instant of a load.
 * Therefore no compare event sets a level there. An action at PRD, and at ZERO if it loads, sets
 * it: actions have no shadow and are written before. CMPA stays below TBPRD. CMPB may be TBPRD,
 * where PRD has priority over CBU. If ZERO loads, CMPB is at least 1. */
static void write_leg(volatile struct EPWM_REGS *leg, uint16_t duty_cnt)
{
    const bool full    = duty_cnt >= full_cnt;
    const bool none    = duty_cnt == 0U;
    uint16_t   actions = full ? (EDGES | PRD_HIGH) : (EDGES | PRD_LOW);
    uint16_t   ends    = full ? full_cnt : duty_cnt;

    if (loads_at_zero) {
        actions = (uint16_t)(actions | (none ? ZERO_LOW : ZERO_HIGH));
        ends    = none ? 1U : ends;
    }
    leg->CMPA.half.CMPA = full ? (uint16_t)(full_cnt - 1U) : duty_cnt;
    leg->CMPB           = ends;
    leg->AQCTLA.all     = actions;
}

void board_duty_write(const board_duty_t *duty)
{
    write_leg(&EPwm1Regs, duty->a_cnt);
    write_leg(&EPwm2Regs, duty->b_cnt);
    write_leg(&EPwm3Regs, duty->c_cnt);
}

#if BOARD_CHOPPER

/* AQSFRC: output A, once. */
#define CHOPPER_LOW  0x0005U
#define CHOPPER_HIGH 0x0006U

void board_chopper_write(bool on)
{
    if (on) {
        EPwm5Regs.TBCTR = 0U; /* first: the old count may be close to CMPA, chopper.c */
    }
    EPwm5Regs.AQSFRC.all = on ? CHOPPER_HIGH : CHOPPER_LOW;
}

#endif
