/* SPDX-License-Identifier: MIT */
#include "nodo.h"

#include "check.h"

enum { COLUMN_ID = 2 };
enum { ROW_D_D = 2, ROW_ID = 5 };

void nodo_reset(nodo_t *x, const nodo_meas_t *y)
{
    x->d_omega       = 0.0f;
    x->d_q           = 0.0f;
    x->d_d           = 0.0f;
    x->omega_e_radps = y->omega_e_radps;
    x->iq_A          = y->iq_A;
    x->id_A          = y->id_A;
}

void nodo_update(nodo_t *x, const nodo_gains_t *g, const motor_reduced_t *m, const nodo_meas_t *y,
                 dq_t v_V, float ts_s)
{
    const float w    = x->omega_e_radps;
    const float iq   = x->iq_A;
    const float id   = x->id_A;
    const float iq_A = base_clamp(iq, -g->iq_max_A, g->iq_max_A);
    /* The clamp keeps the products of estimates in the range for which the held gain is
     * certified. */
    const float       iq_s = base_clamp(iq, -g->iq_certified_A, g->iq_certified_A);
    nodo_innovation_t r    = {.odd = {ts_s * (y->omega_e_radps - w), ts_s * (y->iq_A - iq)},
                              .id  = ts_s * (y->id_A - id)};

    /* EQ-NODO-1: the rows of A_d(iq^) x^ + u_d. */
    x->omega_e_radps += ts_s * ((m->l1 * iq) - (m->l2 * w) + (m->l11 * iq_s * id) + x->d_omega);
    x->iq_A += ts_s * ((m->l6 * v_V.q) - (m->l4 * iq) - (m->l5 * w) -
                       (m->l10 * y->id_A * y->omega_e_radps) + x->d_q);
    x->id_A += ts_s * ((m->l8 * v_V.d) - (m->l7 * id) + (m->l9 * iq_s * w) + x->d_d);

    /* EQ-NODO-2: L_n meets iq^^n Ts (y - C_d x^); L itself is never formed. */
    for (int16_t n = 0; n <= g->order; n = (int16_t)(n + 2)) {
        nodo_add_even(x, g->gain[n], COLUMN_ID, &r);
        if (n < g->order) {
            r = nodo_next_power(r, iq_A);
            nodo_add_odd(x, g->gain[n + 1], COLUMN_ID, &r);
            r = nodo_next_power(r, iq_A);
        }
    }
}

bool nodo_parity_check(const float (*l)[NODO_N_Y], int16_t rows, bool even, int16_t id_column)
{
    bool ok = true;

    for (int16_t row = 0; row < rows; row++) {
        const bool odd_state = (row != ROW_D_D) && (row != ROW_ID);
        ok                   = ok && check_parity(l[row], id_column, odd_state == even);
    }
    return ok;
}

bool nodo_check(const nodo_gains_t *g)
{
    const bool order_ok = (g->order >= 0) && (g->order <= NODO_ORDER_MAX);
    bool       ok       = check_positive(g->iq_max_A) &&
              base_in_range(g->iq_certified_A, g->iq_max_A, CHECK_LARGEST) && order_ok;

    for (int16_t n = 0; ok && (n <= g->order); n++) {
        ok = check_rows(g->gain[n], NODO_N_X) &&
             nodo_parity_check(g->gain[n], NODO_N_X, ((uint16_t)n & 1U) == 0U, COLUMN_ID);
    }
    return ok;
}
