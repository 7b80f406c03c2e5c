/* SPDX-License-Identifier: MIT */
/**
 * @file app_position.h
 * @brief Shaft position over any number of turns, in encoder counts from a zero.
 *
 *     counts = (position - zero) N / (2 pi n_p)                                EQ-APP-POSITION-1
 *
 * The zero is the count at which the angle was found, by the index mark or by alignment. It is
 * known while the angle is referenced. Homing replaces it, app_homing.h. Whole turns are counted in
 * integers: the resolution stays one count after any number of turns.
 */
#ifndef APP_POSITION_H
#define APP_POSITION_H

#include "app_angle.h"
#include "app_part.h"
#include "position.h"

/** Limit of a target position, in either direction [counts]. */
#define APP_POSITION_CNT_MAX 1000000000L

/** Largest zero that homing may set, in electrical turns: a target from there still counts. */
#define APP_POSITION_ZERO_TURNS (POSITION_TURNS_MAX / 2L)

typedef struct {
    uint16_t   pole_pairs;
    uint16_t   positions;   /**< per turn */
    float      rad_per_cnt; /**< electrical */
    position_t actual;      /**< of the last sample */
    position_t zero;
    bool       have;  /**< there was a sample */
    bool       known; /**< the zero is known */
    bool       homed; /**< it is that of the last homing */
} app_position_t;

/** Sets up, with unknown zero. Context: init. */
void app_position_init(app_position_t *p, const app_angle_t *angle);

/** Takes one sample, after app_angle_update(). Context: control ISR, every tick. */
APP_MEASURE_PART void app_position_track(app_position_t *p, const app_angle_t *angle,
                                         const app_angle_reading_t *reading);

/** Sets the zero: the middle of the reference count that is nearest to the present position.
 * Context: control ISR, once after a reference. */
void app_position_find_zero(app_position_t *p, const app_angle_t *angle);

/** Sets the zero, as homing found it. Context: control ISR. */
void app_position_set_zero(app_position_t *p, const position_t *zero);

/** Drops the zero. The next referenced sample gives a new one. Context: control ISR. */
void app_position_forget(app_position_t *p);

/** Counts limited to +-APP_POSITION_CNT_MAX. */
static inline int32_t app_position_held(int32_t counts)
{
    const int32_t up = (counts > APP_POSITION_CNT_MAX) ? APP_POSITION_CNT_MAX : counts;
    return (up < -APP_POSITION_CNT_MAX) ? -APP_POSITION_CNT_MAX : up;
}

/** Position of a count within +-APP_POSITION_CNT_MAX. Context: control ISR. Four integer
 * divisions. */
position_t app_position_at(const app_position_t *p, int32_t counts);

/** Counts of a position, rounded, within +-APP_POSITION_CNT_MAX. Context: any. */
int32_t app_position_cnt(const app_position_t *p, const position_t *at);

#endif /* APP_POSITION_H */
