/* SPDX-License-Identifier: MIT */
/**
 * @file speed_observer.h
 * @brief Speed and one lumped acceleration, from the measured speed and the motor's torque.
 *
 * The model is w' = a + f. Here a is the acceleration by the motor's torque, (l1 + l11 id) iq, and
 * f is everything else. Both poles are at -w_o, in discrete time beta = exp(-w_o Ts). The observer
 * corrects with the present sample:
 *
 *     z_w = z_w + Ts (z_f + (a(k-1) + a(k)) / 2),  e = w - z_w              EQ-LADRC-1
 *     z_w = z_w + (1 - beta^2) e,  z_f = z_f + (1 - beta)^2 e / Ts          EQ-LADRC-2
 *
 * It gets the torque of the measured currents: limits do not disturb it.
 */
#ifndef SPEED_OBSERVER_H
#define SPEED_OBSERVER_H

#include "drive_config.h"
#include "nodo.h"

typedef struct {
    float gain_w;     /**< 1 - beta^2, 0 .. 1 */
    float gain_f_1ps; /**< (1 - beta)^2 / Ts, >= 0 */
} speed_observer_gains_t;

typedef struct {
    float z_e_radps; /**< z_w */
    float z_f_e_radps2;
    float accel_e_radps2; /**< a of the previous sample */
} speed_observer_t;

/** true when both gains are finite and in range. Context: init. */
bool speed_observer_check(const speed_observer_gains_t *g);

/** Starts at the measured speed, with f = 0. Context: control ISR. */
void speed_observer_reset(speed_observer_t *s, const motor_reduced_t *m, const nodo_meas_t *y);

/** EQ-LADRC-1, 2; once per period. Context: control ISR. */
void speed_observer_update(speed_observer_t *s, const speed_observer_gains_t *g,
                           const motor_reduced_t *m, const nodo_meas_t *y, float ts_s);

#endif /* SPEED_OBSERVER_H */
