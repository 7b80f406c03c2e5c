/* SPDX-License-Identifier: MIT */
#include "position_torque.h"

#include "fpu.h"

/* EQ-INERTIA-1, 2. */
static void learn_inertia(near_optimal_t *s, const position_gains_t *g, const motor_reduced_t *m,
                          const near_optimal_view_t *view)
{
    const nodo_meas_t   *now  = &view->now;
    const float          d    = view->est->d_omega;
    const inertia_seen_t seen = {.asked_e_radps2 = s->position_ref.omega_dot_e_radps2,
                                 .seen_e_radps2  = (now->iq_A * (m->l1 + (m->l11 * now->id_A))) -
                                                  (m->l2 * now->omega_e_radps) + d,
                                 .more_e_radps2 = d - s->position_ref.d_rest_e_radps2,
                                 .most_e_radps2 = g->most.accel_e_radps2};

    inertia_learn(&s->inertia, &seen);
}

position_torque_t position_torque(near_optimal_t *s, const near_optimal_config_t *c,
                                  const motor_reduced_t *m, const near_optimal_view_t *view)
{
    const current_ref_t *i = &s->current_ref;

    learn_inertia(s, &c->position, m, view);
    const position_torque_t torque = {.share = base_min(i->iq_hi_A, -i->iq_lo_A) *
                                               fpu_inverse(c->current_ref.iq_max_A),
                                      .d_omega = view->est->d_omega,
                                      .inertia = s->inertia.ratio};
    return torque;
}
