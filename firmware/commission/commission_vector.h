/* SPDX-License-Identifier: MIT */
/**
 * @file commission_vector.h
 * @brief Controls a current vector of given length and stator angle; detects a shaft at rest.
 *
 *     v_along = k_p (I - i_along) + integral of k_i (I - i_along),  v_cross = -r_x i_cross     EQ-COMMISSION-3
 *     k_p = w_c L,  k_i = w_c k_p / 20,  w_c = 0.2 / Ts, L the smaller inductance
 *
 * Only resistance limits the current across the vector. A rotor that oscillates about the vector
 * induces this current, and the current damps it. The damping power is largest where the resistance
 * equals the reactance of the larger inductance at the oscillation frequency. r_x adds the missing
 * resistance. Above three tenths of the current limit, k_p reduces the current across the vector: a
 * rotor that snaps into place may induce that much.
 */
#ifndef COMMISSION_VECTOR_H
#define COMMISSION_VECTOR_H

#include "commission_types.h"

typedef struct {
    float ts_s;
    float kp_VpA;
    float ki_VpA; /**< k_i Ts */
    float lq_H;
    float r_Ohm; /**< of the winding; 0: unknown */
    float integral_V;
    float length_A; /**< present reference, ramps to the commanded length */
    float ramp_A;   /**< per period */
    float cross_max_A;
    float error_max_A;  /**< the loop acts on this much at most */
    float damp_max_V;   /**< of the added resistance */
    float behind_share; /**< of a new value in behind_A */
    float behind_A;     /**< mean of reference less current */
    dq_t  stray_A;      /**< largest of a rotor at rest */
    dq_t  quick_A;      /**< reference less current, and current across: means of 16 periods */
    float mean_share;   /**< of a new value in mean_V */
    float mean_V;       /**< mean voltage along the vector, over 50 ms */
    float cross_A;      /**< mean current across it, over 50 ms */
    float brisk_share;  /**< of a new value in brisk_V */
    float brisk_V;      /**< the same over 20 ms */

    int32_t still_cnt; /**< position at which the shaft rests */
    int32_t still_ticks;
    int32_t extreme_cnt; /**< extreme position of the present half swing */
    int32_t swing_ticks; /**< since the last reversal */
    int16_t way;         /**< direction of the present half swing, 1, -1; 0: none yet */
    float   half_swing_s;
} commission_vector_t;

typedef struct {
    dq_t  i_A; /**< in the frame of the vector: d along it */
    dq_t  v_V; /**< voltage that acted before the sample, same frame */
    ab_t  out_V;
    float length_A;
} commission_vector_out_t;

/** Starts with zero current. @param ramp_s Ramp time to the current limit. Context: control ISR. */
void commission_vector_start(commission_vector_t *v, const commission_config_t *c,
                             const commission_result_t *known, float ramp_s);

/**
 * @brief Sets how far and how long the current may be away from its reference.
 *
 * @param error_A  The loop acts on this much of an error at most: a sensor that fails then raises
 *                 the voltage slowly.
 * @param damp_V   The added resistance takes this much at most: R of a current that may flow.
 * @param follow_s Time of the mean error, as commission_vector_follows() judges it.
 *
 * Context: control ISR, after commission_vector_start().
 */
void commission_vector_allow(commission_vector_t *v, float error_A, float damp_V, float follow_s);

/**
 * @brief Executes one period of the current control.
 *
 * @param theta_rad  Stator angle of the vector at this sample.
 * @param turned_rad Further angle of the vector when the new voltage acts.
 * @param length_A   Commanded length of the vector.
 *
 * Context: control ISR. One division.
 */
commission_vector_out_t commission_vector_tick(commission_vector_t *v, const commission_signal_t *s,
                                               float theta_rad, float turned_rad, float length_A);

/** False when the mean current is off its reference by more than `most_A`, or takes more than
 * `most_V`. A current sensor or a phase is then wrong. Context: control ISR. */
bool commission_vector_follows(const commission_vector_t *v, float most_A, float most_V);

/** False when the shaft stands and the mean voltage exceeds `most_V`: no motion explains it then.
 * Context: control ISR. */
bool commission_vector_stands(const commission_vector_t *v, float most_V);

/** True while the current is not that of a rotor at rest. It moves, or a sensor or phase is wrong.
 * Context: control ISR. */
bool commission_vector_strays(const commission_vector_t *v);

/** True if the shaft has stayed within one count for `time_s`. */
bool commission_vector_still(const commission_vector_t *v, float time_s);

#endif /* COMMISSION_VECTOR_H */
