/* SPDX-License-Identifier: MIT */
/**
 * @file near_optimal_position.h
 * @brief near_optimal.h on the way to a position.
 *
 * It is apart, because an image keeps it outside the fast memory: a period of a speed run then has
 * nothing of it.
 */
#ifndef NEAR_OPTIMAL_POSITION_H
#define NEAR_OPTIMAL_POSITION_H

#include "near_optimal.h"

/**
 * @brief As near_optimal_error(). The angle error, in s, is limited with the speed error.
 *
 * @param in With a position.
 *
 * Context: control ISR. Cost: position_ref_update(), plus current_ref_update(). At the limits one
 * more division.
 */
nosc_error_t near_optimal_position_error(near_optimal_t *s, const near_optimal_config_t *c,
                                         const drive_config_t      *drive,
                                         const near_optimal_view_t *view, const law_input_t *in);

/** As near_optimal_answer(), with the gains of the position. Context: control ISR. */
void near_optimal_position_answer(const near_optimal_t *s, const near_optimal_config_t *c,
                                  const motor_reduced_t *m, const near_optimal_view_t *view,
                                  const nosc_error_t *e, dq_t feedback_V, const law_input_t *in,
                                  law_output_t *out);

/** Both with EQ-POSITION-3 between them: the period after the observer. Context: control ISR. */
void near_optimal_position_step(near_optimal_t *s, const near_optimal_config_t *c,
                                const drive_config_t *drive, const near_optimal_view_t *view,
                                const law_input_t *in, law_output_t *out);

#endif /* NEAR_OPTIMAL_POSITION_H */
