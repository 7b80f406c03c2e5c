/* SPDX-License-Identifier: MIT */
/**
 * @file position_torque.h
 * @brief Torque that a run to a position may use, and the inertia that the run shows.
 */
#ifndef POSITION_TORQUE_H
#define POSITION_TORQUE_H

#include "near_optimal.h"

/**
 * @brief Learns the inertia, EQ-INERTIA-1, 2 and 4, and returns the available torque.
 *
 * The acceleration is that of the reference; the observer shows what it takes.
 *
 * Context: control ISR, in a position run. Two divisions at most.
 */
position_torque_t position_torque(near_optimal_t *s, const near_optimal_config_t *c,
                                  const motor_reduced_t *m, const near_optimal_view_t *view);

#endif /* POSITION_TORQUE_H */
