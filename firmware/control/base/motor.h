/* SPDX-License-Identifier: MIT */
/**
 * @file motor.h
 * @brief Reduced parameters of the motor model, paper A (2), with n_p = p/2 pole pairs.
 *
 *     l1 = 1.5 n_p^2 flux / J   l2 = B / J     l3 = n_p / J     l4 = Rs / Lq   l5 = flux / Lq
 *     l6 = 1 / Lq   l7 = Rs / Ld   l8 = 1 / Ld   l9 = Lq / Ld   l10 = Ld / Lq
 *     l11 = 1.5 n_p^2 (Ld - Lq) / J                                         EQ-MOTOR-1
 *
 * With electrical speed w, the model (4) is
 *
 *     w'  = l1 iq - l2 w + l11 id iq + d_w
 *     iq' = -l4 iq - l5 w - l10 w id + l6 vq + d_q
 *     id' = -l7 id + l9 w iq + l8 vd + d_d                                  EQ-MOTOR-2
 *
 * All values are computed by sdre-gains from the drive file; the core restates none of them.
 */
#ifndef MOTOR_H
#define MOTOR_H

#include "base.h"

typedef struct {
    float l1;     /**< [rad/s^2/A] */
    float l2;     /**< [1/s] */
    float l3;     /**< [rad/s^2/(N m)] */
    float l4;     /**< [1/s] */
    float l5;     /**< [A] */
    float l6;     /**< [1/H] */
    float l7;     /**< [1/s] */
    float l8;     /**< [1/H] */
    float l9;     /**< ratio */
    float l10;    /**< ratio */
    float l11;    /**< [rad/s^2/A^2]; negative for Ld < Lq, 0 for a surface magnet motor */
    float inv_l6; /**< 1 / l6 [H] */
    float inv_l8; /**< 1 / l8 [H] */
} motor_reduced_t;

/** true when every constant is finite and within its documented range. Context: init. */
bool motor_check(const motor_reduced_t *m);

#endif /* MOTOR_H */
