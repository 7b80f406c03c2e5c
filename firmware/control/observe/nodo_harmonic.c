/* SPDX-License-Identifier: MIT */
#include "nodo_harmonic.h"

#include "check.h"
#include "fpu.h"
#include "frames.h"
#include "nodo_encoder.h"

CTL_PART void nodo_harmonic_reset(nodo_harmonic_t *s, const nodo_meas_t *y, float theta_rad)
{
    const nodo_harmonic_pair_t nothing = {0.0f, 0.0f};

    nodo_reset(&s->base, y);
    s->slope           = 0.0f;
    s->theta_rad       = frames_wrap(theta_rad);
    s->theta_pairs_rad = s->theta_rad;
    for (int16_t i = 0; i < NODO_HARMONIC_PAIRS_MAX; i++) {
        s->pair[i] = nothing;
    }
}

/* Largest order. At a higher one, a pair exceeds NODO_HARMONIC_TURN_MAX at every useful speed. */
#define ORDER_MAX 1.0e3f

/* A node of the table, and the factors for its columns and those of the next node. */
typedef struct {
    int16_t below;
    float   by_lower[NODO_HARMONIC_N_G];
    float   by_upper[NODO_HARMONIC_N_G];
} lookup_t;

/* K times the innovation, row by row. */
typedef struct {
    float row[NODO_HARMONIC_N_X_MAX];
} change_t;

/* EQ-HARMONIC-3 for the innovation r of measured iq, id, theta. For w < 0, r and iq are
 * mirrored. */
static void look_up(lookup_t *at, const nodo_harmonic_gains_t *g, float omega_e_radps, float iq_A,
                    const float r[3])
{
    const int16_t last  = (int16_t)(g->n_nodes - 1);
    const float   root  = g->nodes_per_root * fpu_root(fabsf(omega_e_radps));
    const float   place = base_clamp(root, 0.0f, (float)last);
    const int16_t whole = (int16_t)place;
    const int16_t below = (whole < last) ? whole : (int16_t)(last - 1);
    const float   share = place - (float)below;

    at->below = below;
    for (int16_t i = 0; i < 3; i++) {
        const float r_upper = share * r[i];
        const float r_lower = r[i] - r_upper;

        at->by_lower[i]     = r_lower;
        at->by_upper[i]     = r_upper;
        at->by_lower[i + 3] = r_lower * iq_A;
        at->by_upper[i + 3] = r_upper * iq_A;
    }
}

/* One loop over rows with adjacent nodes. It is a third of the cost of this observer. */
static void multiply(change_t *out, const nodo_harmonic_gains_t *g, const lookup_t *at)
{
    const float       *x   = at->by_lower;
    const float       *y   = at->by_upper;
    const float *const end = &out->row[NODO_HARMONIC_N_BASE + (2 * g->n_pairs)];

    const float(*gain)[NODO_HARMONIC_NODES_MAX][NODO_HARMONIC_N_G] = g->gain;

    float *to = out->row;

    while (to < end) {
        const float *const l = (*gain)[at->below];
        const float *const u = (*gain)[at->below + 1];

        *to = (l[0] * x[0]) + (l[1] * x[1]) + (l[2] * x[2]) + (l[3] * x[3]) + (l[4] * x[4]) +
              (l[5] * x[5]) + (u[0] * y[0]) + (u[1] * y[1]) + (u[2] * y[2]) + (u[3] * y[3]) +
              (u[4] * y[4]) + (u[5] * y[5]);
        to++;
        gain++;
    }
}

/* The mirror image of a pair changes the sign of a in the odd channels and of b in the others. */
static bool a_is_odd(nodo_harmonic_channel_t channel)
{
    return (channel == NODO_HARMONIC_TORQUE) || (channel == NODO_HARMONIC_VOLTAGE_Q);
}

