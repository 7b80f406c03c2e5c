/* SPDX-License-Identifier: MIT */
/**
 * @file encoder_form.h
 * @brief Common part of the laws with angle observer: innovation, plausibility, predicted view.
 */
#ifndef ENCODER_FORM_H
#define ENCODER_FORM_H

#include "angle_gate.h"
#include "base.h"
#include "frames.h"
#include "near_optimal.h"
#include "sample.h"

#define ENCODER_FORM_LINE  4  /**< edges per line */
#define ENCODER_FORM_EDGES 16 /**< places of the longest pattern: four lines */

typedef struct {
    float angle_rad; /**< largest plausible angle error, (0, pi] */
    float d_omega;   /**< largest disturbance by a load; a larger estimate means a wrong angle
                          [rad/s^2], > 0 */
} encoder_form_limits_t;

/** Gains of one sample at zero current, per rad of angle error, and the encoder count. */
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
 * @brief Measured minus estimated angle, within +-pi, reduced by the uncertainty of the sample.
 *
 *     e = wrap(theta - theta^) - clamp(wrap(theta - theta^), -band, band)         EQ-ENCODER-FORM-1
 *
 * Context: control ISR.
 */
static inline float encoder_form_error_rad(const drive_sample_t *s, float theta_hat_rad)
{
    const float error = frames_wrap(s->theta_e_rad - theta_hat_rad);
    return error - base_clamp(error, -s->band_rad, s->band_rad);
}

/** True if edges are rarer than samples: encoder_form_correct_rare() applies. */
static inline bool encoder_form_is_rare(const drive_sample_t *s, float ts_s)
{
    return s->edge_gap_s > ts_s;
}

/**
 * @brief Places of the disc's pattern: the most of 4, 8 and 16 that divide a turn.
 *
 *     place = 1 + edge mod places                                               EQ-ENCODER-FORM-4
 *
 * An edge then has the same place in every turn. All edges of a line have different places, so the
 * errors of quadrature and duty are learned in any case.
 *
 * @param edges_per_turn A multiple of 4.
 */
static inline uint16_t encoder_form_places(uint32_t edges_per_turn)
{
    const uint16_t mask = (uint16_t)(edges_per_turn % (uint32_t)ENCODER_FORM_EDGES);

    return (mask == 0U) ? (uint16_t)ENCODER_FORM_EDGES : ((mask == 8U) ? 8U : 4U);
}

/** Learned places of the edges of up to four lines. Their spacing differs by tens of per cent of a
 * count. */
typedef struct {
    float    offset_rad[ENCODER_FORM_EDGES]; /**< electrical; their sum is zero */
    float    omega_e_radps;                  /**< between the last two edges, as measured */
    float    per_gap_1ps;                    /**< one over the time between them */
    uint16_t place[2];                       /**< of the last two, 0 .. 15 */
    uint16_t known;                          /**< how many of these two */
    uint16_t learned;                        /**< samples in which all lines were the same */
} encoder_form_edges_t;

/** A place as it is stored: a bit flipped in the state leaves an index of offset_rad. */
static inline uint16_t encoder_form_place(uint16_t stored)
{
    return stored % (uint16_t)ENCODER_FORM_EDGES;
}

/** Clears the learned offsets. */
CTL_PART void encoder_form_edges_reset(encoder_form_edges_t *edges);

/**
 * @brief Returns the edge error in this sample's angle, and learns from three consecutive edges.
 *
 *     r = (w - w_1) T - (o_c - o_c1) + rho (o_c1 - o_c2),   rho = T / T_1
 *     o_c += mu r,  o_c1 -= (1 + rho) mu r,  o_c2 += rho mu r                     EQ-ENCODER-FORM-3
 *     off = o_c + (o_c - o_c1) age / T
 *
 * w is the sample's speed between its last two edges, which are T apart. Edge c is the last one.
 * The indexes 1 and 2 mean one and two edges before. In the first 512 samples all lines are taken
 * as the same. The largest errors are those of quadrature and duty, and some forty samples teach
 * them. Lines that differ take a second. The angle is extrapolated from the edge with
 * w, hence the second term. No estimate enters, because an observer would follow the offsets and
 * hide them. The shaft's acceleration is independent of the edge and averages out.
 *
 * @param edges     Learned offsets.
 * @param s         This sample, with edge_gap_s > 0.
 * @param count_rad Nominal angle from edge to edge. An offset is at most half of it.
 * @param ts_s      Control period [s].
 * @return The offset [rad] in the sample's angle, at most 2 counts; 0 without an edge.
 *
 * Context: control ISR. One division.
 */
CTL_PART float encoder_form_learn(encoder_form_edges_t *edges, const drive_sample_t *s,
                                  float count_rad, float ts_s);

/** Interrupts the sequence: the next edge is not adjacent to the last ones. */
CTL_PART void encoder_form_skip(encoder_form_edges_t *edges);

/**
 * @brief encoder_form_error_rad() without the edge error, limited by the gate.
 *
 * Samples without edge times stay unchanged. A sample that the gate ignores teaches nothing.
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

/** The estimated angle, with the jump of an ignored sample: a used one has none. */
static inline float encoder_form_jumped_rad(const angle_gate_result_t *angle, float theta_hat_rad)
{
    return angle->used ? theta_hat_rad : frames_wrap(theta_hat_rad + angle->jump_rad);
}

/**
 * @brief Corrects with an edge that comes once in T > Ts, or with the angle range after it.
 *
 * An edge represents T / Ts samples, so the gains of one sample are multiplied by that. Each gain
 * is limited to a share of the value that explains the whole error e alone. The error may be one of
 * the angle, of the speed since the previous edge, or of the acceleration since then.
 *
 *     theta^ += min(k_theta T / Ts, 1) e
 *     w^     += min(k_w T / Ts, s_w / T) e
 *     d_w^   += min(k_d T / Ts, s / T^2) e, the other estimates in proportion    EQ-ENCODER-FORM-2
 *     T = min(gap, count / |w^|), at least Ts
 *     s_w = 0.33 T / Ts within 0.5 .. 1;  s = k_d Ts^2 within 0.15 .. 0.5
 *     an edge or more in each sample: the gains of one sample
 *
 * T is limited by the speed. A shaft that starts after a long rest moved in a part of the gap only.
 * With one or two edges in each sample, the gap before two of them is longer than Ts, but no sample
 * was without an edge.
 *
 * @param est           Estimates. The speed gets the part above its gain of one sample.
 * @param theta_hat_rad Estimated angle. It gets the part above its gain of one sample.
 * @param gains         Gains of one sample.
 * @param error_rad     encoder_form_error_rad().
 * @param gap_s         drive_sample_t.edge_gap_s, > 0.
 * @param ts_s          Control period [s].
 * @return Share of the error for the observer's correction with its gains of one sample.
 *
 * Context: control ISR. One division at the most.
 */
CTL_PART float encoder_form_correct_rare(nodo_t *est, float *theta_hat_rad,
                                         const encoder_form_gains_t *gains, float error_rad,
                                         float gap_s, float ts_s);

/**
 * @brief Returns the prediction as the law's view.
 *
 * A frozen angle appears as an implausibly large load.
 *
 * @param limits          Limits of plausibility.
 * @param est             Predicted estimates; must outlive the view.
 * @param theta_hat_rad   Predicted angle.
 * @param angle_error_rad Angle error of this sample.
 * @param ts_s            Control period [s].
 *
 * Context: control ISR.
 */
static inline near_optimal_view_t encoder_form_view(const encoder_form_limits_t *limits,
                                                    nodo_t *est, float theta_hat_rad,
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
