/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "app_disc.h"

#if APP_DISC_MAP
/* Chosen: a good map leaves a fifth of the errors, another disc's map has 1.4 times as many.
 * Between the two, shaft and load hide the disc, and the comparison begins again. */
#define IS_BETTER 0.75f
#define IS_WORSE  1.1f
/* Chosen: over more than an edge in four periods of 200 us the speed is not constant. */
#define BETWEEN_MAX_s 0.8e-3f

static void begin(app_disc_t *d)
{
    d->plain_cnt  = 0.0f;
    d->mapped_cnt = 0.0f;
    d->compared   = 0U;
}

static void begin_again(app_disc_t *d, app_disc_state_t state)
{
    d->state     = (d->octets == NULL) ? APP_DISC_NONE : state;
    d->have_edge = false; /* so the next edge ends have_speed */
    begin(d);
}

bool app_disc_check(const uint16_t *words, uint32_t count, uint32_t positions)
{
    return (count == (APP_DISC_HEAD_WORDS + ((positions + 1UL) / 2UL))) &&
           (words[0] == APP_DISC_FORMAT) && ((uint32_t)words[1] == positions);
}

void app_disc_init(app_disc_t *d, uint16_t positions)
{
    d->octets       = NULL;
    d->positions    = positions;
    d->zero_cnt     = 0U;
    d->have_zero    = false;
    d->have_speed   = false;
    d->off_cnt      = 0.0f;
    d->plain_cntps  = 0.0f;
    d->mapped_cntps = 0.0f;
    begin_again(d, APP_DISC_NONE);
}

void app_disc_take(app_disc_t *d, const uint16_t *words)
{
    d->octets = (words == NULL) ? NULL : &words[APP_DISC_HEAD_WORDS];
    begin_again(d, APP_DISC_NO_INDEX);
}

void app_disc_index(app_disc_t *d, uint16_t index_cnt)
{
    if (!d->have_zero || (index_cnt != d->zero_cnt)) {
        d->zero_cnt  = index_cnt;
        d->have_zero = index_cnt < d->positions;
        begin_again(d, d->have_zero ? APP_DISC_COMPARES : APP_DISC_NO_INDEX);
    }
}

void app_disc_lose(app_disc_t *d)
{
    d->have_zero = false;
    begin_again(d, APP_DISC_NO_INDEX);
}

static app_disc_state_t verdict(const app_disc_t *d)
{
    app_disc_state_t state = APP_DISC_COMPARES;

    if (d->mapped_cnt < (IS_BETTER * d->plain_cnt)) {
        state = APP_DISC_IN_FORCE;
    } else if (d->mapped_cnt > (IS_WORSE * d->plain_cnt)) {
        state = APP_DISC_OTHER;
    } else {
        /* not decided */
    }
    return state;
}

void app_disc_compare(app_disc_t *d, float turned_cnt, float mapped_cnt, float between_s)
{
    const float per_s = 1.0f / between_s;

    if (d->have_speed && (between_s < BETWEEN_MAX_s)) {
        d->plain_cnt += fabsf(turned_cnt - (d->plain_cntps * between_s));
        d->mapped_cnt += fabsf(mapped_cnt - (d->mapped_cntps * between_s));
        d->compared = (uint16_t)(d->compared + 1U);
    }
    d->have_speed   = true;
    d->plain_cntps  = turned_cnt * per_s;
    d->mapped_cntps = mapped_cnt * per_s;
    if (d->compared >= APP_DISC_COMPARED) {
        d->state = verdict(d);
        begin(d);
    }
}
#endif
