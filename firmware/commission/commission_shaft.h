/* SPDX-License-Identifier: MIT */
/**
 * @file commission_shaft.h
 * @brief Plausibility of the position: its step between samples, and the speed over a millisecond.
 */
#ifndef COMMISSION_SHAFT_H
#define COMMISSION_SHAFT_H

#include "commission_types.h"

typedef enum {
    COMMISSION_SHAFT_OK = 0,
    COMMISSION_SHAFT_JUMP,
    COMMISSION_SHAFT_FAST
} commission_shaft_judgement_t;

typedef struct {
    int32_t position_cnt;
    int32_t speed_cnt; /**< position at the start of the speed window */
    int32_t speed_ticks;
} commission_shaft_t;

/** Starts at this position. Context: control ISR. */
void commission_shaft_start(commission_shaft_t *w, int32_t position_cnt);

/** Judges one sample. @param counts_per_turn 0: unknown, no judgement. Context: control ISR. */
commission_shaft_judgement_t commission_shaft_judge(commission_shaft_t        *w,
                                                    const commission_config_t *c,
                                                    int32_t counts_per_turn, int32_t position_cnt);

#endif /* COMMISSION_SHAFT_H */
