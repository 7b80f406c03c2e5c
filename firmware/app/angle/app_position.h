/* SPDX-License-Identifier: MIT */
/**
 * @file app_position.h
 * @brief Where the shaft is, over any number of turns, in counts of the encoder from a zero.
 *
 *     counts = (position - zero) N / (2 pi n_p)                                EQ-APP-POSITION-1
 *
 * The zero is the count in which the angle was found: that of the index mark, or the one at which the motor was aligned. It is
 * known as long as the angle is referenced; homing finds it anew. Whole turns are counted in whole numbers, so that a
 * count is a count after any number of them.
 */
#ifndef APP_POSITION_H
#define APP_POSITION_H

#include "app_angle.h"
#include "position.h"

/** Counts either way that a target may be away. */
#define APP_POSITION_CNT_MAX 1000000000L

typedef struct {
    uint16_t   pole_pairs;
    uint16_t   positions;   /**< per turn */
    float      rad_per_cnt; /**< electrical */
    position_t is;          /**< of the last sample */
    position_t zero;
    bool       have;  /**< there was a sample */
    bool       known; /**< and the zero is one */
} app_position_t;

/** Context: init. */
void app_position_init(app_position_t *p, const app_angle_t *angle);

/** One sample, behind app_angle_update(). Context: control ISR, every tick. */
void app_position_track(app_position_t *p, const app_angle_t *angle,
                        const app_angle_reading_t *reading);

/** The zero is that of the next sample's reference. Context: control ISR. */
void app_position_forget(app_position_t *p);

/** Of counts within +-APP_POSITION_CNT_MAX. Context: control ISR. Four divisions of whole numbers. */
position_t app_position_at(const app_position_t *p, int32_t counts);

/** Counts of a position, rounded, within +-APP_POSITION_CNT_MAX. Context: any. */
int32_t app_position_cnt(const app_position_t *p, const position_t *at);

#endif /* APP_POSITION_H */
