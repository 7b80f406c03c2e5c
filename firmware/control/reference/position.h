/* SPDX-License-Identifier: MIT */
/**
 * @file position.h
 * @brief Multi-turn electrical angle with constant resolution.
 *
 *     position = 2 pi turns + theta                                         EQ-POSITION-1
 */
#ifndef POSITION_H
#define POSITION_H

#include "base.h"
#include "frames.h"

/** Limit of electrical turns in either direction; the difference of two does not overflow. */
#define POSITION_TURNS_MAX 1000000000L

/* Inline functions in C and C++: members are set in their order. */

typedef struct {
    int32_t turns;       /**< electrical, within +-POSITION_TURNS_MAX */
    float   theta_e_rad; /**< within +-pi */
} position_t;

/** True if both members are in range. */
static inline bool position_ok(const position_t *p)
{
    return (p->turns >= -POSITION_TURNS_MAX) && (p->turns <= POSITION_TURNS_MAX) &&
           base_within(p->theta_e_rad, BASE_PI);
}

/** Distance between two positions, electrical [rad]; exact in turns up to 2^24 of them. */
static inline float position_way_rad(const position_t *from, const position_t *to)
{
    const int32_t turns = to->turns - from->turns;

    return (BASE_TWO_PI * (float)turns) + (to->theta_e_rad - from->theta_e_rad);
}

/** A position moved by at most half a turn. The number of turns stays within its limit. */
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

/** A position updated to an angle less than half a turn away. Rounding errors do not accumulate. */
static inline position_t position_followed(const position_t *p, float theta_e_rad)
{
    const float ahead_rad = theta_e_rad - p->theta_e_rad;
    int32_t     turns     = p->turns;

    if (!base_within(ahead_rad, BASE_PI)) { /* seldom: one comparison in most periods */
        if ((ahead_rad < 0.0f) && (turns < POSITION_TURNS_MAX)) {
            turns++;
        }
        if ((ahead_rad > 0.0f) && (turns > -POSITION_TURNS_MAX)) {
            turns--;
        }
    }
    const position_t out = {turns, theta_e_rad};
    return out;
}

#endif /* POSITION_H */
