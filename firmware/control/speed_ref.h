/* SPDX-License-Identifier: MIT */
/**
 * @file speed_ref.h
 * @brief Acceleration-limited speed reference.
 *
 * Paper A assumes below (5) that w_d changes slowly and uses its derivative in (6); a step has none.
 * The reference therefore moves to the commanded speed at no more than the acceleration that the
 * current limit can follow beside the rated load.                        EQ-SPEED-REF-1
 */
#ifndef SPEED_REF_H
#define SPEED_REF_H

#include "base.h"

typedef struct {
    float omega_e_radps;      /**< w_d, electrical */
    float omega_dot_e_radps2; /**< its derivative over the coming period */
} speed_ref_t;

/** Starts at the given speed, at rest in acceleration. */
void speed_ref_reset(speed_ref_t *r, float omega_e_radps);

/**
 * @brief Advance by one period towards the command.
 *
 * @param r                  Reference, updated in place.
 * @param command_e_radps    Commanded electrical speed.
 * @param accel_max_e_radps2 Largest |derivative|, > 0.
 * @param ts_s               Control period [s].
 *
 * The derivative is zero on the last, shorter step of a ramp. Context: control ISR. No division.
 */
void speed_ref_update(speed_ref_t *r, float command_e_radps, float accel_max_e_radps2, float ts_s);

#endif /* SPEED_REF_H */
