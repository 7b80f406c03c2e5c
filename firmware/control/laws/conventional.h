/* SPDX-License-Identifier: MIT */
/**
 * @file conventional.h
 * @brief Conventional near optimal control, paper A's reference for comparison.
 *
 * Both gains are series in two variables:
 *
 *     u_fb = -Lambda(e_iq, e_id) e                                          EQ-CONVENTIONAL-1
 *
 * Its error dynamics keep l11 e_iq e_id, l9 e_iq e_w and -l10 e_id e_w. Paper A cancels the last
 * two in the feed-forward. Here they stay, so the feed-forward contains them with the opposite
 * sign:
 *
 *     u_q: -l10 e_id e_w / l6,   u_d: +l9 e_iq e_w / l8                           EQ-CONVENTIONAL-2
 *
 *     x^' = A_d(iq^, id^) x^ + [0 0 0 0 l6 vq l8 vd]' + L(iq^, id^)(y - C_d x^)   EQ-CONVENTIONAL-3
 *
 * The states are those of nodo.h, and A_d contains the product -l10 id^ w^. The observer of the
 * load torque alone has zero rows for d_q and d_d, which stay zero. The page docs/errata.md lists
 * the points that paper A leaves open.
 */
#ifndef CONVENTIONAL_H
#define CONVENTIONAL_H

#include "base.h"
#include "double_series.h"
#include "motor.h"
#include "nodo.h"
#include "nosc.h"

/** Series in s1 = q-axis current, s2 = d-axis current; of the errors in lambda, of the estimates in
 * gain. */
typedef struct {
    int16_t nosc_order;    /**< N, 0 .. DOUBLE_SERIES_ORDER_MAX */
    float   i_error_max_A; /**< the series is used for |e_iq|, |e_id| <= this; > 0 */
    int16_t nodo_order;    /**< N_d, 0 .. DOUBLE_SERIES_ORDER_MAX */
    float   i_max_A;       /**< the series is used for |iq^|, |id^| <= this; > 0 */
    float   i_certified_A; /**< stable with the gain held for |iq^|, |id^| <= this; >= i_max_A */
    float   lambda[DOUBLE_SERIES_TERMS_MAX * NOSC_N_U]
                [NOSC_N_E];                                   /**< Lambda_nm, rows v_q, v_d each */
    float gain[DOUBLE_SERIES_TERMS_MAX * NODO_N_X][NODO_N_Y]; /**< L_nm, rows of nodo_t each */
} conventional_gains_t;

/** true when every constant is finite and within its documented range. Context: init. */
CTL_PART bool conventional_check(const conventional_gains_t *g);

/**
 * @brief Feedback voltage, EQ-CONVENTIONAL-1, and the products that the feed-forward must not
 * cancel, EQ-CONVENTIONAL-2.
 *
 * Beyond g->i_error_max_A the gain keeps its boundary value.
 *
 * Context: control ISR. Pure, no division, 4 (N+1)(N+2) + 2 N + 8 multiplications.
 */
CTL_PART dq_t conventional_feedback_V(const conventional_gains_t *g, const motor_reduced_t *m,
                                      const nosc_error_t *e);

/**
 * @brief One step of EQ-CONVENTIONAL-3 by explicit Euler, as nodo_update().
 *
 * Context: control ISR. No division, 12 (Nd+1)(Nd+2) + 6 Nd + 25 multiplications.
 */
CTL_PART void conventional_update(nodo_t *x, const conventional_gains_t *g,
                                  const motor_reduced_t *m, const nodo_meas_t *y, dq_t v_V,
                                  float ts_s);

#endif /* CONVENTIONAL_H */
