/* SPDX-License-Identifier: MIT */
#include "app_scale.h"

void app_scale_temperature(const app_scale_t *s, const board_sample_t *raw, app_scale_sample_t *out)
{
    const app_scale_config_t *c        = s->config;
    const uint16_t            code_cnt = raw->temperature_cnt;
    float                     degC     = 0.0f;
    bool                      valid    = false;

    if (out->valid && (code_cnt >= c->ntc_first_cnt)) {
        const uint16_t from_cnt = (uint16_t)(code_cnt - c->ntc_first_cnt);
        /* The quotient is at least half a code from an integer: rounding cannot change its integer
         * part. */
        const uint16_t point = (uint16_t)(((float)from_cnt + 0.5f) * s->inv_ntc_step);

        valid = (uint16_t)(point + 1U) < c->ntc_points; /* there is a next point */
        if (valid) {
            const uint16_t past_cnt = (uint16_t)(from_cnt - (uint16_t)(point * c->ntc_step_cnt));
            const float    share    = (float)past_cnt * s->inv_ntc_step;
            const float    here     = c->ntc_degC[point];

            degC = here + (share * (c->ntc_degC[point + 1U] - here));
        }
    }
    out->temperature_degC  = degC;
    out->temperature_valid = valid;
}
