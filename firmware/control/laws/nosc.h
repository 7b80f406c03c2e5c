/* SPDX-License-Identifier: MIT */
/**
 * @file nosc.h
 * @brief Near optimal speed controller: stator voltage fed back from the tracking error.
 *
 *     u_fb = -Lambda(e_iq) e                                          EQ-NOSC-1, paper A (26), (42)
 *     Lambda(e_iq) = Lambda_0 + Lambda_1 e_iq + ... + Lambda_N e_iq^N       EQ-NOSC-2
 *
 * sdre-gains generates all gains.
 */
#ifndef NOSC_H
#define NOSC_H

#include "base.h"

#define NOSC_ORDER_MAX 8  /**< highest power of e_iq a table can hold */
#define NOSC_TERMS     9U /**< of a series: NOSC_ORDER_MAX + 1 */
#define NOSC_N_U       2  /**< rows of Lambda_n: 0 = v_q, 1 = v_d */
#define NOSC_N_E       3  /**< columns of Lambda_n, in the order of nosc_error_t */

/** Tracking error e = measured - reference. Member order = column order of Lambda_n. */
typedef struct {
    float omega_e_radps; /**< electrical speed error */
    float iq_A;          /**< q-axis current error */
    float id_A;          /**< d-axis current error */
} nosc_error_t;

/** One motor's gains for one control period. */
typedef struct {
    int16_t order;             /**< N, 0 .. NOSC_ORDER_MAX */
    float   iq_error_max_A;    /**< certified for |e_iq| <= this; > 0 */
    float   iq_speed_max_A;    /**< limit of the q current requested by the speed error; > 0 */
    float   speed_A_per_radps; /**< k_w / k_iq of Lambda_0, EQ-NOSC-3; >= 0 */
    float   speed_radps_per_A; /**< k_iq / k_w; 0 if k_w is 0 */
    float   lambda[NOSC_ORDER_MAX + 1][NOSC_N_U][NOSC_N_E]; /**< Lambda_n; k_iq > 0 */
} nosc_gains_t;

/** True if the order is within the table. Context: control ISR. */
static inline bool nosc_order_ok(const nosc_gains_t *g)
{
    return (g->order >= 0) && (g->order <= NOSC_ORDER_MAX);
}

/** true when every constant is finite and within its documented range. Context: init. */
CTL_PART bool nosc_check(const nosc_gains_t *g);

/* Inline, because a call costs more than the arithmetic. */

/** k_iq of Lambda_0 [V/A]. */
static inline float nosc_current_gain(const nosc_gains_t *g)
{
    return g->lambda[0][0][1];
}

/**
 * @brief q current requested by the speed error, -(k_w / k_iq) e_w within +-iq_speed_max_A
 * (EQ-NOSC-3).
 *
 * Context: control ISR. No division.
 */
static inline float nosc_speed_current_A(const nosc_gains_t *g, float omega_error_e_radps)
{
    return base_clamp(-g->speed_A_per_radps * omega_error_e_radps, -g->iq_speed_max_A,
                      g->iq_speed_max_A);
}

/**
 * @brief Limits the speed part of the error, so that its requested q current stays in a range.
 *
 * Row v_q of EQ-NOSC-1 at n = 0 is -k_iq (iq - (iq_ref - (k_w / k_iq) e_w)): a current loop whose
 * command is the bracket. Limiting e_w limits that command and nothing else.           EQ-NOSC-3
 *
 * The command also stays within iq_speed_max_A of iq_ref. The voltage limits the slew rate of the
 * current, and larger requests would make the loop oscillate.
 *
 * @param g         Gains.
 * @param e         Tracking error.
 * @param iq_ref_A  q-current reference the error was formed with, in iq_lo_A .. iq_hi_A.
 * @param iq_lo_A   Lowest q current allowed now.
 * @param iq_hi_A   Highest q current allowed now.
 */
static inline nosc_error_t nosc_limit_speed_error(const nosc_gains_t *g, nosc_error_t e,
                                                  float iq_ref_A, float iq_lo_A, float iq_hi_A)
{
    const float lo_A = base_max(iq_ref_A - iq_hi_A, -g->iq_speed_max_A); /* EQ-NOSC-3 */
    const float hi_A = base_min(iq_ref_A - iq_lo_A, g->iq_speed_max_A);

    if (g->speed_radps_per_A > 0.0f) {
        e.omega_e_radps =
            base_clamp(e.omega_e_radps, g->speed_radps_per_A * lo_A, g->speed_radps_per_A * hi_A);
    }
    return e;
}

/** Lambda_n e of an even n, half of which is zero. */
static inline dq_t nosc_even_V(const float l[NOSC_N_U][NOSC_N_E], const nosc_error_t *e)
{
    const dq_t v_V = {l[1][2] * e->id_A, (l[0][0] * e->omega_e_radps) + (l[0][1] * e->iq_A)};
    return v_V;
}

/** Lambda_n e of an odd n. */
static inline dq_t nosc_odd_V(const float l[NOSC_N_U][NOSC_N_E], const nosc_error_t *e)
{
    const dq_t v_V = {(l[1][0] * e->omega_e_radps) + (l[1][1] * e->iq_A), l[0][2] * e->id_A};
    return v_V;
}

/**
 * @brief EQ-NOSC-1 of any order, by Horner on the vectors Lambda_n e: Lambda itself is never
 * formed.
 *
 * It is apart, because the shipped drives have order 2, and an image keeps it outside the fast
 * memory.
 *
 * @param eiq_A Error of the q current, limited.
 *
 * Context: control ISR.
 */
dq_t nosc_series_V(const nosc_gains_t *g, const nosc_error_t *e, float eiq_A);

/**
 * @brief Feedback voltage, EQ-NOSC-1.
 *
 * Beyond g->iq_error_max_A the gain keeps its boundary value, because the truncated series is
 * certified only up to there.
 *
 * The motor is symmetrical to the d axis, so half of every Lambda_n is zero. For even n, v_q
 * depends on speed and iq, and v_d depends on id. For odd n the rows are exchanged.
 *
 * Context: control ISR. Pure, no division, 5 (N+1) multiply-adds.
 */
CTL_PART dq_t nosc_feedback_V(const nosc_gains_t *g, const nosc_error_t *e);

#endif /* NOSC_H */
