/* SPDX-License-Identifier: MIT */
#include "commission_probe.h"

#define PULSES 4
#define AXES   2
/* Chosen: half of the noise of 16 periods, and two windows end a sensor that has died. */
#define PATTERNS (COMMISSION_PROBE_TICKS / (PULSES * AXES))
#define WINDOW   COMMISSION_PROBE_TICKS
/* Chosen: pulses of one period have the peak current of the check's pulses of two. */
#define HEIGHT     2.0f
#define MOST_SHARE 0.45f
/* A pulse of tick k acts between the samples k + 1 and k + 2. */
#define DELAY 2
/* Chosen: determinant to that of the check. */
#define DET_SHARE 0.35f
/* Chosen: a window counts half in the next one; noise is less by the root of 3. */
#define KEEP 0.5f

void commission_probe_start(commission_probe_t *p)
{
    const commission_probe_t fresh = {.tick = 0};
    *p                             = fresh;
}

/* Pulse of a tick of the window. Half of the patterns of an axis are reversed: their torque does
 * not move the shaft. */
static ab_t pulse_of(int16_t tick, float size_V)
{
    const int16_t place    = (int16_t)(tick % PULSES);
    const bool    outer    = (place == 0) || (place == (PULSES - 1));
    const bool    reversed = (tick % (PULSES * PATTERNS)) >= (PULSES * PATTERNS / 2);
    const float   v_V      = (outer != reversed) ? size_V : -size_V;
    const bool    first    = tick < (PULSES * PATTERNS);
    const ab_t    out      = {first ? v_V : 0.0f, first ? 0.0f : v_V};
    return out;
}

static bool judge_probe(const commission_probe_t *p, float ts_s,
                        const commission_admittance_t *known)
{
    commission_admittance_t y;
    const float             det     = DET_SHARE * commission_check_det(known);
    const bool              answers = commission_sums_solve(&p->sums, ts_s, det, &y);
    return answers && commission_check_same(&y, known);
}

bool commission_probe_tick(commission_probe_t *p, const commission_config_t *c,
                           const commission_signal_t *s, const commission_admittance_t *known,
                           ab_t *pulse_V)
{
    const int16_t acted = (int16_t)((p->tick + WINDOW - DELAY) % WINDOW);
    bool          ok    = true;

    const float size_V = base_min(HEIGHT * known->pulse_V, MOST_SHARE * s->dc_link_V);

    commission_sums_add(&p->sums, s->di_A, pulse_of(acted, size_V));
    if (acted == (WINDOW - 1)) {
        ok      = !p->full || judge_probe(p, c->ts_s, known);
        p->full = true;
        p->sums.aa *= KEEP;
        p->sums.ab *= KEEP;
        p->sums.ba *= KEEP;
        p->sums.bb *= KEEP;
        p->sums.vv *= KEEP;
    }
    *pulse_V = pulse_of(p->tick, size_V);
    p->tick  = (int16_t)((p->tick + 1) % WINDOW);
    return ok;
}
