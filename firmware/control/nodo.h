/* SPDX-License-Identifier: MIT */
/**
 * @file nodo.h
 * @brief Near optimal disturbance observer, paper A (31), explicit Euler at the control period.
 *
 *     x^ = [d_w d_q d_d | w iq id]^
 *     x^' = A_d(iq^) x^ + u_d + L(iq^) (y - C_d x^),   y = [w iq id] measured      EQ-NODO-1
 *     L(iq^) = L_0 + L_1 iq^ + ... + L_Nd iq^Nd                                    EQ-NODO-2, (39)
 *
 * A_d holds EQ-MOTOR-2 with the product terms l11 iq^ id^ and l9 iq^ w^; u_d carries
 * -l10 id w + l6 vq and l8 vd with the voltage really applied, (27).
 */
#ifndef NODO_H
#define NODO_H

#include "base.h"
#include "motor.h"

#define NODO_ORDER_MAX 8 /**< highest power of iq^ a table can hold */
#define NODO_N_X       6 /**< rows of L_n, in the order of nodo_t */
#define NODO_N_Y       3 /**< columns of L_n: measured speed, iq, id */

typedef struct {
    int16_t order;          /**< N_d, 0 .. NODO_ORDER_MAX */
    float   iq_max_A;       /**< the series is used for |iq^| <= this; > 0 */
    float   iq_certified_A; /**< stable with the gain held for |iq^| <= this; >= iq_max_A */
    float   gain[NODO_ORDER_MAX + 1][NODO_N_X][NODO_N_Y]; /**< L_n, n <= order */
} nodo_gains_t;

/** What the observer measures. */
typedef struct {
    float omega_e_radps;
    float iq_A;
    float id_A;
} nodo_meas_t;

/** Estimates. */
typedef struct {
    float d_omega;       /**< disturbance of the speed equation [rad/s^2] */
    float d_q;           /**< disturbance of the iq equation [A/s] */
    float d_d;           /**< disturbance of the id equation [A/s] */
    float omega_e_radps; /**< electrical speed */
    float iq_A;
    float id_A;
} nodo_t;

/** Adds L_n r to the estimates; l holds at least the rows of nodo_t. Inline: the heart of both observers. */
static inline void nodo_add_correction(nodo_t     *x, const float (*l)[NODO_N_Y],
                                       const float r[NODO_N_Y])
{
    x->d_omega += (l[0][0] * r[0]) + (l[0][1] * r[1]) + (l[0][2] * r[2]);
    x->d_q += (l[1][0] * r[0]) + (l[1][1] * r[1]) + (l[1][2] * r[2]);
    x->d_d += (l[2][0] * r[0]) + (l[2][1] * r[1]) + (l[2][2] * r[2]);
    x->omega_e_radps += (l[3][0] * r[0]) + (l[3][1] * r[1]) + (l[3][2] * r[2]);
    x->iq_A += (l[4][0] * r[0]) + (l[4][1] * r[1]) + (l[4][2] * r[2]);
    x->id_A += (l[5][0] * r[0]) + (l[5][1] * r[1]) + (l[5][2] * r[2]);
}

/** true when every constant is finite and within its documented range. Context: init. */
bool nodo_check(const nodo_gains_t *g);

/** Estimates start at the measurement, disturbances at zero. */
void nodo_reset(nodo_t *x, const nodo_meas_t *y);

/**
 * @brief One step: corrects with y and advances to the next sampling instant.
 *
 * L is evaluated at iq^ clamped to +-g->iq_max_A, A_d at iq^ clamped to +-g->iq_certified_A.
 *
 * @param x     Estimates, advanced in place.
 * @param g     Gains.
 * @param m     Reduced parameters the gains were made for.
 * @param y     Measurement at this instant.
 * @param v_V   Voltage in force during the coming period (after every limit).
 * @param ts_s  Control period [s].
 *
 * Context: control ISR. No division, 21 (Nd+1) + 18 multiplications.
 */
void nodo_update(nodo_t *x, const nodo_gains_t *g, const motor_reduced_t *m, const nodo_meas_t *y,
                 dq_t v_V, float ts_s);

#endif /* NODO_H */
