/* SPDX-License-Identifier: MIT */
/**
 * @file encoder_form.h
 * @brief What the laws that observe the angle share: innovation, plausibility, view of the prediction.
 */
#ifndef ENCODER_FORM_H
#define ENCODER_FORM_H

#include "base.h"
#include "frames.h"
#include "near_optimal.h"
#include "sample.h"

typedef struct {
    float angle_rad; /**< an angle this far from its estimate cannot be right, (0, pi] */
    float d_omega;   /**< an estimated speed disturbance beyond this is no load but a wrong angle
                          [rad/s^2], > 0 */
} encoder_form_limits_t;

/** true when both are in range. Context: init. */
bool encoder_form_check(const encoder_form_limits_t *limits);

/**
 * @brief Measured minus estimated angle, within +-pi; less the band in which the sample does not know better.
 *
 *     e = wrap(theta - theta^) - clamp(wrap(theta - theta^), -band, band)          EQ-ENCODER-FORM-1
 *
 * Context: control ISR.
 */
static inline float encoder_form_error_rad(const drive_sample_t *s, float theta_hat_rad)
{
    const float error = frames_wrap(s->theta_e_rad - theta_hat_rad);
    return error - base_clamp(error, -s->band_rad, s->band_rad);
}

/**
 * @brief The prediction as the law sees it.
 *
 * A standing angle looks like a load that no motor could carry.
 *
 * @param limits          Of plausibility.
 * @param est             Predicted; must outlive the view.
 * @param theta_hat_rad   Predicted.
 * @param angle_error_rad Of this sample.
 * @param ts_s            Control period [s].
 *
 * Context: control ISR.
 */
near_optimal_view_t encoder_form_view(const encoder_form_limits_t *limits, const nodo_t *est,
                                      float theta_hat_rad, float angle_error_rad, float ts_s);

#endif /* ENCODER_FORM_H */
