/* SPDX-License-Identifier: MIT */
#include "fpu.h"
#include "laws.h"

static void scale_motor(motor_reduced_t *m, float inv)
{
    m->l1 *= inv;
    m->l2 *= inv;
    m->l3 *= inv;
    m->l11 *= inv;
}

static void scale_references(current_ref_config_t *c, float inv, float inv_root)
{
    c->l1_min *= inv;
    c->regen_max_W_norm *= inv;
    c->near_e_radps *= inv_root;
}

static void scale_feedback(nosc_gains_t *g, float root, float inv_root)
{
    g->speed_A_per_radps *= root;
    g->speed_radps_per_A *= inv_root;
    for (uint16_t n = 0U; n < NOSC_TERMS; n++) {
        g->lambda[n][0][0] *= root;
        g->lambda[n][1][0] *= root;
    }
}

static void scale_observer(law_noc_config_t *c, float inv_root)
{
    for (uint16_t n = 0U; n <= (uint16_t)NODO_ORDER_MAX; n++) {
        for (uint16_t j = 0U; j < (uint16_t)NODO_ENCODER_N_Y; j++) {
            c->nodo.gain[n][0][j] *= inv_root; /* d_w */
        }
    }
    c->rare.d_omega_1ps2 *= inv_root;
}

float law_noc_believe(drive_config_t *to, void *constants, const drive_config_t *from, float ratio)
{
    const law_noc_config_t *own  = from->constants;
    law_noc_config_t       *c    = constants;
    const float             k    = base_clamp(ratio, own->inertia.least, own->inertia.most);
    const float             inv  = fpu_inverse(k);
    const float             root = fpu_root(k);

    *c            = *own;
    *to           = *from;
    to->constants = c;
    to->positions = false;
    scale_motor(&to->motor, inv);
    scale_references(&c->near_optimal.current_ref, inv, inv * root);
    scale_feedback(&c->near_optimal.nosc, root, inv * root);
    scale_observer(c, inv * root);
    return k;
}

static float modelled_e_radps2(const motor_reduced_t *m, const nodo_t *x)
{
    return (x->iq_A * (m->l1 + (m->l11 * x->id_A))) - (m->l2 * x->omega_e_radps);
}

void law_noc_adopt(law_state_t *state, const drive_config_t *from, const drive_config_t *to)
{
    nodo_t *x = &state->noc.observer;

    x->d_omega += modelled_e_radps2(&from->motor, x) - modelled_e_radps2(&to->motor, x);
}
