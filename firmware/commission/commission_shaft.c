/* SPDX-License-Identifier: MIT */
#include "commission_shaft.h"

/* Speeds are counted over SPEED_s. One step may be a multiple of the speed limit plus a few
 * counts. */
#define SPEED_s    0.001f
#define STEP_RATIO 3.0f
#define STEP_CNT   6.0f

void commission_shaft_start(commission_shaft_t *w, int32_t position_cnt)
{
    w->position_cnt = position_cnt;
    w->speed_cnt    = position_cnt;
    w->speed_ticks  = 0L;
}

/* Largest plausible movement of the position in a time. */
static float most_cnt(const commission_config_t *c, int32_t counts_per_turn, float time_s)
{
    return c->speed_max_m_radps * time_s * (float)counts_per_turn / BASE_TWO_PI;
}

commission_shaft_judgement_t commission_shaft_judge(commission_shaft_t        *w,
                                                    const commission_config_t *c,
                                                    int32_t counts_per_turn, int32_t position_cnt)
{
    if (counts_per_turn == 0L) {
        commission_shaft_start(w, position_cnt);
        return COMMISSION_SHAFT_OK;
    }
    const float step = (float)commission_moved_cnt(position_cnt, w->position_cnt);
    w->position_cnt  = position_cnt;
    if (!base_within(step, (STEP_RATIO * most_cnt(c, counts_per_turn, c->ts_s)) + STEP_CNT)) {
        return COMMISSION_SHAFT_JUMP;
    }
    w->speed_ticks++;
    const float time_s = (float)w->speed_ticks * c->ts_s;
    const float way    = (float)commission_moved_cnt(position_cnt, w->speed_cnt);
    if (!base_within(way, most_cnt(c, counts_per_turn, time_s) + STEP_CNT)) {
        return COMMISSION_SHAFT_FAST;
    }
    if (time_s >= SPEED_s) {
        w->speed_cnt   = position_cnt;
        w->speed_ticks = 0L;
    }
    return COMMISSION_SHAFT_OK;
}
