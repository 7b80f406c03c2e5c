/* SPDX-License-Identifier: MIT */
/**
 * @file commission_resistance.h
 * @brief Resistance and inverter voltage loss, from direct currents.
 *
 *     v_along = R I + 4/3 v_loss,  four currents at each of three angles 120 degrees apart    EQ-COMMISSION-8
 *
 * At these angles one phase carries I and the other two carry -I/2. Each phase loses v_loss against
 * its current. Along the vector this is 4/3 v_loss at every current level, so the slope is R alone.
 * Windings and current sensors differ: the spread of the three slopes is the error.
 *
 * The current rises on a ramp. The first level is small, so that a rotor swinging into place
 * induces little voltage.
 */
#ifndef COMMISSION_RESISTANCE_H
#define COMMISSION_RESISTANCE_H

#include "commission_fit.h"
#include "commission_types.h"
#include "commission_vector.h"

#define COMMISSION_ANGLES 3

typedef struct {
    commission_vector_t vector;
    commission_fit_t    line;
    commission_fitted_t lines[COMMISSION_ANGLES];
    int16_t             angle;
    int16_t             at_angle; /**< present angle of the vector, 0 .. 2 */
    int16_t             level;    /**< -1: aligns the rotor */
    int32_t             ticks;
    int32_t             mean_ticks; /**< length of the present mean; 0: the current settles */
    int32_t             sums;
    float               sum_v_V;
    float               sum_i_A;
    float               half_swing_s;
    float               before_V; /**< mean voltage and current of the level before */
    float               before_A;
    float               slope_Ohm; /**< between the two levels before */
} commission_resistance_t;

/** Starts at the first angle. Context: control ISR. */
void commission_resistance_start(commission_resistance_t *r, const commission_config_t *c,
                                 const commission_result_t *known);

/** False when a current sensor or a phase cannot be right. Context: control ISR. */
bool commission_resistance_follows(const commission_resistance_t *r, const commission_config_t *c,
                                   const commission_result_t *known);

/** Executes one period. `found` gets the results with COMMISSION_DONE. Context: control ISR. */
commission_answer_t commission_resistance_tick(commission_resistance_t   *r,
                                               const commission_config_t *c,
                                               const commission_signal_t *s,
                                               commission_result_t       *found);

#endif /* COMMISSION_RESISTANCE_H */
