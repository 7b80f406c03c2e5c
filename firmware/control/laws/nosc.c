/* SPDX-License-Identifier: MIT */
#include "nosc.h"

#include "check.h"

enum { ROW_Q = 0, ROW_D = 1, COLUMN_OMEGA = 0, COLUMN_IQ = 1, COLUMN_ID = 2 };

/* Contributions to a row: of speed and iq, and of id. */
static float of_speed_and_iq(const float row[NOSC_N_E], const nosc_error_t *e)
{
    return (row[COLUMN_OMEGA] * e->omega_e_radps) + (row[COLUMN_IQ] * e->iq_A);
}

static float of_id(const float row[NOSC_N_E], const nosc_error_t *e)
{
    return row[COLUMN_ID] * e->id_A;
}

/* A step of Horner: the sum so far times e_iq, and Lambda_n e of an even or odd n. */
static dq_t even_terms_V(dq_t sum_V, const float l[NOSC_N_U][NOSC_N_E], float eiq_A,
                         const nosc_error_t *e)
{
    const dq_t next_V = {.d = (sum_V.d * eiq_A) + of_id(l[ROW_D], e),
                         .q = (sum_V.q * eiq_A) + of_speed_and_iq(l[ROW_Q], e)};
    return next_V;
}

static dq_t odd_terms_V(dq_t sum_V, const float l[NOSC_N_U][NOSC_N_E], float eiq_A,
                        const nosc_error_t *e)
{
    const dq_t next_V = {.d = (sum_V.d * eiq_A) + of_speed_and_iq(l[ROW_D], e),
                         .q = (sum_V.q * eiq_A) + of_id(l[ROW_Q], e)};
    return next_V;
}

CTL_PART dq_t nosc_feedback_V(const nosc_gains_t *g, const nosc_error_t *e)
{
    const float eiq_A = base_clamp(e->iq_A, -g->iq_error_max_A, g->iq_error_max_A);
    int16_t     n     = g->order;
    dq_t        ke_V  = {0.0f, 0.0f};

    /* EQ-NOSC-2 by Horner on the vectors Lambda_n e: Lambda itself is never formed. An even n in every pass. */
    if (((uint16_t)n & 1U) != 0U) {
        ke_V = odd_terms_V(ke_V, g->lambda[n], eiq_A, e);
        n--;
    }
    ke_V = even_terms_V(ke_V, g->lambda[n], eiq_A, e);
    while (n >= 2) {
        ke_V = odd_terms_V(ke_V, g->lambda[n - 1], eiq_A, e);
        ke_V = even_terms_V(ke_V, g->lambda[n - 2], eiq_A, e);
        n    = (int16_t)(n - 2);
    }

    const dq_t u_V = {.d = -ke_V.d, .q = -ke_V.q}; /* EQ-NOSC-1 */
    return u_V;
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
