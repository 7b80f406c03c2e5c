/* SPDX-License-Identifier: MIT */
#include "app_watch_inertia.h"

#define BLOCK_s      0.01f   /* chosen: a load of 100 Hz averages out */
#define BLOCK_MOST_s 0.0125f /* chosen: the background is late beyond */
#define MOVES        0.002f  /* chosen: 1.5 rad/s of the shipped drive, far above its noise */
#define LEAST        0.05f   /* chosen: of the largest speed */
#define BLOCKS_MOST  100U    /* chosen: 1 s; over a longer change the load is another one */
#define SURE         0.2f    /* chosen: five times the motor's own inertia is then known to 1 */
#define SHARE        0.75f   /* chosen: two changes leave a sixteenth of a wrong ratio */

void app_watch_inertia_reset(app_watch_inertia_t *w, float ratio)
{
    const app_watch_inertia_t nothing = {
        .believed = 1.0f,
        .ratio    = base_clamp(ratio, APP_WATCH_INERTIA_LEAST, APP_WATCH_INERTIA_MOST)};

    *w = nothing;
}

/* The next block begins. */
static void begin_block(app_watch_inertia_t *w, float omega_e_radps)
{
    w->way           = 0.0f;
    w->time_s        = 0.0f;
    w->omega_e_radps = omega_e_radps;
}

/* Forgets the rest and the change: neither is whole. */
static void begin(app_watch_inertia_t *w, float omega_e_radps)
{
    begin_block(w, omega_e_radps);
    w->still = 0U;
    w->moved = 0U;
    w->begun = true;
}

/* Mean and range of the blocks in the ring. */
static void rest_of(const app_watch_inertia_t *w, float *mean, float *range)
{
    float sum  = 0.0f;
    float low  = w->block[0].mean;
    float high = low;

    for (uint16_t i = 0U; i < APP_WATCH_INERTIA_REST; i++) {
        const float x = w->block[i].mean;

        sum += x;
        low  = base_min(low, x);
        high = base_max(high, x);
    }
    *mean  = sum / (float)APP_WATCH_INERTIA_REST;
    *range = high - low;
}

static void begin_change(app_watch_inertia_t *w)
{
    rest_of(w, &w->rest_mean, &w->rest_range);
    w->from_e_radps = w->omega_e_radps;
    w->integral     = 0.0f;
    w->moved_s      = 0.0f;
    w->moved        = 1U;
}

static void learn(app_watch_inertia_t *w, float change_e_radps, float least_e_radps)
{
    const float change = fabsf(change_e_radps);
    float       mean   = 0.0f;
    float       range  = 0.0f;

    if (!(change >= least_e_radps)) {
        return;
    }
    rest_of(w, &mean, &range);
    const float load = 0.5f * w->moved_s * (w->rest_mean + mean);
    const float k =
        w->believed * (1.0f - ((w->integral - load) / change_e_radps)); /* EQ-INERTIA-5 */
    const float unsure = 0.5f * w->believed * w->moved_s *
                         (w->rest_range + range + fabsf(mean - w->rest_mean)); /* -6, times D */

    if (unsure <= (SURE * k * change)) { /* EQ-INERTIA-7; false for a NaN */
        w->ratio = base_clamp(w->ratio + (SHARE * (k - w->ratio)), APP_WATCH_INERTIA_LEAST,
                              APP_WATCH_INERTIA_MOST);
        if (w->changes < UINT16_MAX) {
            w->changes = (uint16_t)(w->changes + 1U);
        }
    }
}

/* The ring takes the block. One that leaves, and came after the begin, belongs to the change. */
static void keep_block(app_watch_inertia_t *w)
{
    app_watch_inertia_block_t *b = &w->block[w->next];

    if (w->moved > APP_WATCH_INERTIA_REST) {
        w->integral += b->mean * b->time_s;
        w->moved_s += b->time_s;
    }
    b->mean   = w->way / w->time_s;
    b->time_s = w->time_s;
    w->next   = (uint16_t)((w->next + 1U) % APP_WATCH_INERTIA_REST);
}

/* A block has ended at this speed. The first one at rest still belongs to the change: the observer
 * settles in it. */
static void end_block(app_watch_inertia_t *w, float omega_e_radps, float speed_max_e_radps)
{
    const bool moves = !base_within(omega_e_radps - w->omega_e_radps, MOVES * speed_max_e_radps);

    if (w->moved > 0U) {
        w->moved = (uint16_t)(w->moved + 1U);
    } else if (moves && (w->still >= APP_WATCH_INERTIA_REST)) {
        begin_change(w);
    } else {
        /* rests, or moves after a rest that was too short */
    }
    keep_block(w);
    if (moves) {
        w->still = 0U;
    } else if (w->still <= APP_WATCH_INERTIA_REST) {
        w->still = (uint16_t)(w->still + 1U);
    } else {
        /* long enough */
    }
    if ((w->moved > 0U) && (w->still > APP_WATCH_INERTIA_REST)) {
        learn(w, omega_e_radps - w->from_e_radps, LEAST * speed_max_e_radps);
        w->moved = 0U;
    } else if (w->moved > BLOCKS_MOST) {
        begin(w, omega_e_radps);
    } else {
        /* the next block */
    }
    begin_block(w, omega_e_radps);
}

void app_watch_inertia_see(app_watch_inertia_t *w, const app_watch_inertia_seen_t *seen,
                           float speed_max_e_radps, float ts_s)
{
    const float passed_s = (float)(seen->ticks - w->ticks) * ts_s;

    w->ticks        = seen->ticks;
    const bool same = base_within(seen->believed - w->believed, 0.0f);
    w->believed     = seen->believed;
    if (!seen->runs) {
        w->begun = false;
    } else if (!w->begun || !same) {
        begin(w, seen->omega_e_radps);
    } else {
        w->time_s += passed_s;
        w->way += passed_s * seen->d_omega;
        if (w->time_s > BLOCK_MOST_s) {
            begin(w, seen->omega_e_radps);
        } else if (w->time_s >= BLOCK_s) {
            end_block(w, seen->omega_e_radps, speed_max_e_radps);
        } else {
            /* within the block */
        }
    }
}
