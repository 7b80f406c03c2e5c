/* SPDX-License-Identifier: MIT */
#include "commission_angle.h"

/* Chosen: one count of a coarse encoder is 1 deg electrical and appears as a speed of 0.04 deg /
 * Ts. */
#define POLE_PER_TS 0.04f

/* Minimax fit on 0 .. 1. */
#define C0 0.99997722f
#define C1 -0.33262283f
#define C2 0.19354038f
#define C3 -0.11642648f
#define C4 0.05264734f
#define C5 -0.01171913f

float commission_angle_of(float y, float x)
{
    const float ax    = fabsf(x);
    const float ay    = fabsf(y);
    const float large = base_max(ax, ay);
    if (!(large > 0.0f)) {
        return 0.0f;
    }
    const float t      = base_min(ax, ay) / large;
    const float t2     = t * t;
    const float poly   = C0 + (t2 * (C1 + (t2 * (C2 + (t2 * (C3 + (t2 * (C4 + (t2 * C5)))))))));
    const float eighth = t * poly; /* EQ-COMMISSION-14 */
    const float first  = (ay > ax) ? ((0.5f * BASE_PI) - eighth) : eighth;
    const float upper  = (x < 0.0f) ? (BASE_PI - first) : first;
    return (y < 0.0f) ? -upper : upper;
}

float commission_angle_shaft_rad(const commission_result_t *known, int32_t position_cnt)
{
    const int32_t turn   = known->counts_per_turn;
    const int32_t within = position_cnt % turn;
    /* Integer modulo removes whole turns. No overflow up to 1e6 counts and 100 pole pairs. */
    const int32_t steps = (within * (int32_t)known->pole_pairs) % turn;
    const float   share = ((float)steps + (0.5f * (float)known->pole_pairs)) / (float)turn;
    const float   angle = (float)known->direction * BASE_TWO_PI * share; /* EQ-COMMISSION-7 */
    return frames_wrap(frames_wrap(angle));
}

float commission_angle_rad(const commission_result_t *known, int32_t position_cnt)
{
    return frames_wrap(commission_angle_shaft_rad(known, position_cnt) + known->offset_rad.value);
}

void commission_angle_start(commission_angle_t *a, float theta_rad)
{
    a->theta_rad      = theta_rad;
    a->omega_e_radps  = 0.0f;
    a->prompt_e_radps = 0.0f;
}

float commission_angle_tick(commission_angle_t *a, float theta_rad, float ts_s)
{
    const float ahead = frames_wrap(a->theta_rad + (ts_s * a->omega_e_radps));
    const float error = frames_wrap(theta_rad - ahead);
    a->theta_rad      = frames_wrap(ahead + (2.0f * POLE_PER_TS * error));
    a->omega_e_radps += (POLE_PER_TS * POLE_PER_TS / ts_s) * error;
    a->prompt_e_radps = a->omega_e_radps + ((2.0f * POLE_PER_TS / ts_s) * error);
    return a->omega_e_radps;
}
