/* SPDX-License-Identifier: MIT */
#include "app_align.h"

#include "board.h"
#include "dead_time.h"
#include "frames.h"
#include "svpwm.h"

/* Chosen: share of I that the current may be off while the shaft rests. The run begins with the
 * measured current as its state: a sensor that moved in the last ticks must not be taken over. */
#define OFF_SHARE 0.25f

ctl_status_t app_align_check(const app_align_config_t *c, const drive_config_t *drive)
{
    const bool times_ok = (c->watch_ticks > 0UL) && (c->ramp_ticks > 0UL) &&
                          (c->sweep_ticks > 0UL) && (c->still_ticks > 0UL) &&
                          (c->settle_ticks > c->still_ticks);
    const bool ok = times_ok && (drive->hardware.pole_pairs > 0U) &&
                    (drive->hardware.encoder_positions <= UINT16_MAX) &&
                    base_in_range(c->current_A, 1.0e-3f, 0.5f * drive->current_max_A) &&
                    base_in_range(c->bandwidth_radps * drive->ts_s, 1.0e-4f, 0.1f) &&
                    base_in_range(c->theta_e_rad, 0.0f, BASE_TWO_PI);

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

ctl_status_t app_align_init(app_align_t *a, const app_align_config_t *c,
                            const drive_config_t *drive)
{
    const ctl_status_t status     = app_align_check(c, drive);
    const bool         ok         = status == CTL_OK;
    const uint16_t     pole_pairs = drive->hardware.pole_pairs;
    const uint32_t     positions  = drive->hardware.encoder_positions;
    const float        rs_Ohm     = drive->motor.l7 * drive->motor.inv_l8;

    a->config          = c;
    a->positions       = (uint16_t)positions;
    a->kp_VpA          = c->bandwidth_radps * drive->motor.inv_l8;
    a->ki_VpA          = c->bandwidth_radps * rs_Ohm * drive->ts_s;
    a->v_max_V         = 2.0f * rs_Ohm * c->current_A;
    a->current_max2_A2 = drive->current_max_A * drive->current_max_A;

    a->current_per_tick_A = ok ? (c->current_A / (float)c->ramp_ticks) : 0.0f;
    a->angle_per_tick_rad = ok ? (BASE_PI / (float)c->sweep_ticks) : 0.0f;
    a->quarter_cnt        = (int16_t)(ok ? (positions / (4UL * (uint32_t)pole_pairs)) : 0UL);
    app_align_start(a, 0U);
    return status;
}

static void enter(app_align_t *a, app_align_stage_t stage, uint16_t position_cnt)
{
    a->stage       = stage;
    a->timer_ticks = 0UL;
    a->marked_cnt  = position_cnt;
}

void app_align_start(app_align_t *a, uint16_t position_cnt)
{
    enter(a, APP_ALIGN_WATCH, position_cnt);
    a->integral_V = 0.0f;
    a->middle_cnt = position_cnt;
}

static bool within(int32_t x, uint16_t limit)
{
    const int32_t most = (int32_t)limit;
    return (x <= most) && (x >= -most);
}

static bool stands(const app_align_t *a, uint16_t position_cnt)
{
    return within(app_angle_turned_cnt(a->positions, a->marked_cnt, position_cnt),
                  a->config->still_cnt);
}

static bool turned_a_quarter(const app_align_t *a, uint16_t position_cnt)
{
    const int32_t turned_cnt = app_angle_turned_cnt(a->positions, a->middle_cnt, position_cnt);
    return within(turned_cnt - a->quarter_cnt, a->config->quarter_error_cnt);
}

static void watch(app_align_t *a, uint16_t position_cnt)
{
    if (!stands(a, position_cnt)) {
        a->stage = APP_ALIGN_FAILED;
    } else if (a->timer_ticks >= a->config->watch_ticks) {
        enter(a, APP_ALIGN_RAMP, position_cnt);
    }
}

static void sweep(app_align_t *a, uint16_t position_cnt)
{
    if (a->timer_ticks == (a->config->sweep_ticks / 2UL)) {
        a->middle_cnt = position_cnt;
    }
    if (a->timer_ticks >= a->config->sweep_ticks) {
        enter(a, APP_ALIGN_SETTLE, position_cnt);
    }
}

/* True in the end of settle, when shaft and current rest. */
static bool is_resting(const app_align_t *a)
{
    return (a->stage == APP_ALIGN_DONE) ||
           ((a->stage == APP_ALIGN_SETTLE) &&
            (a->timer_ticks > (a->config->settle_ticks - a->config->still_ticks)));
}

static bool is_off(const app_align_t *a, dq_t i_A)
{
    const float most_A = OFF_SHARE * a->config->current_A;
    return !base_within(i_A.d - a->config->current_A, most_A) || !base_within(i_A.q, most_A);
}

static void settle(app_align_t *a, uint16_t position_cnt)
{
    if (!is_resting(a)) {
        a->marked_cnt = position_cnt;
    } else if (!stands(a, position_cnt)) {
        a->stage = APP_ALIGN_FAILED;
    } else if (a->timer_ticks >= a->config->settle_ticks) {
        a->stage = turned_a_quarter(a, position_cnt) ? APP_ALIGN_DONE : APP_ALIGN_FAILED;
    }
}

static void advance(app_align_t *a, uint16_t position_cnt)
{
    a->timer_ticks = a->timer_ticks + 1UL;
    switch (a->stage) {
    case APP_ALIGN_WATCH:
        watch(a, position_cnt);
        break;
    case APP_ALIGN_RAMP:
        if (a->timer_ticks >= a->config->ramp_ticks) {
            enter(a, APP_ALIGN_SWEEP, position_cnt);
        }
        break;
    case APP_ALIGN_SWEEP:
        sweep(a, position_cnt);
        break;
    case APP_ALIGN_SETTLE:
        settle(a, position_cnt);
        break;
    case APP_ALIGN_DONE:
    case APP_ALIGN_FAILED:
    default:
        break;
    }
}

static float vector_angle_rad(const app_align_t *a)
{
    if (a->stage == APP_ALIGN_RAMP) {
        return -BASE_PI;
    }
    return (a->stage == APP_ALIGN_SWEEP)
               ? (-BASE_PI + (a->angle_per_tick_rad * (float)a->timer_ticks))
               : 0.0f;
}

static abc_t drive_current(app_align_t *a, const dead_time_config_t *dead_time, dq_t i_A,
                           frames_angle_t angle, float dc_link_V)
{
    const float ref_A   = (a->stage == APP_ALIGN_RAMP)
                              ? (a->current_per_tick_A * (float)a->timer_ticks)
                              : a->config->current_A;
    const float error_A = ref_A - i_A.d;

    a->integral_V = /* EQ-APP-ALIGN-1 */
        base_clamp(a->integral_V + (a->ki_VpA * error_A), -a->v_max_V, a->v_max_V);
    const dq_t v_V = {
        .d = base_clamp((a->kp_VpA * error_A) + a->integral_V, -a->v_max_V, a->v_max_V),
        .q = base_clamp(-a->kp_VpA * i_A.q, -a->v_max_V, a->v_max_V)};
    const dq_t  wanted_A = {.d = ref_A, .q = 0.0f};
    const abc_t phases_A = frames_inverse_clarke(frames_inverse_park(wanted_A, angle));
    return dead_time_compensate(dead_time, svpwm_duty(frames_inverse_park(v_V, angle), dc_link_V),
                                phases_A);
}

bridge_t app_align_tick(app_align_t *a, const dead_time_config_t *dead_time, float ia_A, float ib_A,
                        float dc_link_V, uint16_t position_cnt)
{
    advance(a, position_cnt);

    const frames_angle_t angle = frames_angle(vector_angle_rad(a));
    const dq_t           i_A   = frames_park(frames_clarke(ia_A, ib_A), angle);
    if (!base_in_range((i_A.d * i_A.d) + (i_A.q * i_A.q), 0.0f, a->current_max2_A2) ||
        (is_resting(a) && is_off(a, i_A))) {
        a->stage = APP_ALIGN_FAILED;
    }
    if ((a->stage == APP_ALIGN_WATCH) || (a->stage == APP_ALIGN_FAILED)) {
        return bridge_open();
    }
    return bridge_closed(drive_current(a, dead_time, i_A, angle, dc_link_V));
}
