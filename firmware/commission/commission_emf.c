/* SPDX-License-Identifier: MIT */
#include "commission_emf.h"

#include "commission_angle.h"

/* Systematic error that the scatter of one run does not show; six motors, docs/commissioning.md. */
#define SYSTEMATIC 0.005f
/* A back-EMF below this share of the dc link does not show the magnet's direction. */
#define EMF_SHARE 0.03f

void commission_emf_add(commission_emf_t e[2], const commission_result_t *known,
                        float omega_e_radps, dq_t v_V, dq_t i_A)
{
    const float       w  = omega_e_radps;
    commission_emf_t *s  = &e[(w > 0.0f) ? 0 : 1];
    const float       vd = v_V.d - (known->r_Ohm.value * i_A.d) + (w * known->lq_H.value * i_A.q);
    const float       vq = v_V.q - (known->r_Ohm.value * i_A.q) - (w * known->ld_H.value * i_A.d);
    s->vd_w += vd * w;
    s->vq_w += vq * w;
    s->ww += w * w;
    s->vv += vq * vq;
    s->n += 1.0f;
}

/* EQ-COMMISSION-12, 13 */
void commission_emf_solve(const commission_emf_t e[2], float top_radps, float dc_link_V,
                          commission_result_t *found)
{
    const commission_emf_t *f      = &e[0];
    const commission_emf_t *b      = &e[1];
    const float             ww     = base_max(f->ww + b->ww, 1.0e-9f);
    const float             flux   = (f->vq_w + b->vq_w) / ww;
    const float             ahead  = f->vq_w / base_max(f->ww, 1.0e-9f);
    const float             behind = b->vq_w / base_max(b->ww, 1.0e-9f);
    const float             rest   = base_max((f->vv + b->vv) - (flux * (f->vq_w + b->vq_w)), 0.0f);
    const bool seen = base_max(fabsf(flux) * top_radps, 0.0f) > (EMF_SHARE * dc_link_V);

    found->flux_Wb.value = seen ? flux : base_max(flux, 0.0f);
    found->flux_Wb.error = (2.0f * sqrtf(rest / ((f->n + b->n + 1.0f) * ww))) +
                           (0.5f * fabsf(ahead - behind)) + (SYSTEMATIC * fabsf(flux));
    found->moved_rad = 0.0f;
    if (seen && (f->n > 0.0f) && (b->n > 0.0f)) {
        const float one         = commission_angle_of(f->vd_w, f->vq_w);
        const float apart       = frames_wrap(commission_angle_of(b->vd_w, b->vq_w) - one);
        found->moved_rad        = frames_wrap(one + (0.5f * apart));
        found->offset_rad.value = frames_wrap(found->offset_rad.value - found->moved_rad);
        found->offset_rad.error = (0.1f * fabsf(apart)) + (BASE_PI * (float)found->pole_pairs /
                                                           (float)found->counts_per_turn);
        found->flux_Wb.value    = fabsf(flux);
    }
}
