/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"

#define FREE_RUN         2U /* a debugger's halt loses no counts */
#define RESET_AT_MAX     1U /* PCRM; the index is compared in software, never jumped to */
#define LATCH_RISING     1U /* IEL */
#define LATCH_AT_TIMEOUT 1U /* QCLM */

/* QFLG and QCLR. */
#define PHASE_ERROR 0x0004U
#define INDEX       0x0400U
#define TIMEOUT     0x0800U
#define SUMMARY     0x0001U

void encoder_init(void)
{
    EQep1Regs.QEPCTL.all  = 0U;
    EQep1Regs.QDECCTL.all = 0U; /* quadrature, not swapped */
    EQep1Regs.QEINT.all   = 0U;
    EQep1Regs.QPOSCNT     = 0UL;
    EQep1Regs.QPOSINIT    = 0UL;
    EQep1Regs.QPOSMAX     = BOARD_POSITIONS - 1U; /* the highest position, not their number */
    EQep1Regs.QUPRD       = BOARD_TICK_CYCLES;
    EQep1Regs.QEPCTL.bit.FREE_SOFT = FREE_RUN;
    EQep1Regs.QEPCTL.bit.PCRM      = RESET_AT_MAX;
    EQep1Regs.QEPCTL.bit.IEL       = LATCH_RISING;
    EQep1Regs.QEPCTL.bit.QCLM      = LATCH_AT_TIMEOUT;
    EQep1Regs.QEPCTL.bit.QPEN      = 1U;
    EQep1Regs.QCLR.all             = PHASE_ERROR | INDEX | TIMEOUT | SUMMARY;
}

void encoder_start(void)
{
    EQep1Regs.QUTMR = BOARD_TICK_CYCLES / 2UL; /* the PWM starts half a period before PRD */
    EQep1Regs.QEPCTL.bit.UTE = 1U;
}

/* Ties the unit timer to the PWM counter every period, so that neither a halt by a debugger nor one
 * cycle more or less in the timer's period adds up. */
static void align(void)
{
    if (EPwm1Regs.TBSTS.bit.CTRDIR == 0U) { /* counting down: less than half a period since PRD */
        const uint32_t since_cnt = CLOCK_PWM_cnt - EPwm1Regs.TBCTR;
        EQep1Regs.QUTMR          = CLOCK_SYSCLK_PER_TBCLK * since_cnt;
    }
}

bool encoder_read(board_sample_t *sample)
{
    const uint16_t flags = EQep1Regs.QFLG.all;
    EQep1Regs.QCLR.all   = (uint16_t)(flags & (PHASE_ERROR | INDEX | TIMEOUT | SUMMARY));
    align();

    sample->position_cnt = (uint16_t)EQep1Regs.QPOSLAT;
    sample->index_cnt    = (uint16_t)EQep1Regs.QPOSILAT;
    sample->index_seen   = (flags & INDEX) != 0U;
    if ((flags & PHASE_ERROR) != 0U) {
        trip_remember(BOARD_FAULT_ENCODER);
        return false;
    }
    return (flags & TIMEOUT) != 0U;
}
