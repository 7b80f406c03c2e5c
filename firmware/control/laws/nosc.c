/* SPDX-License-Identifier: MIT */
#include "nosc.h"

#include "check.h"

enum { ROW_Q = 0, ROW_D = 1, COLUMN_IQ = 1, COLUMN_ID = 2 };

/* EQ-NOSC-2 of order 2, and EQ-NOSC-1. */
static dq_t quadratic_V(const nosc_gains_t *g, const nosc_error_t *e, float eiq_A)
{
    const dq_t two_V = nosc_even_V(g->lambda[2], e);
    const dq_t one_V = nosc_odd_V(g->lambda[1], e);
    const dq_t ke_V  = nosc_even_V(g->lambda[0], e);
    const dq_t u_V   = {.d = -((((two_V.d * eiq_A) + one_V.d) * eiq_A) + ke_V.d),
                        .q = -((((two_V.q * eiq_A) + one_V.q) * eiq_A) + ke_V.q)};
    return u_V;
}

CTL_PART dq_t nosc_feedback_V(const nosc_gains_t *g, const nosc_error_t *e)
{
    const float eiq_A = base_clamp(e->iq_A, -g->iq_error_max_A, g->iq_error_max_A);

    return (g->order == 2) ? quadratic_V(g, e, eiq_A) : nosc_series_V(g, e, eiq_A);
}

/* True if the two quotients are reciprocal, or both zero. */
static bool quotients_ok(const nosc_gains_t *g)
{
    const float product = g->speed_A_per_radps * g->speed_radps_per_A;

    return check_not_negative(g->speed_A_per_radps) && check_not_negative(g->speed_radps_per_A) &&
           (base_in_range(product, 0.999f, 1.001f) ||
            ((g->speed_A_per_radps <= 0.0f) && (g->speed_radps_per_A <= 0.0f)));
}

CTL_PART bool nosc_check(const nosc_gains_t *g)
{
    const bool order_ok = (g->order >= 0) && (g->order <= NOSC_ORDER_MAX);
    bool       ok       = check_positive(g->iq_error_max_A) && check_positive(g->iq_speed_max_A) &&
              quotients_ok(g) && order_ok;

    for (int16_t n = 0; ok && (n <= g->order); n++) {
        const bool even = ((uint16_t)n & 1U) == 0U;
        ok              = check_rows(g->lambda[n], NOSC_N_U) &&
             check_parity(g->lambda[n][ROW_Q], COLUMN_ID, even) &&
             check_parity(g->lambda[n][ROW_D], COLUMN_ID, !even);
    }
    return ok && check_positive(g->lambda[0][ROW_Q][COLUMN_IQ]); /* the current loop's gain */
}
