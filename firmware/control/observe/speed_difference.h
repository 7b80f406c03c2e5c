/* SPDX-License-Identifier: MIT */
/**
 * @file speed_difference.h
 * @brief Speed from angles, as drives without an observer measure it.
 *
 *     w = wrap(theta(k) - theta(k-n)) / (n Ts)                              EQ-SPEED-DIFFERENCE-1
 *
 * It is the mean of the last n periods, so late by half of them. A sample whose angle rests on the times of edges brings
 * the speed between those edges along (drive_sample_t.omega_e_radps), late by half of a period as long as there is an edge in
 * about every period. A law has gains for either.
 */
#ifndef SPEED_DIFFERENCE_H
#define SPEED_DIFFERENCE_H

#include "base.h"
#include "sample.h"

#define SPEED_DIFFERENCE_PERIODS_MAX 20 /**< 1 ms at 20 kHz */

typedef struct {
    int16_t periods; /**< n, 1 .. SPEED_DIFFERENCE_PERIODS_MAX; no half turn in them at any speed */
    float   inv_span_1ps;   /**< 1 / (n Ts) */
    float   edge_gap_max_s; /**< edges further apart are rare: the difference counts, > 0 */
} speed_difference_config_t;

typedef struct {
    float   theta_rad[SPEED_DIFFERENCE_PERIODS_MAX]; /**< the last n, within +-pi */
    int16_t oldest;
} speed_difference_t;

/** true when every constant is within its range for this control period. Context: init. */
bool speed_difference_check(const speed_difference_config_t *c, float ts_s);

/** As if the shaft had turned at the sample's speed before; the first update is of the same sample. Context: control ISR. */
void speed_difference_reset(speed_difference_t *s, const speed_difference_config_t *c,
                            const drive_sample_t *sample, float ts_s);

/** How a speed was measured: an index of a law's gains. */
typedef enum {
    SPEED_DIFFERENCE_COUNTED = 0,
    SPEED_DIFFERENCE_TIMED, /**< between edges */
    SPEED_DIFFERENCE_MODES
} speed_difference_mode_t;

/** The speed of this sample. Once a period. Context: control ISR. No division. */
speed_difference_mode_t speed_difference_update(speed_difference_t              *s,
                                                const speed_difference_config_t *c,
                                                const drive_sample_t *sample, float *omega_e_radps);

#endif /* SPEED_DIFFERENCE_H */
