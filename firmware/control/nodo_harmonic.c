/* SPDX-License-Identifier: MIT */
#include "nodo_harmonic.h"

#include <math.h>

#include "frames.h"
#include "nodo_encoder.h"

#include "check.h"

void nodo_harmonic_reset(nodo_harmonic_t *s, const nodo_meas_t *y, float theta_rad)
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

/* Harmonics beyond this have no angle left at any speed that a drive runs at. */
#define ORDER_MAX 1.0e3f

/* Two neighbouring nodes of the table and what their columns are multiplied by. */
typedef struct {
    const float (*lower)[NODO_HARMONIC_N_G];
    const float (*upper)[NODO_HARMONIC_N_G];
    float by_lower[NODO_HARMONIC_N_G];
    float by_upper[NODO_HARMONIC_N_G];
} lookup_t;

/* EQ-HARMONIC-3 for the innovation r of measured iq, id, theta, which with iq are those of the mirror image. */
static void look_up(lookup_t *at, const nodo_harmonic_gains_t *g, float omega_e_radps, float iq_A,
                    const float r[3])
{
    const int16_t last  = (int16_t)(g->n_nodes - 1);
    const float   root  = g->nodes_per_root * sqrtf(fabsf(omega_e_radps));
    const float   place = base_clamp(root, 0.0f, (float)last);
    const int16_t whole = (int16_t)place;
    const int16_t below = (whole < last) ? whole : (int16_t)(last - 1);
    const float   share = place - (float)below;

    at->lower = g->gain[below];
    at->upper = g->gain[below + 1];
    for (int16_t i = 0; i < 3; i++) {
        const float r_upper = share * r[i];
        const float r_lower = r[i] - r_upper;

        at->by_lower[i]     = r_lower;
        at->by_upper[i]     = r_upper;
        at->by_lower[i + 3] = r_lower * iq_A;
        at->by_upper[i + 3] = r_upper * iq_A;
    }
}

static float row_of(const lookup_t *at, int16_t row)
{
    const float *l = at->lower[row];
    const float *u = at->upper[row];
    const float *x = at->by_lower;
    const float *y = at->by_upper;

    return (l[0] * x[0]) + (l[1] * x[1]) + (l[2] * x[2]) + (l[3] * x[3]) + (l[4] * x[4]) +
           (l[5] * x[5]) + (u[0] * y[0]) + (u[1] * y[1]) + (u[2] * y[2]) + (u[3] * y[3]) +
           (u[4] * y[4]) + (u[5] * y[5]);
}

/* The mirror image of a pair changes the sign of a in the odd channels and of b in the others. */
static bool a_is_odd(nodo_harmonic_channel_t channel)
{
    return (channel == NODO_HARMONIC_TORQUE) || (channel == NODO_HARMONIC_VOLTAGE_Q);
}

/* Adds K times the innovation; sign turns the odd signals back from the mirror image. */
static void apply(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g, const lookup_t *at,
                  float sign)
{
    nodo_t *x = &s->base;

    x->d_omega += sign * row_of(at, 0);
    x->d_q += sign * row_of(at, 1);
    x->d_d += row_of(at, 2);
    x->omega_e_radps += sign * row_of(at, 3);
    x->iq_A += sign * row_of(at, 4);
    x->id_A += row_of(at, 5);
    s->theta_rad = frames_wrap(s->theta_rad + (sign * row_of(at, 6)));
    s->slope += sign * row_of(at, 7);
    for (int16_t i = 0; i < g->n_pairs; i++) {
        const int16_t row = (int16_t)(NODO_HARMONIC_N_BASE + (2 * i));
        const bool    odd = a_is_odd(g->pair[i].channel);

        s->pair[i].a += (odd ? sign : 1.0f) * row_of(at, row);
        s->pair[i].b += (odd ? 1.0f : sign) * row_of(at, (int16_t)(row + 1));
    }
}

void nodo_harmonic_correct(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g, dq_t i_A,
                           float angle_error)
{
    const nodo_t *x    = &s->base;
    const float   sign = (x->omega_e_radps < 0.0f) ? -1.0f : 1.0f;
    const float   iq_A = sign * base_clamp(x->iq_A, -g->iq_max_A, g->iq_max_A);
    float         r_iq = i_A.q - x->iq_A;
    float         r_id = i_A.d - x->id_A;
    lookup_t      at;

    for (int16_t i = 0; i < g->n_pairs; i++) { /* EQ-HARMONIC-2 */
        if (g->pair[i].channel == NODO_HARMONIC_SENSOR) {
            r_iq -= s->pair[i].b;
            r_id -= s->pair[i].a;
        }
    }
    const float r[3] = {sign * r_iq, r_id, sign * angle_error};

    look_up(&at, g, x->omega_e_radps, iq_A, r);
    apply(s, g, &at, sign);
}

static nodo_harmonic_pair_t turned(nodo_harmonic_pair_t p, frames_angle_t by)
{
    const nodo_harmonic_pair_t out = {.a = (p.a * by.cos) - (p.b * by.sin),
                                      .b = (p.a * by.sin) + (p.b * by.cos)};
    return out;
}

