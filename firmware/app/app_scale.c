/* SPDX-License-Identifier: MIT */
#include "app_scale.h"

#include <math.h>
#include <stddef.h>

static bool ntc_ok(const app_scale_config_t *c)
{
    if ((c->ntc_degC == NULL) || (c->ntc_points < 2U) || (c->ntc_step_cnt == 0U)) {
        return false;
    }
    const uint32_t last_cnt =
        (uint32_t)c->ntc_first_cnt + ((uint32_t)c->ntc_step_cnt * ((uint32_t)c->ntc_points - 1U));
    if (last_cnt >= BOARD_ADC_CODES) {
        return false;
    }
    for (uint16_t i = 0U; i < c->ntc_points; i++) {
        if (!base_in_range(c->ntc_degC[i], -100.0f, 300.0f) ||
            ((i > 0U) && !(c->ntc_degC[i] < c->ntc_degC[i - 1U]))) {
            return false;
        }
    }
    return true;
}

ctl_status_t app_scale_check(const app_scale_config_t *c, float trip_current_A)
{
    const float top_cnt    = (float)(BOARD_ADC_CODES - 1U);
    const bool  current_ok = base_in_range(c->current_A_per_cnt, 1.0e-6f, 1.0e3f) &&
                            base_in_range(c->current_zero_cnt, 0.0f, top_cnt) &&
                            base_in_range(c->offset_max_cnt, 1.0e-3f, top_cnt);
    const float room_cnt =
        fminf(c->current_zero_cnt, top_cnt - c->current_zero_cnt) - c->offset_max_cnt;
    const bool ok = current_ok && ((room_cnt * c->current_A_per_cnt) > trip_current_A) &&
                    base_in_range(c->dc_link_V_per_cnt, 1.0e-6f, 1.0e3f) && ntc_ok(c);

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

ctl_status_t app_scale_init(app_scale_t *s, const app_scale_config_t *c, uint16_t positions,
                            float trip_current_A)
{
    const ctl_status_t status = app_scale_check(c, trip_current_A);

    s->config     = c;
    s->zero_a_cnt = c->current_zero_cnt;
    s->zero_b_cnt = c->current_zero_cnt;
#if APP_TRIM
    s->a_A_per_cnt = c->current_A_per_cnt;
    s->b_A_per_cnt = c->current_A_per_cnt;
#endif
    s->dc_link_V_per_cnt = c->dc_link_V_per_cnt;
    s->positions         = positions;
    s->inv_ntc_step      = (status == CTL_OK) ? (1.0f / (float)c->ntc_step_cnt) : 0.0f;
    return status;
}

static bool zero_ok(const app_scale_config_t *c, float zero_cnt)
{
    return base_in_range(zero_cnt - c->current_zero_cnt, -c->offset_max_cnt, c->offset_max_cnt);
}

bool app_scale_set_zero(app_scale_t *s, uint32_t sum_a_cnt, uint32_t sum_b_cnt, uint16_t count)
{
    if (count == 0U) {
        return false;
    }
    const float zero_a_cnt = (float)sum_a_cnt / (float)count;
    const float zero_b_cnt = (float)sum_b_cnt / (float)count;
    if (!zero_ok(s->config, zero_a_cnt) || !zero_ok(s->config, zero_b_cnt)) {
        return false;
    }
    s->zero_a_cnt = zero_a_cnt;
    s->zero_b_cnt = zero_b_cnt;
    return true;
}

#if (BOARD_ADC_CODES & (BOARD_ADC_CODES - 1U)) != 0U
#error "raw_ok() needs a power of two"
#endif

/* Codes in range set no bit above those of the converter: one comparison for all four. */
static bool raw_ok(const app_scale_t *s, const board_sample_t *raw)
{
    const uint16_t codes_cnt =
        (uint16_t)(raw->ia_cnt | raw->ib_cnt | raw->dc_link_cnt | raw->temperature_cnt);

    return raw->valid && (codes_cnt < BOARD_ADC_CODES) && (raw->position_cnt < s->positions) &&
           (!raw->index_seen || (raw->index_cnt < s->positions));
}

APP_MEASURE_PART void app_scale_sample(const app_scale_t *s, const board_sample_t *raw,
                                       app_scale_sample_t *out)
{
    out->valid = raw_ok(s, raw);
    if (!out->valid) {
        out->ia_A      = 0.0f;
        out->ib_A      = 0.0f;
        out->dc_link_V = 0.0f;
        return;
    }
#if APP_TRIM
    const float a_A_per_cnt = s->a_A_per_cnt;
    const float b_A_per_cnt = s->b_A_per_cnt;
#else
    const float a_A_per_cnt = s->config->current_A_per_cnt;
    const float b_A_per_cnt = a_A_per_cnt;
#endif
    out->ia_A      = a_A_per_cnt * ((float)raw->ia_cnt - s->zero_a_cnt);
    out->ib_A      = b_A_per_cnt * ((float)raw->ib_cnt - s->zero_b_cnt);
    out->dc_link_V = s->dc_link_V_per_cnt * (float)raw->dc_link_cnt;
}
