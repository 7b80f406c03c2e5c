/* SPDX-License-Identifier: MIT */
#include "current_clamp.h"

#include "fpu.h"

/* Chosen: references reach the limit itself; noise and dead time stay inside this ratio. */
#define LIMIT_RATIO 1.03f
/* Chosen: data-sheet inductances ignore saturation and have tolerances of 20 to 30 %. */
#define INDUCTANCE_SHARE 0.7f
/* Correction of the previous period, which the prediction contains once with the nominal
 * inductance. */
#define BEFORE (1.0f - INDUCTANCE_SHARE)

CTL_PART dq_t current_clamp_V(const motor_reduced_t *m, const nodo_t *est, const nodo_meas_t *now,
                              dq_t v_V, dq_t v_0_V, float max_A, float samples_1ps)
{
    const float w     = now->omega_e_radps;
    const float iq    = now->iq_A;
    const float id    = now->id_A;
    const float scale = samples_1ps * INDUCTANCE_SHARE;
    /* Derivatives without voltage. */
    const float free_d = (m->l9 * w * iq) - (m->l7 * id) + est->d_d;
    const float free_q = est->d_q - (m->l4 * iq) - (w * (m->l5 + (m->l10 * id)));
    const float most_A = LIMIT_RATIO * max_A;
    /* scale times i+ */
    const float step_d =
        (scale * id) + (m->l8 * (v_V.d + (BEFORE * v_0_V.d))) + ((1.0f + BEFORE) * free_d);
    const float step_q =
        (scale * iq) + (m->l6 * (v_V.q + (BEFORE * v_0_V.q))) + ((1.0f + BEFORE) * free_q);
    const float step2 = (step_q * step_q) + (step_d * step_d);
    const float most  = scale * most_A;
    dq_t        out_V = v_V;

    if (step2 > (most * most)) { /* false of a NaN, which find_wrong() sees */
        const float short_of = (most * fpu_inverse_root(step2)) - 1.0f;
        out_V.q += m->inv_l6 * short_of * step_q;
        out_V.d += m->inv_l8 * short_of * step_d;
    }
    return out_V;
}
