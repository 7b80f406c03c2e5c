/* SPDX-License-Identifier: MIT */
#include "conventional.h"

#include "check.h"

enum { ROW_VQ, ROW_VD };
enum { ROW_D_OMEGA, ROW_D_Q, ROW_D_D, ROW_OMEGA, ROW_IQ, ROW_ID };

static double_series_point_t held(float iq_A, float id_A, float limit_A)
{
    const double_series_point_t at = {.s1 = base_clamp(iq_A, -limit_A, limit_A),
                                      .s2 = base_clamp(id_A, -limit_A, limit_A)};
    return at;
}

CTL_PART dq_t conventional_feedback_V(const conventional_gains_t *g, const motor_reduced_t *m,
                                      const nosc_error_t *e)
{
    const double_series_point_t at          = held(e->iq_A, e->id_A, g->i_error_max_A);
    const float                 x[NOSC_N_E] = {e->omega_e_radps, e->iq_A, e->id_A};
    const float                 q_product_V = m->inv_l6 * m->l10 * e->id_A * e->omega_e_radps;
    const float                 d_product_V = m->inv_l8 * m->l9 * e->iq_A * e->omega_e_radps;

    const dq_t u_V = {
        /* EQ-CONVENTIONAL-1, EQ-CONVENTIONAL-2 */
        .d = d_product_V - double_series_row(&g->lambda[ROW_VD], NOSC_N_U, g->nosc_order, at, x),
        .q = -q_product_V - double_series_row(&g->lambda[ROW_VQ], NOSC_N_U, g->nosc_order, at, x)};
    return u_V;
}

CTL_PART void conventional_update(nodo_t *x, const conventional_gains_t *g,
                                  const motor_reduced_t *m, const nodo_meas_t *y, dq_t v_V,
                                  float ts_s)
{
    const float w  = x->omega_e_radps;
    const float iq = x->iq_A;
    const float id = x->id_A;
    /* The clamp keeps the products of estimates in the range for which the held gain is
     * certified. */
    const double_series_point_t a           = held(iq, id, g->i_certified_A);
    const double_series_point_t at          = held(iq, id, g->i_max_A);
    const float                 r[NODO_N_Y] = {y->omega_e_radps - w, y->iq_A - iq, y->id_A - id};
    float                       slope[NODO_N_X];

    for (int16_t row = 0; row < NODO_N_X; row++) {
        slope[row] = double_series_row(&g->gain[row], NODO_N_X, g->nodo_order, at, r);
    }

    /* EQ-CONVENTIONAL-3 */
    const float w_p  = (m->l1 * iq) - (m->l2 * w) + (m->l11 * a.s1 * id) + x->d_omega;
    const float iq_p = (m->l6 * v_V.q) - (m->l4 * iq) - (m->l5 * w) - (m->l10 * a.s2 * w) + x->d_q;
    const float id_p = (m->l8 * v_V.d) - (m->l7 * id) + (m->l9 * a.s1 * w) + x->d_d;

    x->d_omega += ts_s * slope[ROW_D_OMEGA];
    x->d_q += ts_s * slope[ROW_D_Q];
    x->d_d += ts_s * slope[ROW_D_D];
    x->omega_e_radps += ts_s * (w_p + slope[ROW_OMEGA]);
    x->iq_A += ts_s * (iq_p + slope[ROW_IQ]);
    x->id_A += ts_s * (id_p + slope[ROW_ID]);
}

static bool order_ok(int16_t order)
{
    return (order >= 0) && (order <= DOUBLE_SERIES_ORDER_MAX);
}

static bool terms_ok(const float row[][DOUBLE_SERIES_COLUMNS], int16_t rows, int16_t order)
{
    return check_rows(row, (int16_t)(rows * (double_series_index(0, order) + 1)));
}

CTL_PART bool conventional_check(const conventional_gains_t *g)
{
    return order_ok(g->nosc_order) && order_ok(g->nodo_order) && check_positive(g->i_error_max_A) &&
           check_positive(g->i_max_A) &&
           base_in_range(g->i_certified_A, g->i_max_A, CHECK_LARGEST) &&
           terms_ok(g->lambda, NOSC_N_U, g->nosc_order) &&
           terms_ok(g->gain, NODO_N_X, g->nodo_order);
}
