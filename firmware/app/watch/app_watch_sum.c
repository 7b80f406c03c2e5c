/* SPDX-License-Identifier: MIT */
#include "app_watch_sum.h"

#if BOARD_CURRENT_SENSORS == 3

#define MOST_cnt (0.04f * (float)BOARD_ADC_CODES)
#define SAMPLES  3U /* chosen: one wrong sample is the gate's (current_gate.h), two may be noise */

static uint16_t sum_of(const board_sample_t *raw)
{
    return (uint16_t)(raw->ia_cnt + raw->ib_cnt + raw->ic_cnt);
}

void app_watch_sum_init(app_watch_sum_t *w, uint16_t sensors)
{
    const app_watch_sum_t start = {.zero_cnt = 0.0f, .on = (sensors == 3U)};

    *w = start;
}

void app_watch_sum_begin(app_watch_sum_t *w)
{
    w->sum_cnt = 0UL;
    w->beyond  = 0U;
}

void app_watch_sum_add(app_watch_sum_t *w, const board_sample_t *raw)
{
    w->sum_cnt += sum_of(raw);
}

bool app_watch_sum_set_zero(app_watch_sum_t *w, uint16_t count, float nominal_cnt, float most_cnt)
{
    bool good = !w->on;

    if (w->on && (count > 0U)) {
        w->zero_cnt = (float)w->sum_cnt / (float)count;
        good        = base_within(w->zero_cnt - (3.0f * nominal_cnt), 3.0f * most_cnt);
    }
    return good;
}

bool app_watch_sum_differs(app_watch_sum_t *w, const board_sample_t *raw)
{
    if (!w->on || base_within((float)sum_of(raw) - w->zero_cnt, MOST_cnt)) {
        w->beyond = 0U;
    } else if (w->beyond < SAMPLES) {
        w->beyond = (uint16_t)(w->beyond + 1U);
    } else {
        /* stays */
    }
    return w->beyond >= SAMPLES;
}

#endif
