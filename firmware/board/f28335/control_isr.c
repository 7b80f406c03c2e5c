/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"

#define LATE_CYCLES (BOARD_TICK_CYCLES + (BOARD_TICK_CYCLES / 2UL)) /* a period was left out */

static void (*control_tick)(void);
static board_sample_t sample;
static uint32_t       entry_cycles;
static bool           first;

void control_isr_init(void (*tick)(void))
{
    static const board_sample_t nothing = {.valid = false};

    control_tick = tick;
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

/* With the interrupt masked for a whole period the converter would have filled the next result registers, and
 * the ones read here would be old. */
static void check_entry(void)
{
    const uint32_t now = board_cycles();
    if (!first && ((now - entry_cycles) > LATE_CYCLES)) {
        trip_latch(BOARD_FAULT_OVERRUN);
    }
    first        = false;
    entry_cycles = now;
}

__interrupt void control_isr(void)
{
    check_entry();
    trip_check();
    take_sample();
    control_tick();
    if (adc_is_done()) { /* the next period's conversion, already */
        trip_latch(BOARD_FAULT_OVERRUN);
    }
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}

board_sample_t board_sample_read(void)
{
    return sample;
}
