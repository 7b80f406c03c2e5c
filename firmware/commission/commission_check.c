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

#define PATTERN_TICKS (PULSE_TICKS * 4)

void commission_check_start(commission_check_t *k)
{
    commission_check_t fresh = {.v_V = 0.0f};
    *k                       = fresh;
}

static void clear_sums(commission_check_t *k)
{
    k->aa = 0.0f;
    k->ab = 0.0f;
    k->ba = 0.0f;
    k->bb = 0.0f;
    k->vv = 0.0f;
}

static void add_products(commission_check_t *k, const commission_signal_t *s)
{
    k->aa += s->di_A.alpha * s->v_V.alpha;
    k->ab += s->di_A.alpha * s->v_V.beta;
    k->ba += s->di_A.beta * s->v_V.alpha;
    k->bb += s->di_A.beta * s->v_V.beta;
    k->vv += (s->v_V.alpha * s->v_V.alpha) + (s->v_V.beta * s->v_V.beta);
}

/* Remembers the sums before the last quarter: a sensor that has died meanwhile is silent in it. */
static void begin_last(commission_check_t *k)
{
    if (k->patterns == (3 * AXES * PATTERNS / 4)) {
        k->begun    = k->aa + k->bb;
        k->begun_vv = k->vv;
    }
}

/* Raises the pulses until the current answers. @return false: even the largest one is silent. */
static bool search_pulse(commission_check_t *k, const commission_config_t *c, float most_V)
{
    /* Along the axis of phase a, v has its alpha component only. */
    const float per_V  = sqrtf((k->aa * k->aa) + (k->ba * k->ba)) / base_max(k->vv, 1.0e-12f);
    const float peak_A = (float)PULSE_TICKS * k->v_V * per_V;

    k->found          = (peak_A >= (ANSWER_SHARE * c->current_max_A)) || (k->v_V >= most_V);
    const bool silent = k->found && !(peak_A >= (SILENT_SHARE * c->current_max_A));
    if (!k->found) {
        k->v_V = base_min(GROWTH * k->v_V, most_V);
    }
    clear_sums(k);
    return !silent;
}

/* Judges the matrix: positive, not singular, symmetric. */
static commission_step_t solve_matrix(const commission_check_t *k, float ts_s,
                                      commission_admittance_t *y)
{
    const float scale = 2.0f / (ts_s * base_max(k->vv, 1.0e-12f)); /* EQ-COMMISSION-15 */
    const float mean  = 0.5f * scale * (k->aa + k->bb);
    const float skew  = scale * (k->ab - k->ba);

    y->aa            = scale * k->aa;
    y->ab            = 0.5f * scale * (k->ab + k->ba);
    y->bb            = scale * k->bb;
    const float det  = (y->aa * y->bb) - (y->ab * y->ab);
    const float last = scale * k->vv * 0.5f * ((k->aa + k->bb) - k->begun) /
                       base_max(k->vv - k->begun_vv, 1.0e-12f);
    return ((mean > 0.0f) && (last > (LAST_SHARE * mean)) && (det > (LEAST_DET * mean * mean)) &&
            base_within(skew, MOST_SKEW * mean))
               ? COMMISSION_DONE
               : COMMISSION_FAILED;
}

commission_answer_t commission_check_tick(commission_check_t *k, const commission_config_t *c,
                                          const commission_signal_t *s, commission_admittance_t *y)
{
    const float         most_V = MOST_SHARE * s->dc_link_V;
    commission_answer_t out    = commission_rest(COMMISSION_BUSY);

    if (!(k->v_V > 0.0f)) {
        k->v_V = LEAST_SHARE * s->dc_link_V;
    }
    add_products(k, s);
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
        out.step = solve_matrix(k, c->ts_s, y);
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
