/* SPDX-License-Identifier: MIT */
/**
 * @file near_optimal.h
 * @brief Common part of the near optimal laws: references, tracking error, feed-forward.
 *
 *     u = -Lambda(e) e - d_dq + u_ff                                       EQ-DRIVE-1, paper A (42)
 *
 * A law adds its observer and its feedback. It calls near_optimal_error() before the feedback and
 * near_optimal_answer() after it. A law that takes positions has near_optimal_position.h too.
 */
#ifndef NEAR_OPTIMAL_H
#define NEAR_OPTIMAL_H

#include "base.h"
#include "current_ref.h"
#include "drive_config.h"
#include "inertia.h"
#include "nosc.h"
#include "position_loop.h"
#include "speed_ref.h"

typedef struct {
    current_ref_config_t current_ref;
    nosc_gains_t         nosc;     /**< conventional: Lambda_00 alone, for EQ-NOSC-3 */
    position_gains_t     position; /**< only for a drive that takes positions */
} near_optimal_config_t;

/** Kind of the references of the last period. */
typedef enum {
    NEAR_OPTIMAL_SPEED = 0,
    NEAR_OPTIMAL_POSITION,
    NEAR_OPTIMAL_TORQUE
} near_optimal_follows_t;

typedef struct {
    near_optimal_follows_t follows;
    float          theta_error_e_rad; /**< of a position run: limited error to position_ref */
    speed_ref_t    speed_ref;         /**< in a position run the speed of position_ref */
    current_ref_t  current_ref;
    position_ref_t position_ref;
    inertia_t      inertia; /**< learned in position runs */
} near_optimal_t;

/** View of the observer, all of one instant. */
typedef struct {
    nodo_t     *est;         /**< disturbance estimates; a position run adds to d_omega */
    nodo_meas_t now;         /**< speed and currents: measured, or predicted */
    float       d_omega_dot; /**< d_w' [rad/s^3]; 0: unknown */
    float       theta_rad;   /**< as law_output_t */
    bool        plausible;   /**< as law_output_t */
} near_optimal_view_t;

/** True if all constants are in range and agree with the drive's limit and rate. Context: init. */
CTL_PART bool near_optimal_check(const near_optimal_config_t *c, const drive_config_t *drive);

/** Starts the references at the present speed with zero current. */
CTL_PART void near_optimal_reset(near_optimal_t *s, const near_optimal_config_t *c,
                                 float omega_e_radps);

/** For law_t.counts_ok. */
static inline bool near_optimal_counts_ok(const near_optimal_config_t *c)
{
    return nosc_order_ok(&c->nosc) && nosc_order_ok(&c->position.nosc);
}

/**
 * @brief Updates the references of a speed run and returns the tracking error with its speed part
 * limited.
 *
 * Context: control ISR. Cost: speed_ref_update() plus current_ref_update().
 */
CTL_PART nosc_error_t near_optimal_error(near_optimal_t *s, const near_optimal_config_t *c,
                                         const drive_config_t      *drive,
                                         const near_optimal_view_t *view, const law_input_t *in);

/**
 * @brief Feedback plus feed-forward, EQ-DRIVE-1, and the other members of the answer.
 *
 * Outside the circle, EQ-VOLTAGE-2 replaces this voltage: cutting its length is stable (voltage.h).
 * current_clamp.h limits either voltage against currents beyond the limit.
 *
 * Context: control ISR. Outside the circle a division and a square root, beyond the current limit
 * one more of each.
 */
CTL_PART void near_optimal_answer(const near_optimal_t *s, const near_optimal_config_t *c,
                                  const motor_reduced_t *m, const near_optimal_view_t *view,
                                  const nosc_error_t *e, dq_t feedback_V, const law_input_t *in,
                                  law_output_t *out);

/**
 * @brief Both calls with the feedback of nosc.h between them: the period after the observer.
 *
 * Inline, as it contains only calls. Context: control ISR.
 */
static inline void near_optimal_step(near_optimal_t *s, const near_optimal_config_t *c,
                                     const drive_config_t *drive, const near_optimal_view_t *view,
                                     const law_input_t *in, law_output_t *out)
{
    const nosc_error_t e = near_optimal_error(s, c, drive, view, in);

    near_optimal_answer(s, c, &drive->motor, view, &e, nosc_feedback_V(&c->nosc, &e), in, out);
}

#endif /* NEAR_OPTIMAL_H */
