/* SPDX-License-Identifier: MIT */
#include "app_config_check.h"

#include "app_slow.h"

/* Tolerance between two single-precision copies of one number. */
#define SAME_RATIO 1.0e-4f

#define ADDRESS_MAX 247U /* by the protocol of Modbus */

/* Chosen: above a day at 10 kHz; twice of it is a count of 32 bits. */
#define TICKS_MOST 1000000000UL

static bool same(float x, float y)
{
    return base_in_range(x, y * (1.0f - SAME_RATIO), y * (1.0f + SAME_RATIO));
}

static bool drive_fits(const app_config_t *c, const drive_config_t *d)
{
    const drive_hardware_t *h       = &d->hardware;
    const float             top_cnt = (float)(BOARD_ADC_CODES - 1U);

    return (h->updates_per_period >= 1U) && (h->updates_per_period <= BOARD_UPDATES_MAX) &&
           same(d->ts_s * (float)h->updates_per_period, c->pwm_period_s) &&
           (h->encoder_positions == c->board.positions) && same(h->dead_time_s, c->dead_time_s) &&
           (d->dc_link_max_V <= (top_cnt * c->scale.dc_link_V_per_cnt));
}

static bool values_ok(const app_config_t *c)
{
    return base_in_range(c->temperature_trip_degC, -100.0f, 300.0f) &&
           base_in_range(c->temperature_limit_degC, -100.0f, c->temperature_trip_degC) &&
           ((c->board.current_sensors == 2U) ||
            (c->board.current_sensors == (uint16_t)BOARD_CURRENT_SENSORS)) &&
           (c->board.chopper <= (uint16_t)BOARD_CHOPPER) && (c->calibrate_ticks > 0U) &&
           (c->background_ticks > 0U) && base_in_range(c->zero_drift_A, 1.0e-6f, 1.0e6f);
}

static bool line_ok(const app_config_t *c)
{
    return (c->modbus_address >= 1U) && (c->modbus_address <= ADDRESS_MAX) &&
           (c->modbus_gap_ticks > 0U) && (c->modbus_timeout_ticks > 0U);
}

/* app_config_for() may double these times. */
static bool times_ok(const app_align_config_t *c)
{
    return (c->watch_ticks <= TICKS_MOST) && (c->ramp_ticks <= TICKS_MOST) &&
           (c->sweep_ticks <= TICKS_MOST) && (c->settle_ticks <= TICKS_MOST) &&
           (c->still_ticks <= TICKS_MOST);
}

static bool parts_ok(const app_config_t *c, const drive_config_t *d)
{
    return (app_scale_check(&c->scale, d->trip_current_A) == CTL_OK) &&
           (app_angle_check(&c->angle, d) == CTL_OK) && (app_align_check(&c->align, d) == CTL_OK) &&
           (app_gate_check(&c->gate, c->board.duty_full_cnt) == CTL_OK) &&
           (app_stop_check(&c->stop, d) == CTL_OK) &&
           (app_watch_heat_check(&c->heat, d->current_max_A, app_slow_s(d->ts_s)) == CTL_OK) &&
           (app_chopper_check(&c->chopper, c->board.chopper != 0U, c->scale.dc_link_V_per_cnt,
                              d->dc_link_max_V, app_slow_s(d->ts_s)) == CTL_OK);
}

ctl_status_t app_config_check(const app_config_t *config, const drive_config_t *drive)
{
    const bool ok = (drive_config_check(drive) == CTL_OK) && parts_ok(config, drive) &&
                    drive_fits(config, drive) && values_ok(config) && line_ok(config) &&
                    times_ok(&config->align);

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}
