/* SPDX-License-Identifier: MIT */
/**
 * @file position.h
 * @brief An electrical angle that counts its turns, as exact after a million turns as in the first.
 *
 *     position = 2 pi turns + theta                                         EQ-POSITION-1
 */
#ifndef POSITION_H
#define POSITION_H

#include "base.h"
#include "frames.h"

/** Electrical turns either way; far enough below 2^31 that differences of two can be formed. */
#define POSITION_TURNS_MAX 1000000000L

/* Inline functions in C and C++: members are set in their order. */

typedef struct {
    int32_t turns;       /**< electrical, within +-POSITION_TURNS_MAX */
    float   theta_e_rad; /**< within +-pi */
} position_t;

/** Whether both are in range. */
static inline bool position_ok(const position_t *p)
{
    return (p->turns >= -POSITION_TURNS_MAX) && (p->turns <= POSITION_TURNS_MAX) &&
           base_within(p->theta_e_rad, BASE_PI);
}

/** The way from one position to another, electrical [rad]; turns are told apart up to 2^24 of them. */
static inline float position_way_rad(const position_t *from, const position_t *to)
{
    const int32_t turns = to->turns - from->turns;

    return (BASE_TWO_PI * (float)turns) + (to->theta_e_rad - from->theta_e_rad);
}

/** A position that much further on; at most half a turn. The last turn is not left. */
static inline position_t position_moved(const position_t *p, float by_rad)
{
    const float theta_rad = p->theta_e_rad + by_rad;
    int32_t     turns     = p->turns;

    if ((theta_rad > BASE_PI) && (turns < POSITION_TURNS_MAX)) {
        turns++;
    }
    if ((theta_rad < -BASE_PI) && (turns > -POSITION_TURNS_MAX)) {
        turns--;
    }
    const position_t out = {turns, frames_wrap(theta_rad)};
    return out;
}

/** The same position, followed to an angle less than half a turn away; its sums add nothing up. */
static inline position_t position_followed(const position_t *p, float theta_e_rad)
{
    const float ahead_rad = theta_e_rad - p->theta_e_rad;
    int32_t     turns     = p->turns;

    if ((ahead_rad < -BASE_PI) && (turns < POSITION_TURNS_MAX)) {
        turns++;
    }
    if ((ahead_rad > BASE_PI) && (turns > -POSITION_TURNS_MAX)) {
        turns--;
    }
    const position_t out = {turns, theta_e_rad};
    return out;
}

#endif /* POSITION_H */
