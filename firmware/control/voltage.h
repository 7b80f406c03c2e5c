/* SPDX-License-Identifier: MIT */
/**
 * @file voltage.h
 * @brief Voltage limit on the vector: which axis gives way.
 *
 * When the wanted vector leaves the circle, most of the q voltage that holds the q current is covered
 * first, then the d axis gets what it wants, then the q axis what is left:
 *
 *     keep = min(0.9 |hold_q|, 0.9 v_max, |u_q|)
 *     v_d  = clamp(u_d, +-sqrt(v_max^2 - keep^2)),  v_q = clamp(u_q, +-sqrt(v_max^2 - v_d^2))   EQ-VOLTAGE-1
 *
 * The d axis comes before the rest because only a d current can make room again at high speed; it does not
 * come before the back-EMF because the q current would run away.
 */
#ifndef VOLTAGE_H
#define VOLTAGE_H

#include "base.h"
#include "drive_config.h"
#include "frames.h"

/**
 * @param v_V      Wanted voltage; a NaN comes out as a vector inside the circle.
 * @param hold_q_V q voltage that keeps the q current where it is.
 * @param v_max_V  Radius of the circle [V], >= 0.
 * @return         Limited voltage, |v| <= v_max within rounding.
 *
 * Context: control ISR. No division; one square root when limiting.
 */
dq_t voltage_limit(dq_t v_V, float hold_q_V, float v_max_V);

typedef struct {
    dq_t v_V;
    bool limited; /**< it is not the voltage that was wanted */
} voltage_t;

/**
 * @brief What the modulator can produce of the wanted voltage: up to the circle, or to the hexagon around it.
 *
 * In the hexagon EQ-VOLTAGE-1 uses its reach in the direction of the wanted vector. The limit turns the vector; what
 * cannot be produced in the new direction is cut off.
 *
 * @param c         Constants of the drive.
 * @param wanted    Answer of its law; finite.
 * @param angle     In which the voltage is produced.
 * @param dc_link_V Measured [V], > 0.
 *
 * Context: control ISR. Within the circle no division; else up to two, and two square roots.
 */
voltage_t voltage_produce(const drive_config_t *c, const law_output_t *wanted, frames_angle_t angle,
                          float dc_link_V);

#endif /* VOLTAGE_H */
