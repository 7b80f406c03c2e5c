/* SPDX-License-Identifier: MIT */
/**
 * @file current_ref.h
 * @brief Current references: maximum torque per ampere, flux weakening, and the torque they leave.
 *
 *     iq_ref  = (l2 w_d + w_d' - d_w) / (l1 + l11 id),  iq_ref' = (w_d'' - d_w') / (l1 + l11 id)
 *                                                                    EQ-CURRENT-REF-1, paper A (40)
 *     id_mtpa = k - sqrt(k^2 + iq^2),  k = l5 / (2 (1 - l10))        EQ-CURRENT-REF-2, for (7b)
 *     (speed form: its second-order term -iq^2 / (2 k), as the paper prints it)
 *
 * Define y = l10 (l7 id - d_d) / w and x = (l4 iq - d_q) / w. The voltage that holds a current is
 *
 *     l6 |v| / |w| = |(y - iq, l5 + l10 id + x)|,  at most f = l6 v_max / |w|
 *
 *     id_fw   = l9 (sqrt(g^2 - (iq - y)^2) - l5 - x),  g = 0.965 f       EQ-CURRENT-REF-3, for (7b)
 *     beyond |iq - y| = c g:  id_fw = -l9 (l5 + x + min(s (|iq - y| - g), u)), s a chord's slope,
 *     u = (sqrt(k^2 + 2 g^2) - k) / 2 at maximum torque per volt         EQ-CURRENT-REF-4
 *     id_ref  = min(id_mtpa, id_fw)                                      EQ-CURRENT-REF-5, for (7a)
 *     |iq_ref - y| <= sqrt(f^2 - (l5 + l10 id + x)^2)                    EQ-CURRENT-REF-6
 *     iq_ref w (l1 + l11 id) >= -P(v_dc) / (J / np^2)                    EQ-CURRENT-REF-7
 *     id_ref <= id_rest, for a motor with a very weak magnet             EQ-CURRENT-REF-8
 *     id_ref goes there by a first-order filter, slower when it weakens  EQ-CURRENT-REF-9
 *     f of id_fw has v' = clamp(v_low, 0.8 v_max, v_max) for v_max,
 *     v_low(k+1) = v' + a (v_max - v')                                   EQ-CURRENT-REF-10
 *
 * The current circle is a further limit. Reasons: docs/errata.md.
 */
#ifndef CURRENT_REF_H
#define CURRENT_REF_H

#include "base.h"
#include "motor.h"
#include "nodo.h"
#include "speed_ref.h"

typedef struct {
    float current_max_A; /**< radius of the current circle [A peak], > 0 */
    float iq_max_A;      /**< |iq| where the MTPA curve meets the circle [A], > 0 */
    float mtpa_A;        /**< k of EQ-CURRENT-REF-2 [A], > 0; large without saliency */
    float mtpa_half_1pA; /**< 1 / (2 k) */
    bool  mtpa_exact;    /**< false: the second-order term only */
    float
        circle_ApVs; /**< l6 times the voltage for steady currents, per volt of the dc link, > 0 */
    float torque_share; /**< share of the available torque for the speed reference, (0, 1] */
    float near_e_radps; /**< speed error that requests the full current [rad/s], > 0 */
    float id_rest_A;    /**< d current without load [A], <= 0; 0 with a magnet of any strength */
    float flux_A;       /**< flux / Lq at which weakening begins at four times the speed [A], > 0 */
    float l1_min;       /**< smallest l1 + l11 id [rad/s^2/A], > 0 */
    float mtpa_per_period; /**< Ts / time constant of the id filter on the MTPA curve, (0, 1] */
    float weakening_per_period; /**< the same where id weakens the flux, (0, 1] */
    float chord_from; /**< share of the circle's q current from which a chord replaces it, 0 .. 1 */
    float chord_slope;      /**< of that chord, sqrt((1 + chord_from) / (1 - chord_from)), >= 0 */
    float samples_1ps;      /**< 1 / Ts [1/s], > 0 */
    float regen_max_W_norm; /**< np^2 / J times the largest power fed back to the dc link, >= 0 */
    float regen_start_V;    /**< dc link at which that power begins to fall, > 0 */
    float regen_per_V;      /**< its slope [1/V], > 0; no feedback above start + 1 / slope */
} current_ref_config_t;

typedef struct {
    dq_t  i_A;       /**< references */
    dq_t  i_dot_Aps; /**< their derivatives */
    float iq_lo_A;   /**< present range of the q current: iq_lo_A .. iq_hi_A */
    float iq_hi_A;
    float iq_circle_A; /**< |iq| that the current circle allows beside id */
    float v_low_Aps;   /**< v_low, the least v_max of the last periods */
} current_ref_t;

/** Inputs of the references, all of one instant. */
typedef struct {
    const nodo_t      *est;         /**< disturbance estimates */
    const nodo_meas_t *state;       /**< speed and currents */
    float              iq_speed_A;  /**< additional q current requested by the speed feedback */
    float              dc_link_V;   /**< measured dc link */
    float              v_max_Aps;   /**< l6 times the voltage for steady currents, > 0 */
    float              d_omega_dot; /**< d_w' [rad/s^3]; 0 when nothing is known of it */
    float              derating;    /**< unusable share of current_max_A, 0 .. 1 */
} current_ref_input_t;

/** true when every constant is finite and within its documented range. Context: init. */
CTL_PART bool current_ref_check(const current_ref_config_t *c);

/** Starts with zero references, derivatives and range. */
CTL_PART void current_ref_reset(current_ref_t *r, const current_ref_config_t *c);

/** Limits of acceleration and jerk for the speed reference. Context: control ISR. */
CTL_PART speed_ref_limits_t current_ref_speed_limits(const current_ref_t        *r,
                                                     const current_ref_config_t *c,
                                                     const motor_reduced_t      *m,
                                                     const current_ref_input_t  *in,
                                                     float                       command_e_radps);

/**
 * @brief Executes one period of EQ-CURRENT-REF-1 to 7.
 *
 * @param r   References, updated in place.
 * @param c   Limits and constants, checked at init.
 * @param m   Reduced parameters.
 * @param w   Speed reference and its derivatives.
 * @param in  State and estimates.
 *
 * Context: control ISR. Up to two divisions and four square roots.
 */
CTL_PART void current_ref_update(current_ref_t *r, const current_ref_config_t *c,
                                 const motor_reduced_t *m, const speed_ref_t *w,
                                 const current_ref_input_t *in);

#endif /* CURRENT_REF_H */
