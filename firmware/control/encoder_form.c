/* SPDX-License-Identifier: MIT */
#include "encoder_form.h"

#include "check.h"

bool encoder_form_check(const encoder_form_limits_t *limits)
{
    return base_in_range(limits->angle_rad, 1.0e-6f, BASE_PI) && check_positive(limits->d_omega);
}

near_optimal_view_t encoder_form_view(const encoder_form_limits_t *limits, const nodo_t *est,
                                      float theta_hat_rad, float angle_error_rad, float ts_s)
{
    const near_optimal_view_t view = {
        .est         = est,
        .now         = {.omega_e_radps = est->omega_e_radps, .iq_A = est->iq_A, .id_A = est->id_A},
        .d_omega_dot = 0.0f,
        .theta_rad   = theta_hat_rad + (0.5f * ts_s * est->omega_e_radps), /* EQ-DRIVE-2 */
        .plausible   = base_within(angle_error_rad, limits->angle_rad) &&
                     base_within(est->d_omega, limits->d_omega)};
    return view;
}
