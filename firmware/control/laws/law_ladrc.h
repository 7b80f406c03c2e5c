/* SPDX-License-Identifier: MIT */
/**
 * @file law_ladrc.h
 * @brief Linear active disturbance rejection of the speed, on the current loops of foc.h.
 *
 * The observer of speed_observer.h estimates the speed z_w and the lumped acceleration z_f of
 * everything but the motor's torque (EQ-LADRC-1, 2):
 *
 *     a_ref = w_c (command - z_w) - z_f                                     EQ-LADRC-3
 */
#ifndef LAW_LADRC_H
#define LAW_LADRC_H

#include "foc.h"
#include "speed_difference.h"
#include "speed_observer.h"

/** Gains of observer and speed loop. */
typedef struct {
    speed_observer_gains_t observer; /**< both > 0 */
    float                  w_c_1ps;  /**< > 0 */
} law_ladrc_gains_t;

typedef struct {
    foc_config_t              foc;
    speed_difference_config_t speed;
    law_ladrc_gains_t         gains[SPEED_DIFFERENCE_MODES];
} law_ladrc_config_t;

typedef struct {
    foc_t              foc;
    speed_difference_t speed;
    speed_observer_t   observer;
} law_ladrc_state_t;

void law_ladrc_fields(fields_t *f, void *constants); /**< for law_ladrc.fields */

extern const law_t law_ladrc;

#endif /* LAW_LADRC_H */
