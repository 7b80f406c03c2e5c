/* SPDX-License-Identifier: MIT */
/* Outside the fast memory: only the background trims. */
#include "app_scale.h"

#if APP_TRIM
bool app_scale_trim(volatile app_scale_t *s, float a_A, float b_A, float gain)
{
    const app_scale_config_t *c          = s->config;
    const float               zero_a_cnt = s->zero_a_cnt + (a_A / c->current_A_per_cnt);
    const float               zero_b_cnt = s->zero_b_cnt + (b_A / c->current_A_per_cnt);

    if (!base_within(zero_a_cnt - c->current_zero_cnt, c->offset_max_cnt) ||
        !base_within(zero_b_cnt - c->current_zero_cnt, c->offset_max_cnt) ||
        !base_within(gain, 0.5f)) {
        return false;
    }
    s->zero_a_cnt  = zero_a_cnt;
    s->zero_b_cnt  = zero_b_cnt;
    s->a_A_per_cnt = c->current_A_per_cnt * (1.0f + base_max(-gain, 0.0f));
    s->b_A_per_cnt = c->current_A_per_cnt * (1.0f + base_max(gain, 0.0f));
    return true;
}
#endif
