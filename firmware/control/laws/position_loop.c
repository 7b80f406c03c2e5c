/* SPDX-License-Identifier: MIT */
#include "position_loop.h"

#include "check.h"

bool position_loop_check(const position_gains_t *g)
{
    return nosc_check(&g->nosc) && check_finite(g->theta, (int16_t)NOSC_TERMS) &&
           check_positive(g->speed_per_rad) && check_positive(g->nosc.speed_A_per_radps) &&
           base_in_range(g->near_rad, 1.0e-6f, BASE_PI) && position_profile_is_any(&g->most);
}

dq_t position_loop_V(const position_gains_t *g, float theta_error_e_rad, float iq_error_A)
{
    const float eiq_A = base_clamp(iq_error_A, -g->nosc.iq_error_max_A, g->nosc.iq_error_max_A);
    dq_t        sum   = {0.0f, 0.0f};

    /* Horner: each factor e_iq changes the parity, so the v_q sum becomes a v_d sum. */
    for (int16_t n = g->nosc.order; n >= 0; n--) {
        const bool even = ((uint16_t)n & 1U) == 0U;
        sum.d           = (sum.d * eiq_A) + (even ? 0.0f : g->theta[n]);
        sum.q           = (sum.q * eiq_A) + (even ? g->theta[n] : 0.0f);
    }
    const dq_t u_V = {.d = -sum.d * theta_error_e_rad, .q = -sum.q * theta_error_e_rad};
    return u_V;
}
