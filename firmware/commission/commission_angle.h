/* SPDX-License-Identifier: MIT */
/**
 * @file commission_angle.h
 * @brief Electrical angle and speed from the encoder's count, once lines, pole pairs, direction and offset are known.
 *
 *     theta_e = direction n_p 2 pi (position + 1/2) / N + offset               EQ-COMMISSION-7
 *
 * The speed follows the angle by a loop of second order, critically damped, whose poles are at 0.04 / Ts.
 */
#ifndef COMMISSION_ANGLE_H
#define COMMISSION_ANGLE_H

#include "commission_types.h"

typedef struct {
    float theta_rad;      /**< followed, +-pi */
    float omega_e_radps;  /**< late by 50 periods of a steady acceleration */
    float prompt_e_radps; /**< not late, noisier */
} commission_angle_t;

/** EQ-COMMISSION-7 without the offset, +-pi. Context: control ISR. Two divisions. */
float commission_angle_shaft_rad(const commission_result_t *known, int32_t position_cnt);

/** EQ-COMMISSION-7, +-pi. */
float commission_angle_rad(const commission_result_t *known, int32_t position_cnt);

/**
 * @brief Angle of a vector, +-pi; 0 of none.
 *
 *     atan t = t (c_0 + c_1 t^2 + .. + c_5 t^10),  0 <= t <= 1, else by quadrants          EQ-COMMISSION-14
 *
 * Worst error 2e-6 rad; the same bits on every machine. One division.
 */
float commission_angle_of(float y, float x);

/** Standing here. */
void commission_angle_start(commission_angle_t *a, float theta_rad);

/** One period. @return electrical speed. */
float commission_angle_tick(commission_angle_t *a, float theta_rad, float ts_s);

#endif /* COMMISSION_ANGLE_H */
