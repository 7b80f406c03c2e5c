/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"

#define FREE_RUN         2U /* a debugger's halt loses no counts */
#define RESET_AT_MAX     1U /* PCRM; the index is compared in software, never jumped to */
#define LATCH_RISING     1U /* IEL */
#define LATCH_AT_TIMEOUT 1U /* QCLM */
#define EVERY_EDGE       0U /* UPPS */

/* Only an edge in the period before the latch is timed. The capture timer does not overflow in that
 * time (board.c). */
#if (BOARD_CAPTURE_Hz << CLOCK_CAPTURE_SHIFT) != CLOCK_SYSCLK_Hz
#error "BOARD_CAPTURE_Hz is not the capture clock of this board"
#endif

/* QFLG and QCLR. */
#define PHASE_ERROR 0x0004U
#define INDEX       0x0400U
#define TIMEOUT     0x0800U
#define SUMMARY     0x0001U

#define TURNED_BACK 0x0004U /* QEPSTS: CDEF, written 1 to clear */

/* Three phase errors within 10 ms trip, a single one does not. Each error adds 10 ms to a level
 * that decreases with time. */
#define PER_10_ms 100UL

static uint32_t pwm_cycles;   /* of a PWM period */
static uint16_t half_cnt;     /* counts of the PWM in half of it */
static uint16_t before_cnt;   /* position of the sample before */
static uint16_t phase_errors; /* since the start */
static uint16_t error_level;  /* control periods */
static uint16_t error_step;   /* control periods in 10 ms */
static bool     at_zero_too;  /* control periods begin at ZERO and PRD */

void encoder_init(const board_setup_t *setup)
{
    pwm_cycles            = setup->pwm_cycles;
    half_cnt              = setup->duty_full_cnt;
    EQep1Regs.QEPCTL.all  = 0U;
    EQep1Regs.QDECCTL.all = 0U; /* quadrature, not swapped */
    EQep1Regs.QEINT.all   = 0U;
    EQep1Regs.QPOSCNT     = 0UL;
    EQep1Regs.QPOSINIT    = 0UL;
    EQep1Regs.QPOSMAX =
        (uint32_t)setup->positions - 1U; /* the highest position, not their number */
    EQep1Regs.QEPCTL.bit.FREE_SOFT = FREE_RUN;
    EQep1Regs.QEPCTL.bit.PCRM      = RESET_AT_MAX;
    EQep1Regs.QEPCTL.bit.IEL       = LATCH_RISING;
    EQep1Regs.QEPCTL.bit.QCLM      = LATCH_AT_TIMEOUT;
    EQep1Regs.QEPCTL.bit.QPEN      = 1U;
    EQep1Regs.QCAPCTL.all          = 0U; /* its settings must not change while it runs */
    EQep1Regs.QCAPCTL.bit.CCPS     = CLOCK_CAPTURE_SHIFT;
    EQep1Regs.QCAPCTL.bit.UPPS     = EVERY_EDGE;
    EQep1Regs.QCAPCTL.bit.CEN      = 1U;
    before_cnt                     = 0U;
    phase_errors                   = 0U;
    error_level                    = 0U;
    EQep1Regs.QCLR.all             = PHASE_ERROR | INDEX | TIMEOUT | SUMMARY;
}

/* The PWM starts at ZERO, half a period before PRD. */
void encoder_start(uint16_t updates_per_period)
{
    EQep1Regs.QUPRD = pwm_cycles / updates_per_period;
    EQep1Regs.QUTMR = (updates_per_period == 1U) ? (pwm_cycles / 2UL) : 0UL;
    at_zero_too     = updates_per_period == 2U;
    error_step      = (uint16_t)(((CLOCK_SYSCLK_Hz / PER_10_ms) / pwm_cycles) * updates_per_period);
    EQep1Regs.QEPCTL.bit.UTE = 1U;
}

/* Aligns the unit timer with the PWM counter in every period. A debugger halt or a cycle of
 * difference in the timer's period then does not accumulate. */
static void align(void)
{
    const bool down = EPwm1Regs.TBSTS.bit.CTRDIR == 0U; /* less than half a period since PRD */

    if (down || at_zero_too) {
        const uint32_t count     = EPwm1Regs.TBCTR;
        const uint32_t since_cnt = down ? ((uint32_t)half_cnt - count) : count;
        EQep1Regs.QUTMR          = CLOCK_SYSCLK_PER_TBCLK * since_cnt;
    }
}

static void count_phase_errors(bool error)
{
    if (!error && (error_level == 0U)) {
        return; /* every period without errors */
    }
    error_level = (uint16_t)(error_level - ((error_level > 0U) ? 1U : 0U));
    if (error) {
        phase_errors = (uint16_t)(phase_errors + 1U);
        error_level  = (uint16_t)(error_level + error_step);
    }
    if (error_level >= (2U * error_step)) {
        error_level = (uint16_t)(2U * error_step);
        trip_latch(BOARD_FAULT_ENCODER);
    }
}

bool encoder_read(board_sample_t *sample)
{
    const uint16_t flags  = EQep1Regs.QFLG.all;
    const uint16_t status = EQep1Regs.QEPSTS.all;
    EQep1Regs.QCLR.all    = (uint16_t)(flags & (PHASE_ERROR | INDEX | TIMEOUT | SUMMARY));
    EQep1Regs.QEPSTS.all  = TURNED_BACK;
    align();
    count_phase_errors((flags & PHASE_ERROR) != 0U);

    sample->position_cnt = (uint16_t)EQep1Regs.QPOSLAT;
    sample->edge_age_cnt = EQep1Regs.QCTMRLAT;
    sample->edge_seen    = (sample->position_cnt != before_cnt) && ((status & TURNED_BACK) == 0U);
    sample->index_cnt    = (uint16_t)EQep1Regs.QPOSILAT;
    sample->index_seen   = (flags & INDEX) != 0U;
    sample->phase_errors = phase_errors;
    before_cnt           = sample->position_cnt;
    return (flags & TIMEOUT) != 0U;
}
