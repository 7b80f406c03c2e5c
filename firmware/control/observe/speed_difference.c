/* SPDX-License-Identifier: MIT */
#include "speed_difference.h"

#include "check.h"

bool speed_difference_check(const speed_difference_config_t *c, float ts_s)
{
    return (c->periods >= 1) && (c->periods <= SPEED_DIFFERENCE_PERIODS_MAX) &&
           base_in_range(c->inv_span_1ps * ts_s * (float)c->periods, 0.999f, 1.001f) &&
           check_positive(c->edge_gap_max_s) && check_positive(c->count_rad);
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
    encoder_form_edges_reset(&s->edges);
    s->pattern_e_radps = 0.0f;
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

/* The share of the speed that comes from the places of the last two edges. It is no motion. */
static float pattern_e_radps(const encoder_form_edges_t *edges)
{
    if (edges->known < 2U) {
        return 0.0f;
    }
    const float now_rad    = edges->offset_rad[encoder_form_place(edges->place[0])];
    const float before_rad = edges->offset_rad[encoder_form_place(edges->place[1])];
    return (now_rad - before_rad) * edges->per_gap_1ps;
}

/* EQ-SPEED-DIFFERENCE-2. A sample without an edge has the last two edges' speed and error. */
static float between_edges(speed_difference_t *s, const speed_difference_config_t *c,
                           const drive_sample_t *sample, float ts_s)
{
    if (sample->edge_gap_s > 0.0f) {
        (void)encoder_form_learn(&s->edges, sample, c->count_rad, ts_s);
        if (sample->edge_age_s > 0.0f) {
            s->pattern_e_radps = pattern_e_radps(&s->edges);
        }
    }
    return sample->omega_e_radps - s->pattern_e_radps;
}

speed_difference_mode_t speed_difference_update(speed_difference_t              *s,
                                                const speed_difference_config_t *c,
                                                const drive_sample_t *sample, float ts_s,
                                                float *omega_e_radps)
{
    const float counted = difference(s, c, sample->theta_e_rad);
    const float between = between_edges(s, c, sample, ts_s);
    const bool  timed   = (sample->edge_gap_s > 0.0f) && (sample->edge_gap_s <= c->edge_gap_max_s);

    *omega_e_radps = timed ? between : counted;
    return timed ? SPEED_DIFFERENCE_TIMED : SPEED_DIFFERENCE_COUNTED;
}
