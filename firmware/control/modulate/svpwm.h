/* SPDX-License-Identifier: MIT */
/**
 * @file svpwm.h
 * @brief Space vector modulation by centring the three phase voltages.
 *
 *     duty_x = 1/2 + (v_x - (max + min) / 2) / v_dc,   x = a, b, c             EQ-SVPWM-1
 *
 *     share  = v_dc / (max - min)                                             EQ-SVPWM-2
 *
 * Identical to classic SVPWM with the zero time split equally; linear up to |v| = v_dc / sqrt(3) in every
 * direction and up to share |v| in the direction of v: the hexagon.
 */
#ifndef SVPWM_H
#define SVPWM_H

#include "base.h"

/**
 * @brief Duty ratios of the upper switches.
 *
 * @param v_V     Wanted stator voltage.
 * @param v_dc_V  Measured dc-link voltage [V], > 0.
 * @return        Three ratios, in [0, 1] within the linear range; bridge_closed() limits them.
 *
 * Context: control ISR. One division.
 */
CTL_PART abc_t svpwm_duty(ab_t v_V, float v_dc_V);

/** What the inverter can produce of a vector. */
typedef struct {
    abc_t duty;  /**< of share times the vector, in [0, 1] */
    float share; /**< EQ-SVPWM-2, at most 1 */
} svpwm_t;

/**
 * @brief As svpwm_duty() for the part of a vector within the hexagon: there v_dc cancels, and one division makes both.
 *
 * Context: control ISR. One division.
 */
CTL_PART svpwm_t svpwm_within(ab_t v_V, float v_dc_V);

#endif /* SVPWM_H */
