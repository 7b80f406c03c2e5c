/* SPDX-License-Identifier: MIT */
#include "nosc.h"

dq_t nosc_series_V(const nosc_gains_t *g, const nosc_error_t *e, float eiq_A)
{
    dq_t ke_V = {0.0f, 0.0f};
    bool even = ((uint16_t)g->order & 1U) == 0U;

    for (int16_t n = g->order; n >= 0; n--) { /* EQ-NOSC-2 */
        const dq_t term_V = even ? nosc_even_V(g->lambda[n], e) : nosc_odd_V(g->lambda[n], e);

        ke_V.d = (ke_V.d * eiq_A) + term_V.d;
        ke_V.q = (ke_V.q * eiq_A) + term_V.q;
        even   = !even;
    }

    const dq_t u_V = {.d = -ke_V.d, .q = -ke_V.q}; /* EQ-NOSC-1 */
    return u_V;
}
