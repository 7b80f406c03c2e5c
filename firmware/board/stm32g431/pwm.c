/* SPDX-License-Identifier: MIT */
#include "clock_tree.h"
#include "peripherals.h"

#define CENTRED      1U /* CMS: up and down; compare flags are not used */
#define PWM_MODE_1   6U /* OCxM: on while the counter is below the compare value */
#define ON_UPDATE    2U /* MMS: the update event triggers converters and encoder latch */
#define EVERY_SECOND 1U /* RCR: one update for two ends of the counter's way */
#define LOCK_LEVEL_1 1U /* dead time, break and idle levels are fixed until a reset */
#define BREAK_FILTER 7U /* 32 cycles, 0.19 us: chosen, longer than the edges of a switching leg */

#define OUTPUTS                                                                                    \
    (TIM_CCER_CC1E | TIM_CCER_CC1NE | TIM_CCER_CC2E | TIM_CCER_CC2NE | TIM_CCER_CC3E |             \
     TIM_CCER_CC3NE)

static uint16_t full_cnt;

typedef struct {
    uint16_t least_cnt;
    uint16_t most_cnt;
    uint16_t step_cnt;
    uint16_t code; /* DTG of the least */
} range_t;

#define RANGE(least, most, step, code)                                                             \
    {                                                                                              \
        (least), (most), (step), (code)                                                            \
    }

static const range_t ranges[] = {CLOCK_DEAD_TIMES(RANGE)};

uint32_t pwm_dead_time(uint16_t dead_time_cnt)
{
    uint32_t code = 0UL;

    for (uint32_t n = 0UL; n < (uint32_t)(sizeof ranges / sizeof ranges[0]); n++) {
        const range_t *r = &ranges[n];

        if ((dead_time_cnt >= r->least_cnt) && (dead_time_cnt <= r->most_cnt) &&
            ((dead_time_cnt % r->step_cnt) == 0U)) {
            code = (uint32_t)r->code + (((uint32_t)dead_time_cnt - r->least_cnt) / r->step_cnt);
        }
    }
    return code;
}

/* The counter goes 0 .. ARR .. 0. The upper switch is on around 0, all lower ones are on around
 * ARR. There the currents are sampled and a control period begins. Compare value 0 is never on, and
 * ARR always. */
void pwm_init(const board_setup_t *setup)
{
    full_cnt  = setup->duty_full_cnt;
    TIM1->CR1 = TIM_CR1_CMS(CENTRED);
    TIM1->CR2 = TIM_CR2_MMS(ON_UPDATE);
    TIM1->ARR = full_cnt;
    TIM1->CCMR1 =
        TIM_CCMR1_OC1PE | TIM_CCMR1_OC1M(PWM_MODE_1) | TIM_CCMR1_OC2PE | TIM_CCMR1_OC2M(PWM_MODE_1);
    TIM1->CCMR2 = TIM_CCMR2_OC3PE | TIM_CCMR2_OC3M(PWM_MODE_1);
    TIM1->CCR1  = 0UL;
    TIM1->CCR2  = 0UL;
    TIM1->CCR3  = 0UL;
    TIM1->CCER  = OUTPUTS;
    TIM1->AF1   = TIM_AF1_BKCMP1E | TIM_AF1_BKCMP2E | TIM_AF1_BKCMP4E;
    /* Without MOE the outputs are driven low. */
    TIM1->BDTR = TIM_BDTR_DTG(pwm_dead_time(setup->dead_time_cnt)) | TIM_BDTR_LOCK(LOCK_LEVEL_1) |
                 TIM_BDTR_OSSI | TIM_BDTR_OSSR | TIM_BDTR_BKE | TIM_BDTR_BKP |
                 TIM_BDTR_BKF(BREAK_FILTER);
}

/* The update has to come at the top. The repetition counter is still 0 at the first end, which is
 * the top, and is loaded with 1 there. The control interrupt looks whether it is so. */
void pwm_start(void)
{
    TIM1->RCR = 0UL;
    TIM1->EGR = TIM_EGR_UG;
    TIM1->SR  = 0UL;
    TIM1->RCR = EVERY_SECOND;
    TIM1->CR1 |= TIM_CR1_CEN;
}

static uint32_t within(uint16_t duty_cnt)
{
    return (duty_cnt < full_cnt) ? duty_cnt : full_cnt;
}

void board_duty_write(const board_duty_t *duty)
{
    TIM1->CCR1 = within(duty->a_cnt);
    TIM1->CCR2 = within(duty->b_cnt);
    TIM1->CCR3 = within(duty->c_cnt);
}

#if BOARD_CHOPPER
#error "this board has no pin for a brake chopper"
#endif

void board_chopper_write(bool on)
{
    (void)on;
}

/* No pin is left for a holding brake either. */
void board_brake_write(bool release)
{
    (void)release;
}
