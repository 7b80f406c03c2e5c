/* SPDX-License-Identifier: MIT */
/**
 * @file commission_turns.h
 * @brief What whole turns of a slowly turning current vector show: counts, angle and flux (EQ-COMMISSION-9, 10).
 */
#ifndef COMMISSION_TURNS_H
#define COMMISSION_TURNS_H

#include "commission_types.h"
#include "commission_vector.h"

/** Sums over whole turns one way. */
typedef struct {
    dq_t    e_V; /**< v - R i, vector's frame */
    dq_t    i_A;
    float   angle_rad; /**< vector less shaft, from angle0_rad on */
    float   angle2_rad2;
    float   angle0_rad;
    float   n;
    int32_t from_cnt;
    int32_t moved_cnt;
} commission_turns_t;

/** The vector of one period. @param shaft its angle is wanted: counts and pole pairs are known. Context: control ISR. */
void commission_turns_add(commission_turns_t *u, const commission_vector_out_t *out,
                          const commission_result_t *known, float theta_rad, int32_t position_cnt,
                          bool shaft);

/** Forward and backward, the rotor moved by the same way. */
bool commission_turns_follow(const commission_turns_t turns[2]);

/** Flux along the current less Ld I of both ways' mean, EQ-COMMISSION-10. @param i_A the current. */
float commission_turns_beyond_Wb(const commission_turns_t   turns[2],
                                 const commission_result_t *known, float speed_radps, float *i_A);

/** Offset, lag, ripple and flux of both ways, EQ-COMMISSION-9. */
void commission_turns_solve(const commission_turns_t turns[2], float speed_radps,
                            commission_result_t *found);

#endif /* COMMISSION_TURNS_H */
