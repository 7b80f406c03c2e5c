/* SPDX-License-Identifier: MIT */
/**
 * @file nodo_encoder.h
 * @brief Disturbance observer with the encoder angle as its measurement.
 *
 *     x^ = [d_w d_q d_d | w iq id | theta]^,   y = [iq id theta] measured
 *     correction:  x^+ = x^- + Ts L(iq^-) (y - C x^-)                            EQ-NODO-ENCODER-1
 *     prediction:  x^-(k+1) = x^+ + Ts f(x^+ + Ts/2 f(x^+, v), v)                EQ-NODO-ENCODER-2
 *     L(iq^) = L_0 + L_1 iq^ + ... + L_Nd iq^Nd                                  EQ-NODO-ENCODER-3
 *
 * f is EQ-MOTOR-2 with constant disturbances and theta' = w. The prediction covers the computing
 * delay: a law that uses it acts on the state at the instant its voltage takes effect.
 */
#ifndef NODO_ENCODER_H
#define NODO_ENCODER_H

#include "base.h"
#include "frames.h"
#include "motor.h"
#include "nodo.h"

#define NODO_ENCODER_N_X 7 /**< rows of L_n: nodo_t, then theta */
#define NODO_ENCODER_N_Y 3 /**< columns of L_n: measured iq, id, theta */

typedef struct {
    int16_t order;    /**< N_d, 0 .. NODO_ORDER_MAX */
    float   iq_max_A; /**< the series is used for |iq^| <= this; > 0 */
    float   gain[NODO_ORDER_MAX + 1][NODO_ENCODER_N_X][NODO_ENCODER_N_Y]; /**< L_n, n <= order */
} nodo_encoder_gains_t;

/** true when every constant is finite and within its documented range. Context: init. */
CTL_PART bool nodo_encoder_check(const nodo_encoder_gains_t *g);

/**
 * @brief EQ-NODO-ENCODER-1.
 *
 * @param x           Estimates of this instant, corrected in place; angle stays within +-pi.
 * @param theta_rad   Estimate of the electrical angle, corrected in place.
 * @param g           Gains.
 * @param i_A         Measured current in the frame of the estimated angle.
 * @param angle_error Measured minus estimated angle [rad], within +-pi.
 * @param ts_s        Control period [s].
 *
 * Context: control ISR. No division, 15 (Nd+1) + 3 multiplications at most.
 */
CTL_PART void nodo_encoder_correct(nodo_t *x, float *theta_rad, const nodo_encoder_gains_t *g,
                                   dq_t i_A, float angle_error, float ts_s);

/**
 * @brief EQ-NODO-ENCODER-3 of any order: adds L_n r iq^n to the estimates.
 *
 * It is apart, because the shipped drives have order 1, and an image keeps it outside the fast
 * memory.
 *
 * @param r Ts times the innovation.
 *
 * Context: control ISR.
 */
void nodo_encoder_add_series(nodo_t *x, float *theta, const nodo_encoder_gains_t *g,
                             const nodo_innovation_t *r, float iq_A);

/**
 * @brief Predicts one period with the voltage that acts, EQ-NODO-ENCODER-2.
 *
 * Context: control ISR. No division, 28 multiplications.
 */
CTL_PART void nodo_encoder_predict(nodo_t *x, float *theta_rad, const motor_reduced_t *m, dq_t v_V,
                                   float ts_s);

#endif /* NODO_ENCODER_H */
