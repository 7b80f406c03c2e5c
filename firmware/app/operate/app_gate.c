/* SPDX-License-Identifier: MIT */
#include "app_gate.h"

#include "check.h"

ctl_status_t app_gate_check(const app_gate_config_t *c, uint16_t full_cnt)
{
    const bool ok = (full_cnt > 0U) && (c->duty_max_cnt >= (full_cnt / 2U)) &&
                    (c->duty_max_cnt <= full_cnt) && (c->pulse_min_cnt <= (full_cnt / 4U)) &&
                    ((c->precharge_ticks == 0U) || check_positive(c->precharge_speed_e_radps));

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

/* Nearest allowed pulse length: 0, or min_cnt and more. */
static uint16_t passed(uint16_t pulse_cnt, uint16_t min_cnt)
{
    if (pulse_cnt >= min_cnt) {
        return pulse_cnt;
    }
    return ((2U * pulse_cnt) < min_cnt) ? 0U : min_cnt;
}

/* Nearest duty for which the pulses of both switches are allowed. */
static uint16_t passed_both(uint16_t wanted_cnt, uint16_t full_cnt, uint16_t min_cnt)
{
    const uint16_t upper_cnt = passed(wanted_cnt, min_cnt);

    return (uint16_t)(full_cnt - passed((uint16_t)(full_cnt - upper_cnt), min_cnt));
}

static uint16_t nearest(float x)
{
    return (uint16_t)(x + 0.5f);
}

static uint16_t least(uint16_t x, uint16_t y)
{
    return (x < y) ? x : y;
}

APP_PART board_duty_t app_gate_duty(const app_gate_config_t *c, uint16_t full_cnt, abc_t duty)
{
    const float    full    = (float)full_cnt;
    const uint16_t min_cnt = c->pulse_min_cnt;
    uint16_t       a_cnt   = nearest(duty.a * full);
    uint16_t       b_cnt   = nearest(duty.b * full);
    uint16_t       c_cnt   = nearest(duty.c * full);

    if (min_cnt > 0U) {
        a_cnt = passed_both(a_cnt, full_cnt, min_cnt);
        b_cnt = passed_both(b_cnt, full_cnt, min_cnt);
        c_cnt = passed_both(c_cnt, full_cnt, min_cnt);
    }
    const board_duty_t out = {.a_cnt = least(a_cnt, c->duty_max_cnt),
                              .b_cnt = least(b_cnt, c->duty_max_cnt),
                              .c_cnt = least(c_cnt, c->duty_max_cnt)};
    return out;
}

bool app_gate_may_start(const app_gate_config_t *c, float omega_e_radps)
{
    return (c->precharge_ticks == 0U) || base_within(omega_e_radps, c->precharge_speed_e_radps);
}
