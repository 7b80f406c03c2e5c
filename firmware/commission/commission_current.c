/* SPDX-License-Identifier: MIT */
#include "commission_current.h"

#define INTEGRAL_SHARE 0.1f

dq_t commission_current_of(const commission_result_t *known, float size_A, float sign)
{
    const dq_t magnet     = {0.0f, sign * size_A};
    const dq_t reluctance = {-0.707f * size_A, 0.707f * sign * size_A};
    return known->reluctance ? reluctance : magnet;
}

dq_t commission_current_V(dq_t *integral_V, const commission_config_t *c,
                          const commission_result_t *known, const commission_current_t *now)
{
    const float w_radps = COMMISSION_CURRENT_BANDWIDTH / c->ts_s;
    const float ki      = INTEGRAL_SHARE * w_radps * c->ts_s * w_radps;
    const float w       = now->omega_e_radps;
    const float limit_V = now->limit_V;
    const dq_t  error_A = {now->ref_A.d - now->i_A.d, now->ref_A.q - now->i_A.q};

    integral_V->d =
        base_clamp(integral_V->d + (ki * known->ld_H.value * error_A.d), -limit_V, limit_V);
    integral_V->q =
        base_clamp(integral_V->q + (ki * known->lq_H.value * error_A.q), -limit_V, limit_V);
    const dq_t v_V = {(w_radps * known->ld_H.value * error_A.d) + integral_V->d -
                          (w * known->lq_H.value * now->i_A.q),
                      (w_radps * known->lq_H.value * error_A.q) + integral_V->q +
                          (w * ((known->ld_H.value * now->i_A.d) + known->flux_Wb.value))};
    return v_V;
}
