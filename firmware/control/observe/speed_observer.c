/* SPDX-License-Identifier: MIT */
#include "speed_observer.h"

#include "check.h"

bool speed_observer_check(const speed_observer_gains_t *g)
{
    return base_in_range(g->gain_w, 0.0f, 1.0f) && check_not_negative(g->gain_f_1ps);
}

static float accel_e_radps2(const motor_reduced_t *m, const nodo_meas_t *y)
{
    return (m->l1 + (m->l11 * y->id_A)) * y->iq_A; /* EQ-MOTOR-2 */
}

void speed_observer_reset(speed_observer_t *s, const motor_reduced_t *m, const nodo_meas_t *y)
{
    s->z_e_radps      = y->omega_e_radps;
    s->z_f_e_radps2   = 0.0f;
    s->accel_e_radps2 = accel_e_radps2(m, y);
}

void speed_observer_update(speed_observer_t *s, const speed_observer_gains_t *g,
                           const motor_reduced_t *m, const nodo_meas_t *y, float ts_s)
{
    const float a = accel_e_radps2(m, y);
    const float z_w =
        s->z_e_radps +
        (ts_s * (s->z_f_e_radps2 + (0.5f * (s->accel_e_radps2 + a)))); /* EQ-LADRC-1 */
    const float e = y->omega_e_radps - z_w;

    s->z_e_radps = z_w + (g->gain_w * e); /* EQ-LADRC-2 */
    s->z_f_e_radps2 += g->gain_f_1ps * e;
    s->accel_e_radps2 = a;
}
