/* SPDX-License-Identifier: MIT */
#include "servo_law.h"

void servo_law_reset(servo_law_t *s, float hold_q_V)
{
    dobc_reset(&s->dobc);
    pid_law_reset(&s->pid, hold_q_V);
    pid_law_reset(&s->id_pi, 0.0f);
    s->direct_V = 0.0f;
}

dq_t servo_law_voltage_V(servo_law_t *s, const servo_law_config_t *c, const nodo_meas_t *y,
                         float command_e_radps)
{
    const float e_radps = command_e_radps - y->omega_e_radps;
    dq_t        u_V;

    u_V.d = pid_law_update(&s->id_pi, &c->id_pi, -y->id_A);
    if (c->kind == SERVO_LAW_DOBC) {
        s->direct_V = dobc_direct_V(&c->dobc, y->omega_e_radps, y->id_A);
        u_V.q       = s->direct_V + dobc_update(&s->dobc, &c->dobc, e_radps);
    } else {
        u_V.q = pid_law_update(&s->pid, &c->pid, e_radps);
    }
    return u_V;
}

void servo_law_realise(servo_law_t *s, const servo_law_config_t *c, dq_t v_V)
{
    pid_law_realise(&s->id_pi, &c->id_pi, v_V.d);
    if (c->kind == SERVO_LAW_DOBC) {
        dobc_realise(&s->dobc, v_V.q - s->direct_V);
    } else {
        pid_law_realise(&s->pid, &c->pid, v_V.q);
    }
}
