/* SPDX-License-Identifier: MIT */
/**
 * @file commission_resistance.h
 * @brief Resistance and what the inverter loses, from direct currents.
 *
 *     v_along = R I + 4/3 v_loss,  four currents at each of three angles 120 degrees apart    EQ-COMMISSION-8
 *
 * At these angles one phase carries I and the others -I/2 each; of three phases that lose v_loss against their currents
 * 4/3 v_loss is left along the vector, the same for all levels. The slope therefore has nothing of it. The three slopes
 * differ by what the windings and the current sensors differ; their spread is the error.
 *
 * The current rises on a ramp, and first to a level at which a rotor that swings into place induces little.
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
    int16_t             at_angle; /**< where the vector is */
    int16_t             level;    /**< -1: pulls the rotor into place */
    int32_t             ticks;
    int32_t             mean_ticks; /**< of the mean that is being taken; 0: the current settles */
    int32_t             sums;
    float               sum_v_V;
    float               sum_i_A;
    float               half_swing_s;
} commission_resistance_t;

/** Context: control ISR. */
void commission_resistance_start(commission_resistance_t *r, const commission_config_t *c,
                                 const commission_result_t *known);

/** One period. */
commission_answer_t commission_resistance_tick(commission_resistance_t   *r,
                                               const commission_config_t *c,
                                               const commission_signal_t *s,
                                               commission_result_t       *found);

#endif /* COMMISSION_RESISTANCE_H */
