/* SPDX-License-Identifier: MIT */
#include "sil/eval/pi_foc_tick.h"

#include <math.h>

#include "frames.h"
#include "svpwm.h"

void pi_foc_init(pi_foc_t *c, const pi_foc_gains_t *gains)
{
    c->gains       = *gains;
    c->speed_sum_A = 0.0f;
    c->d_sum_V     = 0.0f;
    c->q_sum_V     = 0.0f;
}

/* One PI; the sum takes back what the limit cut off. */
static float pi_step(float error, float p, float i, float limit, float *sum)
{
    const float wanted  = (p * error) + *sum;
    const float limited = base_clamp(wanted, -limit, limit);
    *sum += (i * error) + (limited - wanted);
    return limited;
}

bridge_t pi_foc_tick(pi_foc_t *c, const drive_sample_t *s, const drive_command_t *command)
{
    const pi_foc_gains_t *g = &c->gains;
    const dq_t i = frames_park(frames_clarke(s->ia_A, s->ib_A), frames_angle(s->theta_e_rad));

    const float v_max_V = s->dc_link_V * BASE_1_SQRT3;
    const float iq_ref  = pi_step(command->omega_e_radps - s->omega_e_radps, g->speed_p, g->speed_i,
                                  g->current_max_A, &c->speed_sum_A);
    const float v_d     = pi_step(0.0f - i.d, g->d_p, g->d_i, v_max_V, &c->d_sum_V);
    const float q_max_V = sqrtf((v_max_V * v_max_V) - (v_d * v_d)); /* the d axis comes first */
    const float v_q     = pi_step(iq_ref - i.q, g->q_p, g->q_i, q_max_V, &c->q_sum_V);

    const float theta = s->theta_e_rad + (1.5f * g->ts_s * s->omega_e_radps); /* as EQ-DRIVE-2 */
    const dq_t  v_V   = {.d = v_d, .q = v_q};
    return bridge_closed(svpwm_duty(frames_inverse_park(v_V, frames_angle(theta)), s->dc_link_V));
}
