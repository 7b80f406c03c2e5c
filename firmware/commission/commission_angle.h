/* SPDX-License-Identifier: MIT */
/**
 * @file commission_angle.h
 * @brief Electrical angle and speed from the encoder count.
 *
 * Counts per turn, pole pairs, direction and offset must be known.
 *
 *     theta_e = direction n_p 2 pi (position + 1/2) / N + offset               EQ-COMMISSION-7
 *
 * A critically damped second-order loop tracks the angle and gives the speed. Its poles: 0.04 / Ts.
 */
#ifndef COMMISSION_ANGLE_H
#define COMMISSION_ANGLE_H

#include "commission_types.h"

typedef struct {
    float theta_rad;      /**< tracked angle, +-pi */
    float omega_e_radps;  /**< lags a constant acceleration by 50 periods */
    float prompt_e_radps; /**< without this lag, with more noise */
} commission_angle_t;

/** EQ-COMMISSION-7 without the offset, +-pi. Context: control ISR. Two divisions. */
float commission_angle_shaft_rad(const commission_result_t *known, int32_t position_cnt);

/** EQ-COMMISSION-7, +-pi. */
float commission_angle_rad(const commission_result_t *known, int32_t position_cnt);

/**
 * @brief Angle of the vector (x, y), +-pi; 0 for the zero vector.
 *
 *     atan t = t (c_0 + c_1 t^2 + .. + c_5 t^10),  0 <= t <= 1, else by quadrants          EQ-COMMISSION-14
 *
 * Worst error 2e-6 rad. The result is bit-identical on every machine. One division.
 */
float commission_angle_of(float y, float x);

/** Starts at rest at this angle. */
void commission_angle_start(commission_angle_t *a, float theta_rad);

/** Tracks the angle for one period. @return electrical speed [rad/s]. Context: control ISR. */
float commission_angle_tick(commission_angle_t *a, float theta_rad, float ts_s);

#endif /* COMMISSION_ANGLE_H */
