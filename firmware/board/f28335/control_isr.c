/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"

static void (*control_tick)(void);
static board_sample_t sample;
static uint32_t       entry_left;  /* cycles_left() at the last one */
static uint32_t       late_cycles; /* 1.5 control periods: a later tick means that one was lost */
static bool           first;

void control_isr_init(void (*tick)(void), uint32_t period_cycles)
{
    static const board_sample_t nothing = {.valid = false};

    control_tick = tick;
    late_cycles  = period_cycles + (period_cycles / 2UL);
    sample       = nothing;
    first        = true;
}

static void take_sample(void)
{
    const bool converted = adc_is_done();
    adc_rewind();
    adc_read(&sample);
    const bool located = encoder_read(&sample);
    sample.valid       = converted && located;
}

/* Detects a lost tick. If the interrupt was masked for a whole period, the converter has already
 * filled the next result registers and the ones read here are old. */
static void check_entry(void)
{
    const uint32_t left = cycles_left();
    if (!first && ((entry_left - left) > late_cycles)) {
        trip_latch(BOARD_FAULT_OVERRUN);
    }
    first      = false;
    entry_left = left;
}

__interrupt void control_isr(void)
{
    check_entry();
    tick_watch_serve();
    trip_check();
    take_sample();
    line_release();
    EINT; /* for tick_watch.c only: the processor has cleared this interrupt's IER bit */
    control_tick();
    DINT;
    if (adc_is_done()) { /* the conversion of the next period is complete */
        trip_latch(BOARD_FAULT_OVERRUN);
    }
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}

const board_sample_t *board_sample(void)
{
    return &sample;
}
