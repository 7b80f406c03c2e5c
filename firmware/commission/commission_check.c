/* SPDX-License-Identifier: MIT */
#include "commission_check.h"

/* Chosen: pulses grow from a voltage below the dead-time loss to the largest in the hexagon. */
#define LEAST_SHARE 0.002f
#define MOST_SHARE  0.45f
#define GROWTH      1.5f
#define PULSE_TICKS 2
/* Chosen: peak of a pulse's current, share of the bound; above the noise, without torque. */
#define ANSWER_SHARE 0.05f
/* Chosen: with the largest pulse, less than this is no answer. */
#define SILENT_SHARE 0.01f
#define AXES         3
#define PATTERNS     16
/* Chosen: the last quarter of the patterns answers like all of them, within this ratio. */
#define LAST_SHARE 0.6f
/* Chosen: a motor's inductances differ by less than 18, det / (trace / 2)^2 = 4 r / (1 + r)^2. */
#define LEAST_DET 0.2f
/* Chosen: finds gains that differ by a factor of 1.7; eleven healthy motors have 0.13 at most. */
#define MOST_SKEW 0.3f

/* Chosen: mean admittance to an earlier one; healthy 0.95 .. 1.4. */
#define LEAST_RATIO 0.6f
#define MOST_RATIO  1.7f

#define PATTERN_TICKS (PULSE_TICKS * 4)

void commission_check_start(commission_check_t *k)
{
    commission_check_t fresh = {.v_V = 0.0f};
    *k                       = fresh;
}

void commission_sums_add(commission_sums_t *k, ab_t di_A, ab_t v_V)
{
    k->aa += di_A.alpha * v_V.alpha;
    k->ab += di_A.alpha * v_V.beta;
    k->ba += di_A.beta * v_V.alpha;
    k->bb += di_A.beta * v_V.beta;
    k->vv += (v_V.alpha * v_V.alpha) + (v_V.beta * v_V.beta);
}

/* Remembers the sums before the last quarter: a sensor that has died meanwhile is silent in it. */
static void begin_last(commission_check_t *k)
{
    if (k->patterns == (3 * AXES * PATTERNS / 4)) {
        k->begun    = k->sums.aa + k->sums.bb;
        k->begun_vv = k->sums.vv;
    }
}

/* Raises the pulses until the current answers. @return false: even the largest one is silent. */
static bool search_pulse(commission_check_t *k, const commission_config_t *c, float most_V)
{
    /* Along the axis of phase a, v has its alpha component only. */
    const commission_sums_t none   = {.aa = 0.0f};
    const float             answer = sqrtf((k->sums.aa * k->sums.aa) + (k->sums.ba * k->sums.ba));
    const float             per_V  = answer / base_max(k->sums.vv, 1.0e-12f);
    const float             peak_A = (float)PULSE_TICKS * k->v_V * per_V;

    k->found          = (peak_A >= (ANSWER_SHARE * c->current_max_A)) || (k->v_V >= most_V);
    const bool silent = k->found && !(peak_A >= (SILENT_SHARE * c->current_max_A));
    if (!k->found) {
        k->v_V = base_min(GROWTH * k->v_V, most_V);
    }
    k->sums = none;
    return !silent;
}

static float mean_of(const commission_admittance_t *y)
{
    return 0.5f * (y->aa + y->bb);
}

float commission_check_det(const commission_admittance_t *y)
{
    const float mean = mean_of(y);
    return ((y->aa * y->bb) - (y->ab * y->ab)) / base_max(mean * mean, 1.0e-12f);
}

float commission_check_least(const commission_admittance_t *y)
{
    const float half = 0.5f * (y->aa - y->bb);
    return mean_of(y) - sqrtf((half * half) + (y->ab * y->ab));
}

bool commission_check_same(const commission_admittance_t *y, const commission_admittance_t *known)
{
    const float before = known->aa + known->bb;
    return base_in_range(y->aa + y->bb, LEAST_RATIO * before, MOST_RATIO * before);
}

/* Positive, not singular, symmetric. */
bool commission_sums_solve(const commission_sums_t *k, float ts_s, float least_det,
                           commission_admittance_t *y)
{
    const float scale = 2.0f / (ts_s * base_max(k->vv, 1.0e-12f)); /* EQ-COMMISSION-15 */
    const float skew  = scale * (k->ab - k->ba);

    y->aa = scale * k->aa;
    y->ab = 0.5f * scale * (k->ab + k->ba);
    y->bb = scale * k->bb;
    return (mean_of(y) > 0.0f) && (commission_check_det(y) > least_det) &&
           base_within(skew, MOST_SKEW * mean_of(y));
}

static commission_step_t solve_admittance(const commission_check_t *k, float ts_s,
                                          commission_admittance_t *y)
{
    const float all  = k->sums.aa + k->sums.bb;
    const float last = k->sums.vv * (all - k->begun) / base_max(k->sums.vv - k->begun_vv, 1.0e-12f);
    const bool  ok =
        commission_sums_solve(&k->sums, ts_s, LEAST_DET, y) && (last > (LAST_SHARE * all));

    y->pulse_V = k->v_V;
    return ok ? COMMISSION_DONE : COMMISSION_FAILED;
}

commission_answer_t commission_check_tick(commission_check_t *k, const commission_config_t *c,
                                          const commission_signal_t *s, commission_admittance_t *y)
{
    const float         most_V = MOST_SHARE * s->dc_link_V;
    commission_answer_t out    = commission_rest(COMMISSION_BUSY);

    if (!(k->v_V > 0.0f)) {
        k->v_V = LEAST_SHARE * s->dc_link_V;
    }
    commission_sums_add(&k->sums, s->di_A, s->v_V);
    if (k->tick >= PATTERN_TICKS) {
        k->tick = 0;
        if (k->found) {
            k->patterns++;
            begin_last(k);
        } else if (!search_pulse(k, c, most_V)) {
            out.step = COMMISSION_FAILED;
        } else {
            /* the next pattern is larger, or the first that counts */
        }
    }
    if (k->patterns >= (AXES * PATTERNS)) {
        out.step = solve_admittance(k, c->ts_s, y);
    }
    if (out.step == COMMISSION_BUSY) {
        const int16_t axis = (int16_t)(k->patterns % AXES);
        const bool    up   = (k->tick < PULSE_TICKS) || (k->tick >= (3 * PULSE_TICKS));
        const float   size = base_min(k->v_V, most_V);
        const dq_t    v_V  = {up ? size : -size, 0.0f};
        const float   turn = BASE_TWO_PI * (float)axis / (float)AXES;
        out.v_V            = frames_inverse_park(v_V, frames_angle(frames_wrap(turn)));
        k->tick++;
    }
    return out;
}
