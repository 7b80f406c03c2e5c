/* SPDX-License-Identifier: MIT */
/**
 * @file commission_check.h
 * @brief Proves phases and current sensors with short voltage pulses, before any lasting current.
 *
 * A pulse pattern is +v, -v, -v, +v, two periods each, along the axis of a phase: it leaves no
 * current and no motion. Along the first axis v grows until a current answers. Patterns along all
 * three axes then give the admittance of the winding, a 2 x 2 matrix in the stator frame:
 *
 *     Y_ij = 2 sum(di_i v_j) / (Ts sum(v^2))                                   EQ-COMMISSION-15
 *
 * The winding's own matrix is symmetric and positive definite for every angle of the rotor. A
 * sensor with a gain g of its own, a dead sensor (g = 0) or an open phase makes it lopsided or
 * singular. Both sensors with the same wrong gain look like another motor.
 *
 * The largest pulse is bounded, so that two dead sensors mean little true current.
 */
#ifndef COMMISSION_CHECK_H
#define COMMISSION_CHECK_H

#include "commission_types.h"

/** Admittance in the stator frame [A/(V s)], symmetric. */
typedef struct {
    float aa;
    float ab;
    float bb;
    float pulse_V; /**< height of the pulses that gave it */
} commission_admittance_t;

/** Sums of di v: current's axis, voltage's axis. */
typedef struct {
    float aa;
    float ab;
    float ba;
    float bb;
    float vv; /**< sum of |v|^2 */
} commission_sums_t;

typedef struct {
    float             v_V; /**< height of the pulses */
    commission_sums_t sums;
    float             begun;    /**< sum of aa and bb before the last quarter */
    float             begun_vv; /**< vv before it */
    int16_t           tick;     /**< within the pattern */
    int16_t           patterns; /**< since v was found */
    bool              found;    /**< v is large enough */
} commission_check_t;

/** Adds one period. Context: control ISR. */
void commission_sums_add(commission_sums_t *k, ab_t di_A, ab_t v_V);

/**
 * @brief EQ-COMMISSION-15.
 *
 * @param least_det Smallest determinant, relative to that of two equal inductances.
 * @return          false: the matrix is not that of a winding.
 *
 * Context: control ISR. One division.
 */
bool commission_sums_solve(const commission_sums_t *k, float ts_s, float least_det,
                           commission_admittance_t *y);

/** Determinant relative to that of two equal inductances, 0 .. 1. Context: control ISR. */
float commission_check_det(const commission_admittance_t *y);

/** Smallest along any axis [A/(V s)]: of the largest inductance. Context: control ISR. */
float commission_check_least(const commission_admittance_t *y);

/** True when both have the same mean within a gain of 1.7. Context: control ISR. */
bool commission_check_same(const commission_admittance_t *y, const commission_admittance_t *known);

/** Starts with the smallest pulses. Context: control ISR. */
void commission_check_start(commission_check_t *k);

/** Executes one period. @param y gets the admittance with COMMISSION_DONE. Context: control ISR. */
commission_answer_t commission_check_tick(commission_check_t *k, const commission_config_t *c,
                                          const commission_signal_t *s, commission_admittance_t *y);

#endif /* COMMISSION_CHECK_H */
