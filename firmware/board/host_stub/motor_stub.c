/* SPDX-License-Identifier: MIT */
#include "motor_stub.h"

#include "frames.h"

/* Chosen: 10 us, three orders below the motor's time constants. */
#define STEPS 20

static frames_angle_t rotor(const motor_stub_t *m, uint16_t pole_pairs)
{
    return frames_angle((float)pole_pairs * m->theta_m_rad);
}

abc_t motor_stub_current_A(const motor_stub_t *m, uint16_t pole_pairs)
{
    const dq_t i_A = {.d = m->id_A, .q = m->iq_A};
    return frames_inverse_clarke(frames_inverse_park(i_A, rotor(m, pole_pairs)));
}

static void turn(motor_stub_t *m, const motor_reduced_t *l, uint16_t pole_pairs, float dt_s)
{
    const float torque = (l->l1 * m->iq_A) + (l->l11 * m->id_A * m->iq_A);

    m->omega_e_radps += dt_s * (torque - (l->l2 * m->omega_e_radps));
    m->theta_m_rad += dt_s * m->omega_e_radps / (float)pole_pairs;
    if (m->theta_m_rad >= BASE_TWO_PI) {
        m->theta_m_rad -= BASE_TWO_PI;
    } else if (m->theta_m_rad < 0.0f) {
        m->theta_m_rad += BASE_TWO_PI;
    } else {
        /* within the turn */
    }
}

void motor_stub_drive(motor_stub_t *m, const motor_reduced_t *l, uint16_t pole_pairs, abc_t v_V,
                      float ts_s)
{
    const float dt_s = ts_s / (float)STEPS;
    /* The star point has the mean of the three voltages. */
    const ab_t v_ab = {((2.0f * v_V.a) - v_V.b - v_V.c) / 3.0f, (v_V.b - v_V.c) * BASE_1_SQRT3};

    for (int16_t step = 0; step < STEPS; step++) {
        const dq_t  v  = frames_park(v_ab, rotor(m, pole_pairs));
        const float w  = m->omega_e_radps;
        const float iq = m->iq_A;
        const float id = m->id_A;

        m->iq_A += dt_s * ((l->l6 * v.q) - (l->l4 * iq) - (l->l5 * w) - (l->l10 * w * id));
        m->id_A += dt_s * ((l->l8 * v.d) - (l->l7 * id) + (l->l9 * w * iq));
        turn(m, l, pole_pairs, dt_s);
    }
}

void motor_stub_coast(motor_stub_t *m, const motor_reduced_t *l, uint16_t pole_pairs, float ts_s)
{
    m->iq_A = 0.0f;
    m->id_A = 0.0f;
    turn(m, l, pole_pairs, ts_s);
}
