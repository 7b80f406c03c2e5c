/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

static void (*control_tick)(void);
static board_sample_t sample;
static uint32_t       entry_cycles; /* at the last one */
static uint32_t       late_cycles;  /* 1.5 control periods: a later tick means that one was lost */
static bool           first;
static volatile bool  started;

void control_isr_init(void (*tick)(void), uint32_t period_cycles)
{
    static const board_sample_t nothing = {.valid = false};

    control_tick = tick;
    late_cycles  = period_cycles + (period_cycles / 2UL);
    sample       = nothing;
    first        = true;
    started      = true;
}

bool control_has_started(void)
{
    return started;
}

/* The update that triggered this came at the top if the counter goes down now. A sample of another
 * instant is not one of the shunts. */
static void take_sample(void)
{
    const bool converted = adc_is_done();
    const bool at_top    = (TIM1->CR1 & TIM_CR1_DIR) != 0UL;

    adc_read(&sample);
    const bool located = encoder_read(&sample);
    sample.valid       = converted && located && at_top;
}

/* Detects a lost tick: the converters would have overwritten the results. */
static void check_entry(void)
{
    const uint32_t now = board_cycles();

    if (!first && ((uint32_t)(now - entry_cycles) > late_cycles)) {
        trip_latch(BOARD_FAULT_OVERRUN);
    }
    first        = false;
    entry_cycles = now;
}

void control_isr(void)
{
    check_entry();
    tick_watch_serve();
    trip_check();
    take_sample();
    control_tick();
    if (adc_is_done()) { /* the conversion of the next period is complete */
        trip_latch(BOARD_FAULT_OVERRUN);
    }
}

const board_sample_t *board_sample(void)
{
    return &sample;
}