/* What the pairs add to the disturbances. */
typedef struct {
    nodo_meas_t middle;  /* in the derivatives of w, iq, id, middle of this period */
    nodo_meas_t after;   /* at its end; currents: middle of the next one */
    float       d_w_dot; /* middle of the next one */
} added_t;

static void add(nodo_meas_t *to, nodo_harmonic_channel_t channel, float a)
{
    if (channel == NODO_HARMONIC_TORQUE) {
        to->omega_e_radps += a;
    } else if (channel == NODO_HARMONIC_VOLTAGE_Q) {
        to->iq_A += a;
    } else if (channel == NODO_HARMONIC_VOLTAGE_D) {
        to->id_A += a;
    } else {
        /* current sensors disturb nothing */
    }
}

/* EQ-HARMONIC-1, and what the turning pairs add on their way. Neighbours of one order share the turn. */
static added_t turn_pairs(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g, float dtheta_rad)
{
    const float    w      = s->base.omega_e_radps;
    added_t        sum    = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f};
    frames_angle_t half   = {.cos = 1.0f, .sin = 0.0f};
    float          before = 0.0f; /* a pair of order 0 does not turn */

    for (int16_t i = 0; i < g->n_pairs; i++) {
        const nodo_harmonic_channel_t channel = g->pair[i].channel;
        const float                   order   = g->pair[i].order;

        if ((order < before) || (order > before)) {
            half   = frames_angle(0.5f * order * dtheta_rad);
            before = order;
        }
        const nodo_harmonic_pair_t middle = turned(s->pair[i], half);
        nodo_harmonic_pair_t       end    = turned(middle, half);

        const float keep =
            (fabsf(order * dtheta_rad) < NODO_HARMONIC_TURN_MAX) ? g->keep : g->keep_fast;
        end.a      = keep * end.a;
        end.b      = keep * end.b;
        s->pair[i] = end;
        if (channel == NODO_HARMONIC_SENSOR) {
            continue;
        }
        const nodo_harmonic_pair_t next   = turned(end, half);
        const bool                 torque = channel == NODO_HARMONIC_TORQUE;

        add(&sum.middle, channel, middle.a);
        add(&sum.after, channel, torque ? end.a : next.a);
        sum.d_w_dot -= torque ? (order * w * next.b) : 0.0f;
    }
    return sum;
}

nodo_harmonic_view_t nodo_harmonic_predict(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g,
                                           const motor_reduced_t *m, dq_t v_V, float ts_s)
{
    const float   advanced   = s->theta_rad + (ts_s * s->base.omega_e_radps);
    const float   dtheta_rad = frames_wrap(advanced - s->theta_pairs_rad);
    const added_t pairs      = turn_pairs(s, g, dtheta_rad);
    nodo_t        x          = s->base;

    s->theta_pairs_rad = frames_wrap(s->theta_pairs_rad + dtheta_rad);

    x.d_omega += (0.5f * ts_s * s->slope) + pairs.middle.omega_e_radps;
    x.d_q += pairs.middle.iq_A;
    x.d_d += pairs.middle.id_A;
    nodo_encoder_predict(&x, &s->theta_rad, m, v_V, ts_s); /* EQ-HARMONIC-4 */
    s->base.omega_e_radps = x.omega_e_radps;
    s->base.iq_A          = x.iq_A;
    s->base.id_A          = x.id_A;
    s->base.d_omega += ts_s * s->slope;

    nodo_harmonic_view_t view = {.total = s->base, .d_omega_dot = s->slope + pairs.d_w_dot};
    view.total.d_omega += pairs.after.omega_e_radps;
    view.total.d_q += pairs.after.iq_A;
    view.total.d_d += pairs.after.id_A;
    return view;
}

static bool numbers_ok(const nodo_harmonic_gains_t *g)
{
    return (g->n_pairs >= 0) && (g->n_pairs <= NODO_HARMONIC_PAIRS_MAX) && (g->n_nodes >= 2) &&
           (g->n_nodes <= NODO_HARMONIC_NODES_MAX) && check_positive(g->iq_max_A) &&
           check_positive(g->nodes_per_root) && check_positive(g->keep) && (g->keep <= 1.0f) &&
           check_positive(g->keep_fast) && (g->keep_fast <= 1.0f);
}

bool nodo_harmonic_check(const nodo_harmonic_gains_t *g)
{
    bool ok = numbers_ok(g);

    for (int16_t node = 0; ok && (node < g->n_nodes); node++) {
        const int16_t rows = (int16_t)(NODO_HARMONIC_N_BASE + (2 * g->n_pairs));
        for (int16_t row = 0; row < rows; row++) {
            ok = ok && check_finite(g->gain[node][row], NODO_HARMONIC_N_G);
        }
    }
    for (int16_t i = 0; ok && (i < g->n_pairs); i++) {
        ok = base_within(g->pair[i].order, ORDER_MAX);
    }
    return ok;
}
