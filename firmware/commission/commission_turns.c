/* SPDX-License-Identifier: MIT */
#include "commission_turns.h"

#include "commission_angle.h"

/* A rotor that follows moves equally in both directions, within SAME_WAY, and by LEAST_CNT or
 * more. */
#define SAME_WAY  0.1f
#define LEAST_CNT 20L

void commission_turns_add(commission_turns_t *u, const commission_vector_out_t *out,
                          const commission_result_t *known, float theta_rad, int32_t position_cnt,
                          bool shaft)
{
    if (!(u->n > 0.0f)) {
        u->from_cnt = position_cnt;
    }
    u->moved_cnt = commission_moved_cnt(position_cnt, u->from_cnt);
    u->e_V.d += out->v_V.d - (known->r_Ohm.value * out->i_A.d);
    u->e_V.q += out->v_V.q - (known->r_Ohm.value * out->i_A.q);
    u->i_A.d += out->i_A.d;
    u->i_A.q += out->i_A.q;
    if (shaft) {
        const float vector = theta_rad + commission_angle_of(out->i_A.q, out->i_A.d);
        const float turned = commission_angle_shaft_rad(known, position_cnt);
        const float angle  = frames_wrap(frames_wrap(vector - turned));
        if (!(u->n > 0.0f)) {
            u->angle0_rad = angle;
        }
        const float away = frames_wrap(angle - u->angle0_rad);
        u->angle_rad += away;
        u->angle2_rad2 += away * away;
    }
    u->n += 1.0f;
}

bool commission_turns_follow(const commission_turns_t turns[2])
{
    const float forward  = (float)turns[0].moved_cnt;
    const float backward = (float)turns[1].moved_cnt;

    return ((turns[0].moved_cnt > LEAST_CNT) || (turns[0].moved_cnt < -LEAST_CNT)) &&
           (fabsf(forward + backward) <= (SAME_WAY * fabsf(forward)));
}

float commission_turns_beyond_Wb(const commission_turns_t   turns[2],
                                 const commission_result_t *known, float speed_radps, float *i_A)
{
    float x      = 0.0f;
    float length = 0.0f;
    for (int16_t k = 0; k < 2; k++) {
        const commission_turns_t *u      = &turns[k];
        const float               per    = 1.0f / base_max(u->n, 1.0f);
        const float               w      = (k == 0) ? speed_radps : -speed_radps;
        const dq_t                i      = {u->i_A.d * per, u->i_A.q * per};
        const dq_t                lambda = {u->e_V.q * per / w, -u->e_V.d * per / w};
        const float               size   = base_max(sqrtf((i.d * i.d) + (i.q * i.q)), 1.0e-6f);
        x += 0.5f * ((((lambda.d * i.d) + (lambda.q * i.q)) / size) - (known->ld_H.value * size));
        length += 0.5f * size;
    }
    *i_A = length;
    return x;
}

void commission_turns_solve(const commission_turns_t turns[2], float speed_radps,
                            commission_result_t *found)
{
    const float whole  = (float)found->pole_pairs;
    float       spread = 0.0f;
    float       mean[2];

    for (int16_t k = 0; k < 2; k++) {
        const commission_turns_t *u   = &turns[k];
        const float               per = 1.0f / base_max(u->n, 1.0f);
        mean[k]                       = u->angle_rad * per;
        spread += 0.5f * base_max((u->angle2_rad2 * per) - (mean[k] * mean[k]), 0.0f);
    }
    /* EQ-COMMISSION-9; the vector is along d, or along q of a reluctance motor. */
    const float between =
        frames_wrap((turns[1].angle0_rad + mean[1]) - (turns[0].angle0_rad + mean[0]));
    const float middle      = turns[0].angle0_rad + mean[0] + (0.5f * between);
    const float vector      = found->reluctance ? (0.5f * BASE_PI) : 0.0f;
    found->offset_rad.value = frames_wrap(frames_wrap(middle - vector));
    found->lag_rad          = -0.5f * between;
    if (!found->reluctance) { /* at this larger current friction matters less */
        float i_A            = 0.0f;
        found->flux_Wb.value = commission_turns_beyond_Wb(turns, found, speed_radps, &i_A);
    }
    found->ripple_rad = sqrtf(spread);
    /* Chosen: a tenth of the lag and ripple, since their means cancel. */
    found->offset_rad.error = (0.1f * (fabsf(found->lag_rad) + found->ripple_rad)) +
                              (BASE_PI * whole / (float)found->counts_per_turn);
}
