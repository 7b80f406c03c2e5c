/* SPDX-License-Identifier: MIT */
#include "iron.h"

#include "check.h"
#include "fpu.h"
#include "frames.h"

/* Four nodes of a cell and the place between them. */
typedef struct {
    const float (*low)[IRON_VALUES]; /* node of the smaller iq, then that of the larger one */
    const float (*high)[IRON_VALUES];
    float d; /* 0 .. 1 */
    float q;
} cell_t;

static inline float within(const cell_t *c, int16_t value)
{
    const float low  = c->low[0][value] + (c->q * (c->low[1][value] - c->low[0][value]));
    const float high = c->high[0][value] + (c->q * (c->high[1][value] - c->high[0][value]));

    return low + (c->d * (high - low));
}

/* The cell of a place on an axis with `nodes` nodes, 0 .. nodes - 2. */
static inline int16_t cell_of(float place, int16_t nodes)
{
    const int16_t last = (int16_t)(nodes - 2);
    const int16_t at   = (int16_t)place;

    return (at < last) ? at : last;
}

/* EQ-IRON-2 from the slopes. */
static motor_reduced_t motor_of(const iron_map_t *map, const motor_reduced_t *plain, float ld,
                                float lq, float inv_both, float flux, float torque_flux)
{
    motor_reduced_t m;

    m.inv_l6 = lq;
    m.inv_l8 = ld;
    m.l6     = ld * inv_both;
    m.l8     = lq * inv_both;
    m.l1     = map->accel_per_WbA * torque_flux;
    m.l2     = plain->l2;
    m.l3     = plain->l3;
    m.l4     = map->rs_Ohm * m.l6;
    m.l5     = flux * m.l6;
    m.l7     = map->rs_Ohm * m.l8;
    m.l9     = lq * m.l8;
    m.l10    = ld * m.l6;
    m.l11    = map->accel_per_WbA * (ld - lq);
    return m;
}

iron_tangent_t iron_tangent(const iron_map_t *map, const motor_reduced_t *plain, float id_A,
                            float iq_A)
{
    const float   d = base_clamp(-id_A * map->nodes_per_A_d, 0.0f, (float)(IRON_NODES_D - 1));
    const float   q = base_clamp(fabsf(iq_A) * map->nodes_per_A_q, 0.0f, (float)(IRON_NODES_Q - 1));
    const int16_t i = cell_of(d, IRON_NODES_D);
    const int16_t j = cell_of(q, IRON_NODES_Q);
    const cell_t  c = {&map->node[i][j], &map->node[i + 1][j], d - (float)i, q - (float)j};

    const float mirror = (iq_A < 0.0f) ? -1.0f : 1.0f;
    const float ld     = within(&c, IRON_LD);
    const float lq     = within(&c, IRON_LQ);
    const float both   = ld * lq;

    iron_tangent_t t;
    t.id_A          = -d * map->A_per_node_d;
    t.iq_A          = mirror * q * map->A_per_node_q;
    t.psi_d_Wb      = within(&c, IRON_PSI_D);
    t.psi_q_Wb      = mirror * within(&c, IRON_PSI_Q);
    t.m_H           = mirror * within(&c, IRON_LDQ);
    const float det = both - (t.m_H * t.m_H);
    const float inv = fpu_inverse(both * det); /* one division for both reciprocals */

    t.inv_det_1pH2   = inv * both;
    const float flux = t.psi_d_Wb - (ld * t.id_A);
    t.motor          = motor_of(map, plain, ld, lq, inv * det, flux, flux + (t.m_H * t.iq_A));
    return t;
}

/* Derivatives of w, iq, id. */
typedef struct {
    float omega_dot_e_radps2;
    float iq_dot_Aps;
    float id_dot_Aps;
} iron_rate_t;

/* EQ-IRON-1 at (w, iq, id), with the disturbances of x. */
static iron_rate_t rates(const nodo_t *x, const iron_map_t *map, const iron_tangent_t *t, dq_t v_V,
                         float w, float iq, float id)
{
    const float d     = id - t->id_A;
    const float q     = iq - t->iq_A;
    const float psi_d = t->psi_d_Wb + (t->motor.inv_l8 * d) + (t->m_H * q);
    const float psi_q = t->psi_q_Wb + (t->motor.inv_l6 * q) + (t->m_H * d);
    const float e_d   = (v_V.d - (map->rs_Ohm * id)) + (w * psi_q);
    const float e_q   = (v_V.q - (map->rs_Ohm * iq)) - (w * psi_d);

    const iron_rate_t f = {
        .omega_dot_e_radps2 =
            (map->accel_per_WbA * ((psi_d * iq) - (psi_q * id))) - (t->motor.l2 * w) + x->d_omega,
        .iq_dot_Aps = (t->inv_det_1pH2 * ((t->motor.inv_l8 * e_q) - (t->m_H * e_d))) + x->d_q,
        .id_dot_Aps = (t->inv_det_1pH2 * ((t->motor.inv_l6 * e_d) - (t->m_H * e_q))) + x->d_d};
    return f;
}

void iron_predict(nodo_t *x, float *theta_rad, const iron_map_t *map, const iron_tangent_t *t,
                  dq_t v_V, float ts_s)
{
    const float       half_s = 0.5f * ts_s;
    const iron_rate_t f0     = rates(x, map, t, v_V, x->omega_e_radps, x->iq_A, x->id_A);
    const float       w      = x->omega_e_radps + (half_s * f0.omega_dot_e_radps2);
    const iron_rate_t f1     = rates(x, map, t, v_V, w, x->iq_A + (half_s * f0.iq_dot_Aps),
                                     x->id_A + (half_s * f0.id_dot_Aps));

    x->omega_e_radps += ts_s * f1.omega_dot_e_radps2;
    x->iq_A += ts_s * f1.iq_dot_Aps;
    x->id_A += ts_s * f1.id_dot_Aps;
    *theta_rad = frames_wrap(*theta_rad + (ts_s * w));
}

/* Products of four stay within the range of fpu_inverse(). Between nodes M^2 is at most 0.9 D Q
 * too, as the root of D Q is concave. */
static bool node_check(const float node[IRON_VALUES])
{
    const float ld = node[IRON_LD];
    const float lq = node[IRON_LQ];

    return check_finite(&node[IRON_PSI_D], 2) && base_in_range(ld, 1.0e-8f, 1.0e3f) &&
           base_in_range(lq, 1.0e-8f, 1.0e3f) &&
           base_within(node[IRON_LDQ] * node[IRON_LDQ], 0.9f * ld * lq);
}

bool iron_check(const iron_map_t *map)
{
    bool ok = check_positive(map->rs_Ohm) && check_positive(map->accel_per_WbA) &&
              base_in_range(map->nodes_per_A_d * map->A_per_node_d, 0.999f, 1.001f) &&
              base_in_range(map->nodes_per_A_q * map->A_per_node_q, 0.999f, 1.001f) &&
              check_positive(map->nodes_per_A_d) && check_positive(map->nodes_per_A_q);

    for (int16_t i = 0; i < IRON_NODES_D; i++) {
        for (int16_t j = 0; j < IRON_NODES_Q; j++) {
            ok = ok && node_check(map->node[i][j]);
        }
    }
    return ok;
}
