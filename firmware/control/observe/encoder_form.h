/* SPDX-License-Identifier: MIT */
/**
 * @file encoder_form.h
 * @brief What the laws that observe the angle share: innovation, plausibility, view of the prediction.
 */
#ifndef ENCODER_FORM_H
#define ENCODER_FORM_H

#include "angle_gate.h"
#include "base.h"
#include "frames.h"
#include "near_optimal.h"
#include "sample.h"

#define ENCODER_FORM_EDGES 4 /**< of a line */

typedef struct {
    float angle_rad; /**< an angle this far from its estimate cannot be right, (0, pi] */
    float d_omega;   /**< an estimated speed disturbance beyond this is no load but a wrong angle
                          [rad/s^2], > 0 */
} encoder_form_limits_t;

/** Gains of one sample, current zero: what an angle error of 1 rad adds to the estimates; and the encoder's count. */
typedef struct {
    float theta;        /**< (0, 1] */
    float omega_1ps;    /**< > 0 */
    float d_omega_1ps2; /**< > 0 */
    float count_rad;    /**< from edge to edge, electrical [rad], > 0 */
} encoder_form_gains_t;

/** true when both are in range. Context: init. */
CTL_PART bool encoder_form_check(const encoder_form_limits_t *limits);

/** true when all are in range. Context: init. */
CTL_PART bool encoder_form_gains_check(const encoder_form_gains_t *gains);

/**
 * @brief Measured minus estimated angle, within +-pi; less the band in which the sample does not know better.
 *
 *     e = wrap(theta - theta^) - clamp(wrap(theta - theta^), -band, band)          EQ-ENCODER-FORM-1
 *
 * Context: control ISR.
 */
static inline float encoder_form_error_rad(const drive_sample_t *s, float theta_hat_rad)
{
    const float error = frames_wrap(s->theta_e_rad - theta_hat_rad);
    return error - base_clamp(error, -s->band_rad, s->band_rad);
}

/** Whether edges come less often than samples, so that encoder_form_correct_rare() applies. */
static inline bool encoder_form_is_rare(const drive_sample_t *s, float ts_s)
{
    return s->edge_gap_s > ts_s;
}

/** Where the four edges of a line are, learned in the run: their spacing differs by tens of per cent of a count. */
typedef struct {
    float   offset_rad[ENCODER_FORM_EDGES]; /**< electrical; their sum is zero */
    float   omega_e_radps;                  /**< between the last two edges, as measured */
    float   per_gap_1ps;                    /**< one over the time between them */
    int16_t edge[2];                        /**< the last two, 1 .. 4; 0: none */
} encoder_form_edges_t;

/** Nothing known of any edge. */
CTL_PART void encoder_form_edges_reset(encoder_form_edges_t *edges);

/**
 * @brief What the edges are off that this sample's angle rests on; learns from three edges in a row.
 *
 *     r = (w - w_1) T - (o_c - o_c1) + rho (o_c1 - o_c2),   rho = T / T_1
 *     o_c += mu r,  o_c1 -= (1 + rho) mu r,  o_c2 += rho mu r                       EQ-ENCODER-FORM-3
 *     off = o_c + (o_c - o_c1) age / T
 *
 * w = w_e of the sample, turned between two edges in the time T between them; c the edge; 1, 2: one and two edges before.
 * The angle was carried from the edge to the sample with w, hence the second share. No estimate takes part: an observer
 * would follow the offsets and hide them. The shaft's acceleration is no share of any edge, so that it averages out.
 *
 * @param edges     Learned offsets.
 * @param s         This sample, with edge_gap_s > 0.
 * @param count_rad From edge to edge; an offset is at most half of it.
 * @param ts_s      Control period [s].
 * @return The offset [rad] in the sample's angle, at most 2 counts; 0 without an edge.
 *
 * Context: control ISR. One division.
 */
CTL_PART float encoder_form_learn(encoder_form_edges_t *edges, const drive_sample_t *s,
                                  float count_rad, float ts_s);

/** The next edge is no neighbour of the last ones, from which nothing is to be learned. */
CTL_PART void encoder_form_skip(encoder_form_edges_t *edges);

/**
 * @brief encoder_form_error_rad() as far as the gate believes it, without what the edge is off.
 *
 * Counts have no edge and stay as they are. From a sample that the gate holds nothing is learned.
 *
 * @param gate          State of the gate.
 * @param edges         Learned offsets.
 * @param c             The gate's constants; count_rad is that of the edges too.
 * @param s             This sample.
 * @param est           Estimates, not yet corrected.
 * @param theta_hat_rad Estimated angle.
 * @param ts_s          Control period [s].
 *
 * Context: control ISR. The cost of encoder_form_learn().
 */
CTL_PART angle_gate_result_t encoder_form_innovation(angle_gate_t              *gate,
                                                     encoder_form_edges_t      *edges,
                                                     const angle_gate_config_t *c,
                                                     const drive_sample_t *s, const nodo_t *est,
                                                     float theta_hat_rad, float ts_s);

/**
 * @brief Correction with an edge that comes once in T > Ts, or with the band after it.
 *
 * The gains of one sample, times the samples that an edge stands for, but never more than explains the error e by itself:
 * as an error of the angle, of the speed since the edge before, or of the acceleration since then.
 *
 *     theta^ += min(k_theta T / Ts, 1) e
 *     w^     += min(k_w T / Ts, 1 / T) e
 *     d_w^   += min(k_d T / Ts, s / T^2) e, the other estimates in proportion    EQ-ENCODER-FORM-2
 *     T = min(gap, 2 count / |w^|), at least Ts;  s = k_d Ts^2 within 0.15 .. 0.5
 *
 * A shaft that starts after a long rest has not taken all of the gap for its count.
 *
 * @param est           Estimates; the speed gets what is more than its gain of one sample.
 * @param theta_hat_rad Estimated angle, the same.
 * @param gains         Of one sample.
 * @param error_rad     encoder_form_error_rad().
 * @param gap_s         drive_sample_t.edge_gap_s, > 0.
 * @param ts_s          Control period [s].
 * @return The share of the error that the observer's correction takes with its gains of one sample.
 *
 * Context: control ISR. One division at the most.
 */
CTL_PART float encoder_form_correct_rare(nodo_t *est, float *theta_hat_rad,
                                         const encoder_form_gains_t *gains, float error_rad,
                                         float gap_s, float ts_s);

/**
 * @brief The prediction as the law sees it.
 *
 * A standing angle looks like a load that no motor could carry.
 *
 * @param limits          Of plausibility.
 * @param est             Predicted; must outlive the view.
 * @param theta_hat_rad   Predicted.
 * @param angle_error_rad Of this sample.
 * @param ts_s            Control period [s].
 *
 * Context: control ISR.
 */
static inline near_optimal_view_t encoder_form_view(const encoder_form_limits_t *limits,
                                                    const nodo_t *est, float theta_hat_rad,
                                                    float angle_error_rad, float ts_s)
{
    const near_optimal_view_t view = {est,
                                      {est->omega_e_radps, est->iq_A, est->id_A},
                                      0.0f,
                                      theta_hat_rad +
                                          (0.5f * ts_s * est->omega_e_radps), /* EQ-DRIVE-2 */
                                      base_within(angle_error_rad, limits->angle_rad) &&
                                          base_within(est->d_omega, limits->d_omega)};
    return view;
}

#endif /* ENCODER_FORM_H */
