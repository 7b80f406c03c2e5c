/* SPDX-License-Identifier: MIT */
/**
 * @file commission_turns.h
 * @brief Counts, angle and flux from whole turns of a slow current vector (EQ-COMMISSION-9, 10).
 */
#ifndef COMMISSION_TURNS_H
#define COMMISSION_TURNS_H

#include "commission_types.h"
#include "commission_vector.h"

/** Sums over whole turns in one direction. */
typedef struct {
    dq_t    e_V; /**< v - R i in the frame of the vector */
    dq_t    i_A;
    float   angle_rad; /**< vector minus shaft, relative to angle0_rad */
    float   angle2_rad2;
    float   angle0_rad;
    float   n;
    int32_t from_cnt;
    int32_t moved_cnt;
} commission_turns_t;

/**
 * @brief Adds one period.
 *
 * @param shaft true: adds the angle too; counts and pole pairs must be known.
 *
 * Context: control ISR.
 */
void commission_turns_add(commission_turns_t *u, const commission_vector_out_t *out,
                          const commission_result_t *known, float theta_rad, int32_t position_cnt,
                          bool shaft);

/** True if the rotor moved by the same angle forward and backward. */
bool commission_turns_follow(const commission_turns_t turns[2]);

/** x of EQ-COMMISSION-10, mean of both directions. @param i_A gets the length of the current. */
float commission_turns_beyond_Wb(const commission_turns_t   turns[2],
                                 const commission_result_t *known, float speed_radps, float *i_A);

/** Computes offset, lag, ripple and flux from both directions, EQ-COMMISSION-9. */
void commission_turns_solve(const commission_turns_t turns[2], float speed_radps,
                            commission_result_t *found);

#endif /* COMMISSION_TURNS_H */
