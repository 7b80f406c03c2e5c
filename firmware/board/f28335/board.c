/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

bool board_init(void)
{
    gpio_make_safe();
    watchdog_stop();
    pie_init();

    const bool clocked = clock_init();
    flash_init();
    clock_peripherals();
    trip_init();
    if (!clocked) {
        trip_latch(BOARD_FAULT_CLOCK);
        return false;
    }

    pwm_init();
    gpio_connect();
    cycles_init();
    encoder_init();
    adc_init();
    serial_init();
    return true;
}

void board_start(void (*tick)(void), uint16_t updates_per_period)
{
    const uint16_t updates = (updates_per_period == 2U) ? 2U : 1U;

    control_isr_init(tick, updates);
    watchdog_start();
    encoder_start(updates);
    tick_watch_start(updates);
    pwm_start(updates);
    pie_start();
}
