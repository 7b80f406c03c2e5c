/* SPDX-License-Identifier: MIT */
/**
 * @file current_ref.h
 * @brief Current references: i_dsd by MTPA or flux weakening, i_qsd from the speed equation.
 *
 * With y = l10 (l7 id - d_d) / w and x = (l4 iq - d_q) / w, the voltage that holds a current is
 * l6 |v| / |w| = |(y - iq, l5 + l10 id + x)|, and it must stay below f = l6 v_max / |w|.
 *
 *     id_mtpa = (l10 - 1) / l5 iq^2                                         EQ-CURRENT-REF-1, paper A (7b)
 *     id_fw   = l9 (sqrt(f^2 - (iq - y)^2) - l5 - x)                        EQ-CURRENT-REF-2, (7b)
 *     id_ref  = min(id_mtpa, id_fw)                                         EQ-CURRENT-REF-3, (7a)
 *     iq_ref  = (l2 w_d + w_d' - d_w) / (l1 + l11 id)                       EQ-CURRENT-REF-4, (40)
 *     |iq_ref - y| <= sqrt(f^2 - (l5 + l10 id + x)^2)                       EQ-CURRENT-REF-5
 *
 * The iq on the right-hand sides is the reference of the previous period; EQ-CURRENT-REF-4 is (40) solved
 * for iq = iq_ref; the rated speed of (7a) is where the two curves meet. docs/errata.md has the reasons.
 */
#ifndef CURRENT_REF_H
#define CURRENT_REF_H

#include "base.h"
#include "motor.h"
#include "nodo.h"
#include "speed_ref.h"

typedef struct {
    float current_max_A; /**< radius of the current circle [A peak], > 0 */
    float iq_max_A;      /**< largest |iq| of EQ-CURRENT-REF-1 inside the circle [A], > 0 */
    float mtpa_gain_1pA; /**< (l10 - 1) / l5 [1/A], <= 0 */
    float voltage_share; /**< of the voltage circle that steady currents may need, (0, 1] */
    float l1_min;        /**< smallest denominator of EQ-CURRENT-REF-4 [rad/s^2/A], > 0 */
    float
        filter_per_period; /**< Ts / time constant of the id filter and of both derivatives, (0, 1] */
    float filter_1ps;      /**< 1 / that time constant [1/s], > 0 */
} current_ref_config_t;

typedef struct {
    dq_t  i_A;     /**< references */
    float iq_lo_A; /**< the q current may be commanded in iq_lo_A .. iq_hi_A now */
    float iq_hi_A;
    dq_t  i_dot_Aps; /**< their filtered derivatives */
    dq_t  filter_A;  /**< state of the filters */
} current_ref_t;

/** What the references are made of, all at this sampling instant. */
typedef struct {
    const nodo_t      *est;        /**< disturbance estimates */
    const nodo_meas_t *meas;       /**< measured speed and currents */
    float              iq_speed_A; /**< q current that the speed feedback asks for on top */
    float              v_max_V;    /**< radius of the voltage circle, > 0 */
} current_ref_input_t;

/** References, filters and derivatives start at zero current. */
void current_ref_reset(current_ref_t *r);

/**
 * @brief One period of EQ-CURRENT-REF-1 to 4.
 *
 * @param r   References, updated in place.
 * @param c   Limits and constants, checked at init.
 * @param m   Reduced parameters.
 * @param w   Speed reference and its derivative.
 * @param in  Measurements and estimates.
 *
 * Context: control ISR. One to three divisions, one square root.
 */
void current_ref_update(current_ref_t *r, const current_ref_config_t *c, const motor_reduced_t *m,
                        const speed_ref_t *w, const current_ref_input_t *in);

#endif /* CURRENT_REF_H */
