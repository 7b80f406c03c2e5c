/* SPDX-License-Identifier: MIT */
/**
 * @file current_clamp.h
 * @brief Reduces the voltage of one period if it would drive the current beyond the limit.
 *
 *     i+ = i + Ts ((1 / s - 1) i'(v_0) + i'(v) / s)
 *     where |i+| > r I:  v += s L / Ts (r I / |i+| - 1) i+                       EQ-CURRENT-CLAMP-1
 *
 * Here i is the current at which v begins to act. It is predicted with v_0 from the current
 * measured one period before. Here i' is the motor's equation with the observer's disturbances, and
 * I is the limit. Finally i+ is the current with the share s = 0.7 of the nominal inductance.
 *
 * With low inductance, one period of full voltage changes the current by most of the limit, and no
 * feedback acts in between. Inside the circle r I the voltage stays unchanged: the certificate
 * holds.
 */
#ifndef CURRENT_CLAMP_H
#define CURRENT_CLAMP_H

#include "base.h"
#include "motor.h"
#include "nodo.h"

/**
 * @param m           Reduced parameters.
 * @param est         Observer, for d_q and d_d.
 * @param now         Speed and currents at which the voltage begins to act.
 * @param v_V         Requested voltage within the inverter's reach.
 * @param v_0_V       Voltage that acts until then.
 * @param max_A       Current limit [A peak], > 0.
 * @param samples_1ps 1 / Ts.
 * @return            The voltage, reduced if necessary.
 *
 * Context: control ISR. Beyond the circle one division and a square root.
 */
CTL_PART dq_t current_clamp_V(const motor_reduced_t *m, const nodo_t *est, const nodo_meas_t *now,
                              dq_t v_V, dq_t v_0_V, float max_A, float samples_1ps);

#endif /* CURRENT_CLAMP_H */