/* Adds the change to the state; `sign` converts odd signals back from the mirror image. */
static void apply(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g, const change_t *change,
                  float sign)
{
    nodo_t      *x   = &s->base;
    const float *row = change->row;

    x->d_omega += sign * row[0];
    x->d_q += sign * row[1];
    x->d_d += row[2];
    x->omega_e_radps += sign * row[3];
    x->iq_A += sign * row[4];
    x->id_A += row[5];
    s->theta_rad = frames_wrap(s->theta_rad + (sign * row[6]));
    s->slope += sign * row[7];

    row = &change->row[NODO_HARMONIC_N_BASE];
    for (int16_t i = 0; i < g->n_pairs; i++) {
        nodo_harmonic_pair_t *p = &s->pair[i];

        if (a_is_odd(g->pair[i].channel)) {
            p->a += sign * row[0];
            p->b += row[1];
        } else {
            p->a += row[0];
            p->b += sign * row[1];
        }
        row = &row[2];
    }
}

CTL_PART void nodo_harmonic_correct(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g, dq_t i_A,
                                    float angle_error)
{
    const nodo_t *x    = &s->base;
    const float   sign = (x->omega_e_radps < 0.0f) ? -1.0f : 1.0f;
    const float   iq_A = sign * base_clamp(x->iq_A, -g->iq_max_A, g->iq_max_A);
    float         r_iq = i_A.q - x->iq_A;
    float         r_id = i_A.d - x->id_A;
    lookup_t      at;
    change_t      change;

    for (int16_t i = 0; i < g->n_pairs; i++) { /* EQ-HARMONIC-2 */
        if (g->pair[i].channel == NODO_HARMONIC_SENSOR) {
            r_iq -= s->pair[i].b;
            r_id -= s->pair[i].a;
        }
    }
    const float r[3] = {sign * r_iq, r_id, sign * angle_error};

    look_up(&at, g, x->omega_e_radps, iq_A, r);
    multiply(&change, g, &at);
    apply(s, g, &change, sign);
}

static frames_angle_t doubled(frames_angle_t x)
{
    const float          two_sin = 2.0f * x.sin;
    const frames_angle_t z       = {.cos = 1.0f - (two_sin * x.sin), .sin = two_sin * x.cos};
    return z;
}

/* Contribution of the pairs of a channel to a disturbance. */
typedef struct {
    float middle; /* in the middle of this period */
    float after;  /* torque: at its end; voltages: middle of the next one */
} added_t;

/* SENSOR pairs contribute none. */
typedef struct {
    added_t omega;
    added_t q;
    added_t d;
    float   d_w_dot; /* middle of the next period */
} sums_t;

/* Turns a pair by half a period, and by a whole one with decay, EQ-HARMONIC-1. */
static void turn_pair(nodo_harmonic_pair_t *pair, frames_angle_t half, frames_angle_t whole,
                      const nodo_harmonic_order_t *of, float w, sums_t *sum)
{
    const nodo_harmonic_pair_t p   = *pair;
    const nodo_harmonic_pair_t end = {.a = (p.a * whole.cos) - (p.b * whole.sin),
                                      .b = (p.a * whole.sin) + (p.b * whole.cos)};

    *pair = end;
    if (of->channel == NODO_HARMONIC_SENSOR) {
        return;
    }
    const float middle = (p.a * half.cos) - (p.b * half.sin);

    if (of->channel == NODO_HARMONIC_TORQUE) {
        sum->omega.middle += middle;
        sum->omega.after += end.a;
        sum->d_w_dot -= of->order * w * ((end.a * half.sin) + (end.b * half.cos));
    } else {
        added_t *to = (of->channel == NODO_HARMONIC_VOLTAGE_Q) ? &sum->q : &sum->d;

        to->middle += middle;
        to->after += (end.a * half.cos) - (end.b * half.sin);
    }
}

