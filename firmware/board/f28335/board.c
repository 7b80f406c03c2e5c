/* SPDX-License-Identifier: MIT */
#include "clock_tree.h"
#include "peripherals.h"
#include "prepare.h"

static const board_setup_t *in_force;
static bool                 clocked; /* the clock is good */

bool board_fits(const board_setup_t *s)
{
    return (s->duty_full_cnt > 0U) &&
           (s->pwm_cycles == (2UL * CLOCK_SYSCLK_PER_TBCLK * (uint32_t)s->duty_full_cnt)) &&
           (s->pwm_cycles <= CLOCK_PERIOD_MAX_cycles) && (s->dead_time_cnt > 0U) &&
           (s->dead_time_cnt <= CLOCK_DEAD_TIME_MAX_cnt) &&
           ((2UL * (uint32_t)s->dead_time_cnt) < s->duty_full_cnt) && (s->positions > 0U) &&
           ((s->current_sensors == 2U) ||
            (s->current_sensors == (uint16_t)BOARD_CURRENT_SENSORS)) &&
           (s->chopper <= (uint16_t)BOARD_CHOPPER);
}

bool board_prepare(void)
{
    gpio_make_safe();
    watchdog_stop();
    pie_init();
    clocked = clock_init();
    flash_init();
    clock_peripherals();
    trip_init();
    if (!clocked) {
        trip_latch(BOARD_FAULT_CLOCK);
    }
    return clocked;
}

bool board_init(const board_setup_t *setup)
{
    if (!clocked || !board_fits(setup)) {
        return false;
    }
    in_force = setup;
    pwm_init(setup);
    brake_init();
    gpio_connect();
    inputs_init();
#if BOARD_CHOPPER
    if (setup->chopper != 0U) {
        chopper_init(setup);
    }
#endif
    cycles_init();
    encoder_init(setup);
    adc_init(setup);
    serial_init();
    can_init();
    return true;
}

void board_start(void (*tick)(void), uint16_t updates_per_period)
{
    const uint16_t updates = (updates_per_period == 2U) ? 2U : 1U;

    const uint32_t period_cycles = in_force->pwm_cycles / updates;

    control_isr_init(tick, period_cycles);
    watchdog_start();
    encoder_start(updates);
    tick_watch_start(period_cycles);
    pwm_start(updates);
    pie_start();
}
