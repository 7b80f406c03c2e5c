/* SPDX-License-Identifier: MIT */
#include "encoder_form.h"

#include "check.h"

bool encoder_form_check(const encoder_form_limits_t *limits)
{
    return base_in_range(limits->angle_rad, 1.0e-6f, BASE_PI) && check_positive(limits->d_omega);
}

bool encoder_form_gains_check(const encoder_form_gains_t *gains)
{
    return base_in_range(gains->theta, 1.0e-6f, 1.0f) && check_positive(gains->omega_1ps) &&
           check_positive(gains->d_omega_1ps2);
}

/* 2 would explain all of the error by the acceleration. Chosen by simulation of a load step at standstill: settled after
 * 17 ms with 0.2, after 7 ms with 0.5, after 9 ms and with more noise with 1. */
#define D_OMEGA_SHARE 0.5f

void encoder_form_correct_rare(nodo_t *est, float *theta_hat_rad, const encoder_form_gains_t *gains,
                               float error_rad, float gap_s, float ts_s)
{
    const float samples = gap_s / ts_s;
    const float per_s   = 1.0f / gap_s;
    const float theta   = base_min(gains->theta * samples, 1.0f);
    const float omega   = base_min(gains->omega_1ps * samples, per_s);
    const float d_omega = base_min(gains->d_omega_1ps2 * samples, D_OMEGA_SHARE * per_s * per_s);

    est->omega_e_radps += omega * error_rad;
    est->d_omega += d_omega * error_rad;
    *theta_hat_rad = frames_wrap(*theta_hat_rad + (theta * error_rad));
}