/* Neighbours of one order share the turn. */
static void turn_pairs(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g, float dtheta_rad,
                       sums_t *sum)
{
    frames_angle_t half   = {.cos = 1.0f, .sin = 0.0f};
    frames_angle_t whole  = {.cos = g->keep, .sin = 0.0f};
    float          before = 0.0f; /* a pair of order 0 does not turn */

    for (int16_t i = 0; i < g->n_pairs; i++) {
        const float order = g->pair[i].order;

        if (!base_within(order - before, 0.0f)) {
            const float turn = order * dtheta_rad;
            const bool  slow = base_within(turn, NODO_HARMONIC_TURN_MAX);
            const float keep = slow ? g->keep : g->keep_fast;

            half      = slow ? frames_small_angle(0.5f * turn) : frames_angle(0.5f * turn);
            whole     = doubled(half);
            whole.cos = keep * whole.cos;
            whole.sin = keep * whole.sin;
            before    = order;
        }
        turn_pair(&s->pair[i], half, whole, &g->pair[i], s->base.omega_e_radps, sum);
    }
}

CTL_PART void nodo_harmonic_predict(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g,
                                    const motor_reduced_t *m, dq_t v_V, float ts_s,
                                    nodo_harmonic_view_t *view)
{
    const float advanced   = s->theta_rad + (ts_s * s->base.omega_e_radps);
    const float dtheta_rad = frames_wrap(advanced - s->theta_pairs_rad);
    sums_t      pairs      = {{0.0f, 0.0f}, {0.0f, 0.0f}, {0.0f, 0.0f}, 0.0f};
    nodo_t      x;

    turn_pairs(s, g, dtheta_rad, &pairs);
    s->theta_pairs_rad = frames_wrap(s->theta_pairs_rad + dtheta_rad);

    x = s->base;
    x.d_omega += (0.5f * ts_s * s->slope) + pairs.omega.middle;
    x.d_q += pairs.q.middle;
    x.d_d += pairs.d.middle;
    nodo_encoder_predict(&x, &s->theta_rad, m, v_V, ts_s); /* EQ-HARMONIC-4 */
    s->base.omega_e_radps = x.omega_e_radps;
    s->base.iq_A          = x.iq_A;
    s->base.id_A          = x.id_A;
    s->base.d_omega += ts_s * s->slope;

    view->total = s->base;
    view->total.d_omega += pairs.omega.after;
    view->total.d_q += pairs.q.after;
    view->total.d_d += pairs.d.after;
    view->d_omega_dot = s->slope + pairs.d_w_dot;
}

CTL_PART bool nodo_harmonic_counts_ok(const nodo_harmonic_gains_t *g)
{
    return (g->n_pairs >= 0) && (g->n_pairs <= NODO_HARMONIC_PAIRS_MAX) && (g->n_nodes >= 2) &&
           (g->n_nodes <= NODO_HARMONIC_NODES_MAX);
}

static bool numbers_ok(const nodo_harmonic_gains_t *g)
{
    return nodo_harmonic_counts_ok(g) && check_positive(g->iq_max_A) &&
           check_positive(g->nodes_per_root) && check_positive(g->keep) && (g->keep <= 1.0f) &&
           check_positive(g->keep_fast) && (g->keep_fast <= 1.0f);
}

CTL_PART bool nodo_harmonic_check(const nodo_harmonic_gains_t *g)
{
    bool ok = numbers_ok(g);

    for (int16_t row = 0; ok && (row < (NODO_HARMONIC_N_BASE + (2 * g->n_pairs))); row++) {
        for (int16_t node = 0; node < g->n_nodes; node++) {
            ok = ok && check_finite(g->gain[row][node], NODO_HARMONIC_N_G);
        }
    }
    for (int16_t i = 0; ok && (i < g->n_pairs); i++) {
        const int16_t channel = (int16_t)g->pair[i].channel;

        ok = base_within(g->pair[i].order, ORDER_MAX) &&
             (channel >= (int16_t)NODO_HARMONIC_SENSOR) &&
             (channel <= (int16_t)NODO_HARMONIC_VOLTAGE_D);
    }
    return ok;
}
