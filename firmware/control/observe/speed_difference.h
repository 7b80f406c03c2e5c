/* SPDX-License-Identifier: MIT */
/**
 * @file speed_difference.h
 * @brief Speed from angle differences, for laws without a speed observer.
 *
 *     w = wrap(theta(k) - theta(k-n)) / (n Ts)                              EQ-SPEED-DIFFERENCE-1
 *     w = w_edges - (o_c - o_c1) / gap                                      EQ-SPEED-DIFFERENCE-2
 *
 * The first is the mean over the last n periods and lags by half of them. A sample with edge times
 * contains the speed w_edges between its last two edges (drive_sample_t.omega_e_radps). With about
 * one edge per period, that speed lags by half a period. A law has gains for both.
 *
 * The two edges are mostly of different kinds: their places in the line are c1 and c. o_c is how
 * far kind c is from its nominal place (EQ-ENCODER-FORM-3). Without it the speed is that between
 * edges of one kind, as if whole lines were timed: errors of quadrature and duty have no effect.
 */
#ifndef SPEED_DIFFERENCE_H
#define SPEED_DIFFERENCE_H

#include "base.h"
#include "encoder_form.h"
#include "sample.h"

#define SPEED_DIFFERENCE_PERIODS_MAX 20 /**< 1 ms at 20 kHz */

typedef struct {
    int16_t periods; /**< n, 1 .. SPEED_DIFFERENCE_PERIODS_MAX; below half a turn at every speed */
    float   inv_span_1ps;   /**< 1 / (n Ts) */
    float   edge_gap_max_s; /**< above this edge interval the difference is used, > 0 */
    float   count_rad;      /**< nominal electrical angle from edge to edge, > 0 */
} speed_difference_config_t;

typedef struct {
    float                theta_rad[SPEED_DIFFERENCE_PERIODS_MAX]; /**< the last n, within +-pi */
    int16_t              oldest;
    encoder_form_edges_t edges;           /**< where the edges of the pattern are */
    float                pattern_e_radps; /**< what they change in the speed between the last two */
} speed_difference_t;

/** true when every constant is within its range for this control period. Context: init. */
bool speed_difference_check(const speed_difference_config_t *c, float ts_s);

/**
 * @brief Starts as if the shaft had turned at the sample's speed before.
 *
 * The first update takes the same sample. Context: control ISR.
 */
void speed_difference_reset(speed_difference_t *s, const speed_difference_config_t *c,
                            const drive_sample_t *sample, float ts_s);

/** Kind of speed measurement, the index of a law's gains. */
typedef enum {
    SPEED_DIFFERENCE_COUNTED = 0,
    SPEED_DIFFERENCE_TIMED, /**< between edges */
    SPEED_DIFFERENCE_MODES
} speed_difference_mode_t;

/** Measures the speed of this sample; once per period. Context: control ISR. One division. */
speed_difference_mode_t speed_difference_update(speed_difference_t              *s,
                                                const speed_difference_config_t *c,
                                                const drive_sample_t *sample, float ts_s,
                                                float *omega_e_radps);

#endif /* SPEED_DIFFERENCE_H */
