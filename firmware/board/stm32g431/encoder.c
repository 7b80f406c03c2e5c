/* SPDX-License-Identifier: MIT */
/* TIM4 counts the edges. It copies its count to CCR4 at the update of TIM1: the position is that of
 * the currents, whenever the interrupt comes. Each edge that it counts makes TIM2 copy its own
 * count, of processor cycles, to CCR1. */
#include "clock_tree.h"
#include "peripherals.h"

#define BOTH_TRACKS 3U /* SMS: every edge counts */
#define OF_TIM1     0U /* TS */
#define OF_TIM4     3U
#define AS_INPUT    1U /* CCxS: its own pin */
#define AS_TRIGGER  3U /* CCxS: the trigger that TS selects */
/* Six equal samples, one every four cycles: glitches below 0.14 us vanish. */
#define FILTER 6U

/* Cycles from the read of TIM1's count to that of TIM2's. Chosen: two loads and a subtraction. */
#define READS_APART 4UL

/* Three phase errors within 10 ms trip, a single one does not. Each error adds 10 ms to a level
 * that decreases with time. */
#define PER_10_ms 100UL

static uint16_t before_cnt;   /* position of the sample before */
static uint16_t phase_errors; /* since the start */
static uint32_t error_level;  /* control periods */
static uint32_t error_step;   /* control periods in 10 ms */

void encoder_init(const board_setup_t *setup)
{
    before_cnt   = 0U;
    phase_errors = 0U;
    error_level  = 0UL;
    error_step   = (CLOCK_SYSCLK_Hz / PER_10_ms) / setup->pwm_cycles;

    TIM2->ARR   = 0xFFFFFFFFUL;
    TIM2->SMCR  = TIM_SMCR_TS(OF_TIM4);
    TIM2->CCMR1 = TIM_CCMR1_CC1S(AS_TRIGGER);
    TIM2->CCER  = TIM_CCER_CC1E;
    TIM2->CR1   = TIM_CR1_CEN;

    TIM4->ARR   = (uint32_t)setup->positions - 1UL; /* the highest position, not their number */
    TIM4->CR2   = TIM_CR2_MMS_3; /* TRGO is the edge that is counted: 8, in a field of two parts */
    TIM4->SMCR  = TIM_SMCR_SMS(BOTH_TRACKS) | TIM_SMCR_TS(OF_TIM1);
    TIM4->CCMR1 = TIM_CCMR1_CC1S(AS_INPUT) | TIM_CCMR1_IC1F(FILTER) | TIM_CCMR1_CC2S(AS_INPUT) |
                  TIM_CCMR1_IC2F(FILTER);
    TIM4->CCMR2 = TIM_CCMR2_CC3S(AS_INPUT) | TIM_CCMR2_IC3F(FILTER) | TIM_CCMR2_CC4S(AS_TRIGGER);
    TIM4->CCER  = TIM_CCER_CC3E | TIM_CCER_CC4E;
    TIM4->CR1   = TIM_CR1_CEN;
}

/* TIM2's count at the update of TIM1, which counts down from its top since. */
static uint32_t latch_cycles(void)
{
    const uint32_t since = TIM1->ARR - TIM1->CNT;

    return (TIM2->CNT - since) - READS_APART;
}

static void count_phase_errors(bool error)
{
    if (error || (error_level > 0UL)) {
        error_level -= (error_level > 0UL) ? 1UL : 0UL;
        if (error) {
            phase_errors = (uint16_t)(phase_errors + 1U);
            error_level += error_step;
        }
        if (error_level >= (2UL * error_step)) {
            error_level = 2UL * error_step;
            trip_latch(BOARD_FAULT_ENCODER);
        }
    }
}

/* The age belongs to the position if that changed in one direction, and if no edge has come since
 * the latch. */
bool encoder_read(board_sample_t *sample)
{
    const uint32_t flags = TIM4->SR;
    const uint32_t latch = latch_cycles();
    const uint32_t age   = latch - TIM2->CCR1;

    TIM4->SR = ~(flags & (TIM_SR_CC3IF | TIM_SR_CC4IF | TIM_SR_DIRF | TIM_SR_TERRF));
    count_phase_errors((flags & TIM_SR_TERRF) != 0UL);

    sample->position_cnt = (uint16_t)TIM4->CCR4;
    sample->edge_age_cnt = (uint16_t)age;
    sample->edge_seen =
        (sample->position_cnt != before_cnt) && ((flags & TIM_SR_DIRF) == 0UL) && (age <= 0xFFFFUL);
    sample->index_seen   = (flags & TIM_SR_CC3IF) != 0UL;
    sample->index_cnt    = (uint16_t)TIM4->CCR3;
    sample->phase_errors = phase_errors;
    before_cnt           = sample->position_cnt;
    return (flags & TIM_SR_CC4IF) != 0UL;
}
