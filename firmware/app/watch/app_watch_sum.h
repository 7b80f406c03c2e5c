/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_sum.h
 * @brief Third current sensor: the three phase currents of a motor without neutral sum to zero.
 *
 *     differs: abs(a + b + c - zero) > 4 % of the converter's codes in three samples in a row,
 *              a, b, c codes, zero their mean without current                   EQ-APP-SUM-1
 *
 * A wrong sensor breaks the sum, and so does a current to earth. Only equal relative errors of all
 * three sensors do not. The check needs no model: it works with every law and in every mode.
 *
 * 4 % of the codes are 8 % of a sensor's range. Gains that differ by 2.7 % (docs/hardware.md) use
 * half of that at 80 % of the range. A zero that has moved as far as READY allows uses half, too.
 *
 * Firmware for two sensors has none of this code: BOARD_CURRENT_SENSORS is 2.
 */
#ifndef APP_WATCH_SUM_H
#define APP_WATCH_SUM_H

#include "base.h"
#include "board.h"

#if BOARD_CURRENT_SENSORS == 3

typedef struct {
    uint32_t sum_cnt;  /**< of the calibration */
    float    zero_cnt; /**< of a + b + c */
    uint16_t beyond;   /**< samples in a row */
    bool     on;       /**< the drive has three sensors */
} app_watch_sum_t;

/** @param sensors Number of current sensors, 2 or 3. Context: init. */
void app_watch_sum_init(app_watch_sum_t *w, uint16_t sensors);

/** Forgets the samples of a calibration. Context: control ISR. */
void app_watch_sum_begin(app_watch_sum_t *w);

/** One sample of a calibration, at most 65535. Context: control ISR. */
void app_watch_sum_add(app_watch_sum_t *w, const board_sample_t *raw);

/**
 * @brief Sets the zero to the mean of `count` samples.
 * @param nominal_cnt Code of no current.
 * @param most_cnt    Largest deviation from it, of one sensor.
 * @return false: the mean is too far from three nominal codes.
 *
 * Context: control ISR, once.
 */
bool app_watch_sum_set_zero(app_watch_sum_t *w, uint16_t count, float nominal_cnt, float most_cnt);

/** EQ-APP-SUM-1 for a valid sample. Context: control ISR. No division. */
bool app_watch_sum_differs(app_watch_sum_t *w, const board_sample_t *raw);

#endif

#endif /* APP_WATCH_SUM_H */
