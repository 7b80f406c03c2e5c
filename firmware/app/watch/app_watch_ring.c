/* SPDX-License-Identifier: MIT */
#include "app_watch_ring.h"

#define LEAST  0.05f /* chosen */
#define MEAN_s 0.02f /* chosen: 8 Hz, far below every resonance that is looked for */
#define SURE_s 0.3f  /* chosen: 12 cycles of 40 Hz */
#define ODD_s  0.1f  /* chosen: an odd cycle takes back so much; noise has nothing else */
#define HOLD_s 2.0f  /* chosen: a master that polls twice a second sees it */
#define ALIKE  0.25f /* chosen: the period of a limit cycle differs by less */
#define SMOOTH 0.125f
/* The range of an unknown coupling in a drive file, and a tenth more. */
#define LOW_Hz  36.0f
#define HIGH_Hz 660.0f

void app_watch_ring_reset(app_watch_ring_t *w)
{
    const app_watch_ring_t nothing = {.hz = 0.0f};

    *w = nothing;
}

static float since_s(uint32_t now, uint32_t then, float ts_s)
{
    return (float)(now - then) * ts_s;
}

/* A cycle has ended. */
static void end_cycle(app_watch_ring_t *w, float ts_s)
{
    const float n     = (float)(w->ticks - w->crossed);
    const bool  alike = base_within(n - w->period, (ALIKE * w->period) + 1.0f) &&
                       base_in_range(n * ts_s, 1.0f / HIGH_Hz, 1.0f / LOW_Hz);

    w->crossed = w->ticks;
    if (!alike) {
        const uint32_t lost = (uint32_t)(ODD_s / ts_s);
        const uint32_t age  = w->ticks - w->since;

        w->since  = (age > lost) ? (w->since + lost) : w->ticks;
        w->period = (age > lost) ? w->period : n;
        return;
    }
    w->period += SMOOTH * (n - w->period);
    if (since_s(w->ticks, w->since, ts_s) >= SURE_s) { /* EQ-RING-1 */
        w->hz    = 1.0f / (w->period * ts_s);
        w->rang  = w->ticks;
        w->rings = true;
    }
}

static void begin(app_watch_ring_t *w, float iq_A)
{
    w->crossed = w->ticks;
    w->since   = w->ticks;
    w->mean_A  = iq_A;
    w->period  = 0.0f;
    w->above   = false;
    w->begun   = true;
}

void app_watch_ring_see(app_watch_ring_t *w, const app_watch_ring_seen_t *seen, float most_A,
                        float ts_s)
{
    const float passed_s = since_s(seen->ticks, w->ticks, ts_s);

    w->ticks = seen->ticks;
    if (w->rings && (since_s(w->ticks, w->rang, ts_s) > HOLD_s)) {
        w->rings = false;
    }
    if (!seen->runs) {
        w->begun = false;
    } else if (!w->begun) {
        begin(w, seen->iq_A);
    } else {
        const float least_A = LEAST * most_A;

        w->mean_A += base_min(passed_s / MEAN_s, 1.0f) * (seen->iq_A - w->mean_A);
        const float x_A = seen->iq_A - w->mean_A;
        if (w->above) {
            w->above = x_A > -least_A;
        } else if (x_A > least_A) {
            w->above = true;
            end_cycle(w, ts_s);
        } else {
            /* not yet risen */
        }
    }
}
