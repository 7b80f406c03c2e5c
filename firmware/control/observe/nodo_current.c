/* SPDX-License-Identifier: MIT */
#include "nodo_current.h"

#include "check.h"
#include "fpu.h"
#include "frames.h"

enum { ROW_D_OMEGA, ROW_OMEGA, ROW_IQ, ROW_ID, ROW_THETA };
enum { COLUMN_IQ, COLUMN_ID };

bool nodo_current_check(const nodo_current_gains_t *g)
{
    const int16_t count = NODO_CURRENT_NODES * NODO_CURRENT_N_X * NODO_CURRENT_N_Y;

    return check_positive(g->from_e_radps) && check_positive(g->root) &&
           check_positive(g->nodes_per_root) && check_finite(&g->gain[0][0][0], count);
}

/* Row times innovation, interpolated between two nodes. */
static inline float product(const nodo_current_gains_t *g, int16_t node, float share, int16_t row,
                            const float r[NODO_CURRENT_N_Y])
{
    const float *const a    = g->gain[node][row];
    const float *const b    = g->gain[node + 1][row];
    const float        at_a = (a[COLUMN_IQ] * r[COLUMN_IQ]) + (a[COLUMN_ID] * r[COLUMN_ID]);
    const float        at_b = (b[COLUMN_IQ] * r[COLUMN_IQ]) + (b[COLUMN_ID] * r[COLUMN_ID]);

    return at_a + (share * (at_b - at_a));
}

#define SPEED_ANY_e_radps 1.0e9f /* exceeds every speed; finite */

/* Chosen by simulation: a motor of three times the inertia is 60 rad/s behind its estimate at the
 * minimum speed. The estimate has followed at a quarter of that speed. */
#define UNTIL 0.25f

/* Chosen: at a sixth of l5, and less, noise of d_d would look like another inductance. */
#define LITTLE 0.18f
/* Chosen: largest error of the flux. In a speed step d_q is for some milliseconds that of four
 * times as much. The estimated speed would then grow by itself. */
#define FLUX_OFF 0.3f
/* Chosen: largest error of L_q. */
#define LQ_OFF 0.5f

static void begin_without(nodo_current_t *s, const nodo_t *x, const nodo_current_gains_t *g,
                          const motor_reduced_t *m)
{
    const float little_A = base_max(LITTLE * m->l5, 1.0e-3f);
    const float i2_A2    = (x->iq_A * x->iq_A) + (little_A * little_A);

    s->least_e_radps = SPEED_ANY_e_radps;
    s->q_A           = 0.0f;
    s->d             = 0.0f;
    if (!base_within(x->omega_e_radps, g->from_e_radps)) {
        const float inverse  = fpu_inverse(x->omega_e_radps * i2_A2);
        const float most_q_A = FLUX_OFF * m->l5;
        const float most_d   = LQ_OFF * m->l9;

        s->least_e_radps = UNTIL * g->from_e_radps;
        s->q_A           = base_clamp(x->d_q * i2_A2 * inverse, -most_q_A, most_q_A);
        s->d             = base_clamp(x->d_d * x->iq_A * inverse, -most_d, most_d);
    }
}

/* EQ-NODO-CURRENT-1, 2 */
static void correct_by_currents(nodo_t *x, float *theta_rad, const nodo_current_gains_t *g,
                                dq_t i_A)
{
    const float   sign  = (x->omega_e_radps < 0.0f) ? -1.0f : 1.0f;
    const float   last  = (float)(NODO_CURRENT_NODES - 1);
    const float   root  = fpu_root(base_min(fabsf(x->omega_e_radps), 1.0e9f));
    const float   place = base_clamp(g->nodes_per_root * (root - g->root), 0.0f, last);
    const int16_t node  = (int16_t)base_min(place, last - 1.0f);
    const float   share = place - (float)node;
    const float   r[NODO_CURRENT_N_Y] = {i_A.q - x->iq_A, sign * (i_A.d - x->id_A)};
    const float   theta               = product(g, node, share, ROW_THETA, r);
    const float   iq_A                = x->iq_A + product(g, node, share, ROW_IQ, r);
    const float   id_A                = x->id_A + (sign * product(g, node, share, ROW_ID, r));

    x->d_omega += product(g, node, share, ROW_D_OMEGA, r);
    x->omega_e_radps += product(g, node, share, ROW_OMEGA, r);
    x->iq_A    = iq_A - (theta * id_A); /* the angle is small: a rotation to first order */
    x->id_A    = id_A + (theta * iq_A);
    *theta_rad = frames_wrap(*theta_rad + theta);
}

CTL_RARE bool nodo_current_correct(nodo_current_t *s, nodo_t *x, float *theta_rad,
                                   const nodo_current_gains_t *g, const motor_reduced_t *m,
                                   dq_t i_A)
{
    if (!(s->least_e_radps > 0.0f)) {
        begin_without(s, x, g, m);
    }
    correct_by_currents(x, theta_rad, g, i_A);
    x->d_q = s->q_A * x->omega_e_radps; /* EQ-NODO-CURRENT-3 */
    x->d_d = s->d * x->omega_e_radps * x->iq_A;
    return !base_within(x->omega_e_radps, s->least_e_radps) &&
           base_within(x->omega_e_radps, SPEED_ANY_e_radps);
}
