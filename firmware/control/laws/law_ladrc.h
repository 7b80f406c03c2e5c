/* SPDX-License-Identifier: MIT */
/**
 * @file law_ladrc.h
 * @brief Linear active disturbance rejection of the speed, on the current loops of foc.h.
 *
 * The law models the speed as w' = a + f. Here a is the acceleration by the motor's torque, (l1 +
 * l11 id) iq, and f is everything else. The linear extended state observer has both poles at -w_o,
 * in discrete time beta = exp(-w_o Ts). It corrects with the present sample:
 *
 *     z_w = z_w + Ts (z_f + (a(k-1) + a(k)) / 2),  e = w - z_w              EQ-LADRC-1
 *     z_w = z_w + (1 - beta^2) e,  z_f = z_f + (1 - beta)^2 e / Ts          EQ-LADRC-2
 *     a_ref = w_c (command - z_w) - z_f                                     EQ-LADRC-3
 *
 * The observer gets the torque of the measured currents: limits do not disturb it.
 */
#ifndef LAW_LADRC_H
#define LAW_LADRC_H

#include "foc.h"
#include "speed_difference.h"

/** Gains of observer and speed loop. */
typedef struct {
    float gain_w;     /**< 1 - beta^2, (0, 1] */
    float gain_f_1ps; /**< (1 - beta)^2 / Ts, > 0 */
    float w_c_1ps;    /**< > 0 */
} law_ladrc_gains_t;

typedef struct {
    foc_config_t              foc;
    speed_difference_config_t speed;
    law_ladrc_gains_t         gains[SPEED_DIFFERENCE_MODES];
} law_ladrc_config_t;

typedef struct {
    foc_t              foc;
    speed_difference_t speed;
    float              z_e_radps; /**< z_w */
    float              z_f_e_radps2;
    float              accel_e_radps2; /**< a of the previous sample */
} law_ladrc_state_t;

void law_ladrc_fields(fields_t *f, void *constants); /**< for law_ladrc.fields */

extern const law_t law_ladrc;

#endif /* LAW_LADRC_H */
