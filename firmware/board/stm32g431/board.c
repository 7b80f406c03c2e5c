/* SPDX-License-Identifier: MIT */
#include "clock_tree.h"
#include "peripherals.h"
#include "prepare.h"

static const board_setup_t *in_force;
static bool                 clocked; /* the clock is good */

bool board_fits(const board_setup_t *s)
{
    return (s->duty_full_cnt > 0U) && (s->pwm_cycles == (2UL * (uint32_t)s->duty_full_cnt)) &&
           (s->pwm_cycles <= CLOCK_PERIOD_MAX_cycles) && (pwm_dead_time(s->dead_time_cnt) != 0UL) &&
           ((2UL * (uint32_t)s->dead_time_cnt) < s->duty_full_cnt) && (s->positions > 0U) &&
           ((s->current_sensors == 2U) ||
            (s->current_sensors == (uint16_t)BOARD_CURRENT_SENSORS)) &&
           (s->chopper == 0U);
}

bool board_prepare(void)
{
    watchdog_init();
    clocked = clock_init();
    clock_peripherals();
    cycles_init();
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
    analog_init();
    pwm_init(setup);
    gpio_connect();
    encoder_init(setup);
    adc_init();
    serial_init();
    can_init();
    return true;
}

void board_start(void (*tick)(void), uint16_t updates_per_period)
{
    const uint32_t period_cycles = in_force->pwm_cycles;

    (void)updates_per_period; /* one: app_init() refuses others */
    control_isr_init(tick, period_cycles);
    watchdog_start();
    tick_watch_start(period_cycles);
    core_enable(IRQ_ADC1_2, CORE_PRIORITY(LEVEL_CONTROL));
    adc_start();
    pwm_start();
}
