/* SPDX-License-Identifier: MIT */
/**
 * @file commission_vector.h
 * @brief A current vector of given length at a given angle of the stator, and whether the shaft stands.
 *
 *     v_along = k_p (I - i_along) + integral of k_i (I - i_along),  v_cross = -r_x i_cross     EQ-COMMISSION-3
 *     k_p = w_c L,  k_i = w_c k_p / 20,  w_c = 0.2 / Ts, L the smaller inductance
 *
 * Nothing holds the current across the vector but the resistance: what a rotor that swings about the vector induces there
 * brakes it. r_x adds to the resistance where that is too small beside the reactance of the larger inductance at the
 * frequency of the swing; the power taken from the swing is largest where both are equal. Beyond three tenths of the current
 * bound, what a rotor that snaps into place may induce, k_p holds the current across the vector back.
 */
#ifndef COMMISSION_VECTOR_H
#define COMMISSION_VECTOR_H

#include "commission_types.h"

typedef struct {
    float ts_s;
    float kp_VpA;
    float ki_VpA; /**< k_i Ts */
    float lq_H;
    float r_Ohm; /**< of the winding, 0 while it is unknown */
    float integral_V;
    float length_A; /**< present, follows the wanted one on a ramp */
    float ramp_A;   /**< per period */
    float cross_max_A;

    int32_t still_cnt; /**< position that the shaft has stayed at */
    int32_t still_ticks;
    int32_t extreme_cnt; /**< furthest of the present half swing */
    int32_t swing_ticks; /**< since the last reversal */
    int16_t way;         /**< 1, -1: the present half swing; 0 none yet */
    float   half_swing_s;
} commission_vector_t;

typedef struct {
    dq_t  i_A; /**< in the vector's frame: d along it */
    dq_t  v_V; /**< the same of the voltage in force before the sample */
    ab_t  out_V;
    float length_A;
} commission_vector_out_t;

/** Begin without current. @param ramp_s to the largest current. Context: control ISR. */
void commission_vector_start(commission_vector_t *v, const commission_config_t *c,
                             const commission_result_t *known, float ramp_s);

/**
 * @brief One period.
 *
 * @param angle         of the vector at this sample.
 * @param turned_rad    further angle at which the new voltage acts.
 * Context: control ISR. No division.
 */
commission_vector_out_t commission_vector_tick(commission_vector_t *v, const commission_signal_t *s,
                                               float theta_rad, float turned_rad, float length_A);

/** The shaft has not moved by more than one count for this long. */
bool commission_vector_still(const commission_vector_t *v, float time_s);

#endif /* COMMISSION_VECTOR_H */
