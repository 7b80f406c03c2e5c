/* SPDX-License-Identifier: MIT */
/**
 * @file noc_torque.h
 * @brief Law noc follows a torque.
 *
 * The reference is known a period ahead. The feed-forward of its step takes the currents there in
 * one period, where the voltage is enough. The feedback then has the errors only. The torque of the
 * speed limit follows estimates: its steps are not fed forward.
 *
 * It is apart, because an image keeps it outside the fast memory: a period of a speed run then has
 * nothing of it.
 */
#ifndef NOC_TORQUE_H
#define NOC_TORQUE_H

#include "laws.h"

/** Errors of the currents with their gains, EQ-TORQUE-3. */
typedef struct {
    nosc_error_t e; /**< without a speed error */
    dq_t         gain_VpA;
} noc_torque_error_t;

/**
 * @brief As near_optimal_error(), with the current references of a torque.
 *
 * The speed reference follows the speed, so that a speed run can begin from here.
 *
 * @param in With a torque.
 *
 * Context: control ISR. Cost: current_ref_update().
 */
noc_torque_error_t noc_torque_error(law_noc_state_t *s, const law_noc_config_t *c,
                                    const drive_config_t *drive, const near_optimal_view_t *view,
                                    const law_input_t *in);

/**
 * @brief The period after the observer: references, EQ-TORQUE-3, feed-forward and limits.
 *
 * Outside the circle the d voltage has priority, because it holds the flux. The q voltage gets the
 * rest, up to the corner of the hexagon.                                          EQ-TORQUE-4
 *
 * Context: control ISR. A square root outside the circle.
 */
void noc_torque_step(law_noc_state_t *s, const law_noc_config_t *c, const drive_config_t *drive,
                     const near_optimal_view_t *view, const law_input_t *in, law_output_t *out);

#endif /* NOC_TORQUE_H */
