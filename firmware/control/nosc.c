/* SPDX-License-Identifier: MIT */
#include "nosc.h"

#include "check.h"

enum { ROW_Q = 0, ROW_D = 1, COLUMN_OMEGA = 0, COLUMN_IQ = 1, COLUMN_ID = 2 };

static float row_times_error(const float row[NOSC_N_E], const nosc_error_t *e)
{
    return (row[COLUMN_OMEGA] * e->omega_e_radps) + (row[COLUMN_IQ] * e->iq_A) +
           (row[COLUMN_ID] * e->id_A);
}

float nosc_speed_current_A(const nosc_gains_t *g, float omega_error_e_radps)
{
    const float *row = g->lambda[0][ROW_Q];

    if (row[COLUMN_IQ] <= 0.0f) {
        return 0.0f;
    }
    return base_clamp(-(row[COLUMN_OMEGA] / row[COLUMN_IQ]) * omega_error_e_radps,
                      -g->iq_speed_max_A, g->iq_speed_max_A);
}

nosc_error_t nosc_limit_speed_error(const nosc_gains_t *g, nosc_error_t e, float iq_ref_A,
                                    float iq_lo_A, float iq_hi_A)
{
    const float *row    = g->lambda[0][ROW_Q];
    const float  scaled = row[COLUMN_OMEGA] * e.omega_e_radps; /* EQ-NOSC-3, times k_iq */
    const float  lo     = row[COLUMN_IQ] * base_max(iq_ref_A - iq_hi_A, -g->iq_speed_max_A);
    const float  hi     = row[COLUMN_IQ] * base_min(iq_ref_A - iq_lo_A, g->iq_speed_max_A);

    if (!base_in_range(scaled, lo, hi) && (row[COLUMN_OMEGA] > 0.0f)) {
        e.omega_e_radps = base_clamp(scaled, lo, hi) / row[COLUMN_OMEGA];
    }
    return e;
}

dq_t nosc_feedback_V(const nosc_gains_t *g, const nosc_error_t *e)
{
    const float eiq_A = base_clamp(e->iq_A, -g->iq_error_max_A, g->iq_error_max_A);
    dq_t        ke_V  = {0.0f, 0.0f};

    /* EQ-NOSC-2 by Horner on the vectors Lambda_n e: Lambda itself is never formed. */
    for (int16_t n = g->order; n >= 0; n--) {
        ke_V.q = (ke_V.q * eiq_A) + row_times_error(g->lambda[n][ROW_Q], e);
        ke_V.d = (ke_V.d * eiq_A) + row_times_error(g->lambda[n][ROW_D], e);
    }

    const dq_t u_V = {.d = -ke_V.d, .q = -ke_V.q}; /* EQ-NOSC-1 */
    return u_V;
}

bool nosc_check(const nosc_gains_t *g)
{
    const bool order_ok = (g->order >= 0) && (g->order <= NOSC_ORDER_MAX);
    bool ok = check_positive(g->iq_error_max_A) && check_positive(g->iq_speed_max_A) && order_ok;

    for (int16_t n = 0; ok && (n <= g->order); n++) {
        ok = check_rows(g->lambda[n], NOSC_N_U);
    }
    return ok && check_positive(g->lambda[0][ROW_Q][COLUMN_IQ]) /* EQ-NOSC-3 divides by it */;
}
