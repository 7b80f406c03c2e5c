/* SPDX-License-Identifier: MIT */
/**
 * @file svpwm.h
 * @brief Space vector modulation by centring the three phase voltages.
 *
 *     duty_x = 1/2 + (v_x - (max + min) / 2) / v_dc,   x = a, b, c             EQ-SVPWM-1
 *
 *     share  = v_dc / (max - min)                                             EQ-SVPWM-2
 *
 * It equals classic SVPWM with the zero time split equally. It is linear up to |v| = v_dc / sqrt(3)
 * in every direction. In the direction of v it is linear up to share |v|, the hexagon.
 */
#ifndef SVPWM_H
#define SVPWM_H

#include "base.h"

/**
 * @brief Duty ratios of the upper switches.
 *
 * @param v_V     Requested stator voltage.
 * @param v_dc_V  Measured dc-link voltage [V], > 0.
 * @return        Three ratios, in [0, 1] within the linear range; bridge_closed() limits them.
 *
 * Context: control ISR. One division.
 */
CTL_PART abc_t svpwm_duty(ab_t v_V, float v_dc_V);

/** Part of a vector that the inverter can produce. */
typedef struct {
    abc_t duty;  /**< duty ratios of share times the vector, in [0, 1] */
    float share; /**< EQ-SVPWM-2, at most 1 */
} svpwm_t;

/**
 * @brief Duty ratios of the part of a vector within the hexagon, and the share of it.
 *
 * At the hexagon v_dc cancels: one division gives both.
 *
 * Context: control ISR. One division.
 */
CTL_PART svpwm_t svpwm_within(ab_t v_V, float v_dc_V);

#endif /* SVPWM_H */
