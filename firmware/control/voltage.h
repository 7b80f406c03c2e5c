/* SPDX-License-Identifier: MIT */
/**
 * @file voltage.h
 * @brief Voltage limit on the vector.
 *
 *     v_lim = hold + s (v - hold),  s = max { 0 <= s <= 1 : |v_lim| <= v_max }      EQ-VOLTAGE-1
 *
 * hold is what keeps the currents where they are, so the limit scales their rates of change and keeps
 * the direction. Where no s fits, the shortest vector on that line is taken and scaled into the circle.
 */
#ifndef VOLTAGE_H
#define VOLTAGE_H

#include "base.h"

typedef struct {
    dq_t v_V;     /**< limited voltage, |v_V| <= v_max within rounding */
    bool limited; /**< the limit was active */
} voltage_limited_t;

/**
 * @param v_V     Wanted voltage.
 * @param hold_V  Voltage to cover first.
 * @param v_max_V Radius of the circle [V], >= 0.
 *
 * Context: control ISR. When limiting: two square roots and two divisions at most, otherwise none.
 */
voltage_limited_t voltage_limit(dq_t v_V, dq_t hold_V, float v_max_V);

#endif /* VOLTAGE_H */
