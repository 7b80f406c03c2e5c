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

/* A pulse of this length, or the nearest that is not too short. */
static uint16_t passed(uint16_t pulse_cnt, uint16_t min_cnt)
{
    if (pulse_cnt >= min_cnt) {
        return pulse_cnt;
    }
    return ((2U * pulse_cnt) < min_cnt) ? 0U : min_cnt;
}

static uint16_t compare_cnt(const app_gate_config_t *c, uint16_t full_cnt, float duty)
{
    const uint16_t wanted_cnt = (uint16_t)((duty * (float)full_cnt) + 0.5f);
    const uint16_t upper_cnt  = passed(wanted_cnt, c->pulse_min_cnt);
    const uint16_t lower_cnt  = passed((uint16_t)(full_cnt - upper_cnt), c->pulse_min_cnt);
    const uint16_t out_cnt    = (uint16_t)(full_cnt - lower_cnt);

    return (out_cnt < c->duty_max_cnt) ? out_cnt : c->duty_max_cnt;
}

board_duty_t app_gate_duty(const app_gate_config_t *c, uint16_t full_cnt, abc_t duty)
{
    const board_duty_t out = {.a_cnt = compare_cnt(c, full_cnt, duty.a),
                              .b_cnt = compare_cnt(c, full_cnt, duty.b),
                              .c_cnt = compare_cnt(c, full_cnt, duty.c)};
    return out;
}

bool app_gate_may_start(const app_gate_config_t *c, float omega_e_radps)
{
    return (c->precharge_ticks == 0U) || base_within(omega_e_radps, c->precharge_speed_e_radps);
}
