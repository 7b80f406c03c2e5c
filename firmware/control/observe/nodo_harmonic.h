/* SPDX-License-Identifier: MIT */
/**
 * @file nodo_harmonic.h
 * @brief The encoder-form observer with models of angle-periodic disturbances.
 *
 * A harmonic of electrical order h is a pair (a, b) that turns h times as fast as the rotor. It
 * keeps its phase to the angle at any speed:
 *
 *     (a, b)^(k+1) = keep R(h dtheta) (a, b)^(k)                                   EQ-HARMONIC-1
 *
 * SENSOR     current sensors: (a, b) = (d, q) error of the measured current. An offset stands
 *            still in the stator frame (h = -1), unequal gains turn backwards in it (h = -2).
 * TORQUE     a adds to d_w: cogging.
 * VOLTAGE_Q  a adds to d_q, VOLTAGE_D a adds to d_d: dead time (h = 6).
 *
 *     y = [iq + sum b, id + sum a, theta]  over the SENSOR pairs                      EQ-HARMONIC-2
 *     correction with K = G_0(|w|) + iq G_1(|w|), linear between nodes of sqrt|w|     EQ-HARMONIC-3
 *     prediction: EQ-NODO-ENCODER-2 with all disturbances of mid-period               EQ-HARMONIC-4
 *
 * For w < 0 the motor is the mirror image of itself at -w: signs of the odd signals change, gains
 * stay. The estimated currents are the true ones, without the sensor errors.
 */
#ifndef NODO_HARMONIC_H
#define NODO_HARMONIC_H

#include "base.h"
#include "motor.h"
#include "nodo.h"

#define NODO_HARMONIC_PAIRS_MAX 8
#define NODO_HARMONIC_NODES_MAX 17
#define NODO_HARMONIC_N_BASE    8 /**< rows: nodo_encoder.h's seven, then d_w' */
#define NODO_HARMONIC_N_X_MAX   (NODO_HARMONIC_N_BASE + (2 * NODO_HARMONIC_PAIRS_MAX))
#define NODO_HARMONIC_N_G       6 /**< G_0 then G_1, columns measured iq, id, theta */

/** Largest turn of a pair per period [rad]; a faster pair decays. Six samples per period of a
 * harmonic are
 *  too few to compensate it, and the inertia filters its effect. */
#define NODO_HARMONIC_TURN_MAX 1.0f

typedef enum {
    NODO_HARMONIC_SENSOR = 0,
    NODO_HARMONIC_TORQUE,
    NODO_HARMONIC_VOLTAGE_Q,
    NODO_HARMONIC_VOLTAGE_D
} nodo_harmonic_channel_t;

typedef struct {
    nodo_harmonic_channel_t channel;
    float                   order; /**< h, turns per electrical turn */
} nodo_harmonic_order_t;

typedef struct {
    /** K: one row per state; the nodes are adjacent in it. First, because each element is read in
     * every period. */
    float                 gain[NODO_HARMONIC_N_X_MAX][NODO_HARMONIC_NODES_MAX][NODO_HARMONIC_N_G];
    int16_t               n_pairs;        /**< 0 .. NODO_HARMONIC_PAIRS_MAX */
    int16_t               n_nodes;        /**< 2 .. NODO_HARMONIC_NODES_MAX */
    float                 iq_max_A;       /**< the series is used for |iq^| <= this; > 0 */
    float                 nodes_per_root; /**< node = this times sqrt|w|, > 0 */
    float                 keep;           /**< factor of a pair per period, (0, 1] */
    float                 keep_fast;      /**< the same beyond NODO_HARMONIC_TURN_MAX, (0, 1] */
    nodo_harmonic_order_t pair[NODO_HARMONIC_PAIRS_MAX];
} nodo_harmonic_gains_t;

/** A pair turned to one instant. */
typedef struct {
    float a;
    float b;
} nodo_harmonic_pair_t;

typedef struct {
    nodo_t               base;            /**< constants and states, without the pairs */
    float                slope;           /**< d_w' */
    float                theta_rad;       /**< estimated electrical angle, within +-pi */
    float                theta_pairs_rad; /**< angle at which the pairs are valid, within +-pi */
    nodo_harmonic_pair_t pair[NODO_HARMONIC_PAIRS_MAX];
} nodo_harmonic_t;

/** All disturbances, as the law needs them. */
typedef struct {
    nodo_t total; /**< base with the pairs added: d_w of the instant of the prediction, d_q and d_d
                                      of the middle of the period after it */
    float  d_omega_dot; /**< d_w' in the middle of that period [rad/s^3] */
} nodo_harmonic_view_t;

/** True if the numbers of pairs and nodes are within the table. Context: control ISR. */
CTL_PART bool nodo_harmonic_counts_ok(const nodo_harmonic_gains_t *g);

/** true when every constant is finite and within its documented range. Context: init. */
CTL_PART bool nodo_harmonic_check(const nodo_harmonic_gains_t *g);

/** Starts at the measurement, with all harmonics zero. */
CTL_PART void nodo_harmonic_reset(nodo_harmonic_t *s, const nodo_meas_t *y, float theta_rad);

/**
 * @brief Corrects with a sample, EQ-HARMONIC-2, 3.
 *
 * @param s           State, corrected in place.
 * @param g           Gains, checked at init.
 * @param i_A         Measured current in the frame of the estimated angle.
 * @param angle_error Measured minus estimated angle [rad], within +-pi.
 *
 * Context: control ISR. One square root, 12 multiply-adds per state.
 */
CTL_PART void nodo_harmonic_correct(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g, dq_t i_A,
                                    float angle_error);

/**
 * @brief EQ-HARMONIC-1, 4: one period ahead with the voltage in force; view: what the law needs
 * there.
 *
 * Context: control ISR. One sine and cosine for each order, of neighbours in the list.
 */
CTL_PART void nodo_harmonic_predict(nodo_harmonic_t *s, const nodo_harmonic_gains_t *g,
                                    const motor_reduced_t *m, dq_t v_V, float ts_s,
                                    nodo_harmonic_view_t *view);

#endif /* NODO_HARMONIC_H */
