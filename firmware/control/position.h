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
    position_t  out   = *p;
    const float theta = p->theta_e_rad + by_rad;

    if ((theta > BASE_PI) && (p->turns < POSITION_TURNS_MAX)) {
        out.turns++;
    }
    if ((theta < -BASE_PI) && (p->turns > -POSITION_TURNS_MAX)) {
        out.turns--;
    }
    out.theta_e_rad = frames_wrap(theta);
    return out;
}

/** The same position, followed to an angle less than half a turn away; its sums add nothing up. */
static inline position_t position_followed(const position_t *p, float theta_e_rad)
{
    const float ahead = theta_e_rad - p->theta_e_rad;
    position_t  out   = {p->turns, theta_e_rad};

    if ((ahead < -BASE_PI) && (out.turns < POSITION_TURNS_MAX)) {
        out.turns++;
    }
    if ((ahead > BASE_PI) && (out.turns > -POSITION_TURNS_MAX)) {
        out.turns--;
    }
    return out;
}

#endif /* POSITION_H */
