/* SPDX-License-Identifier: MIT */
#include "speed_difference.h"

#include "check.h"

bool speed_difference_check(const speed_difference_config_t *c, float ts_s)
{
    return (c->periods >= 1) && (c->periods <= SPEED_DIFFERENCE_PERIODS_MAX) &&
           base_in_range(c->inv_span_1ps * ts_s * (float)c->periods, 0.999f, 1.001f) &&
           check_positive(c->edge_gap_max_s);
}

void speed_difference_reset(speed_difference_t *s, const speed_difference_config_t *c,
                            const drive_sample_t *sample, float ts_s)
{
    const float step_rad = ts_s * sample->omega_e_radps;
    float       theta    = frames_wrap(sample->theta_e_rad);

    for (int16_t i = c->periods; i > 0; i--) { /* the first one is the oldest */
        theta               = frames_wrap(theta - step_rad);
        s->theta_rad[i - 1] = theta;
    }
    s->oldest = 0;
}

/* EQ-SPEED-DIFFERENCE-1 */
static float difference(speed_difference_t *s, const speed_difference_config_t *c,
                        float theta_e_rad)
{
    if ((s->oldest < 0) || (s->oldest >= c->periods)) {
        s->oldest = 0; /* a flipped bit: back to a valid index */
    }
    const float now_rad   = frames_wrap(theta_e_rad);
    const float moved_rad = frames_wrap(now_rad - s->theta_rad[s->oldest]);

    s->theta_rad[s->oldest] = now_rad;
    s->oldest               = ((s->oldest + 1) < c->periods) ? (int16_t)(s->oldest + 1) : 0;
    return moved_rad * c->inv_span_1ps;
}

speed_difference_mode_t speed_difference_update(speed_difference_t              *s,
                                                const speed_difference_config_t *c,
                                                const drive_sample_t *sample, float *omega_e_radps)
{
    const float counted = difference(s, c, sample->theta_e_rad);
    const bool  timed   = (sample->edge_gap_s > 0.0f) && (sample->edge_gap_s <= c->edge_gap_max_s);

    *omega_e_radps = timed ? sample->omega_e_radps : counted;
    return timed ? SPEED_DIFFERENCE_TIMED : SPEED_DIFFERENCE_COUNTED;
}
