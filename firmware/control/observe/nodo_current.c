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

void nodo_current_correct(nodo_t *x, float *theta_rad, const nodo_current_gains_t *g, dq_t i_A)
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
