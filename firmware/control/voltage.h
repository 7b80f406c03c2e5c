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

/**
 * @param v_V      Wanted voltage; a NaN comes out as a vector inside the circle.
 * @param hold_q_V q voltage that keeps the q current where it is.
 * @param v_max_V  Radius of the circle [V], >= 0.
 * @return         Limited voltage, |v| <= v_max within rounding.
 *
 * Context: control ISR. No division; one square root when limiting.
 */
dq_t voltage_limit(dq_t v_V, float hold_q_V, float v_max_V);

#endif /* VOLTAGE_H */
