/* SPDX-License-Identifier: MIT */
/**
 * @file speed_ref.h
 * @brief Reference model: time-optimal speed profile within limits on acceleration and jerk.
 *
 * The voltage that changes the q current is the voltage limit minus the back-EMF in one direction,
 * and plus the back-EMF in the other one. Therefore w_d'' has two limits, -j_down and j_up.
 *
 * Let j be the jerk that ends the acceleration: j_down below the command, j_up above it. With
 * period Ts, the largest acceleration that still ends at the command is
 *
 *     a* = sqrt((j Ts / 2)^2 + 2 j |command - w_d|) - j Ts / 2                  EQ-SPEED-REF-1
 * or |command - w_d| / Ts if that is less. The reference follows
 *
 *     w_d'' = j_up or -j_down towards clamp(+-a*, lowest, highest acceleration) EQ-SPEED-REF-2
 *
 * The last step may pass the command by j Ts^2 / 8; the end is exact. Both derivatives are
 * available without differentiation.
 */
#ifndef SPEED_REF_H
#define SPEED_REF_H

#include "base.h"
#include "fpu.h"

typedef struct {
    float omega_e_radps;         /**< w_d, electrical */
    float omega_dot_e_radps2;    /**< w_d' */
    float omega_2dot_e_radps3;   /**< w_d'' over the last step */
    float accel_wanted_e_radps2; /**< w_d' requested by the command, before limits */
} speed_ref_t;

/** Present limits of the drive. */
typedef struct {
    float accel_hi_e_radps2;  /**< highest acceleration */
    float accel_lo_e_radps2;  /**< lowest (most negative) acceleration */
    float jerk_up_e_radps3;   /**< highest w_d'', > 0 */
    float jerk_down_e_radps3; /**< highest -w_d'', > 0 */
    float near_e_radps;       /**< largest distance of w_d from the speed, > 0 */
    float samples_1ps;        /**< 1 / Ts */
} speed_ref_limits_t;

/** Starts at the given speed, without acceleration. */
void speed_ref_reset(speed_ref_t *r, float omega_e_radps);

/* Inline, because its arguments would cost as much as its arithmetic. */

/** EQ-SPEED-REF-1 with the sign of the distance; jerk_step = j Ts. */
static inline float speed_ref_stopping_acceleration(float distance, float jerk_step,
                                                    float samples_1ps)
{
    const float at_once = fabsf(distance) * samples_1ps;
    const float half    = 0.5f * jerk_step;
    const float accel   = (at_once > jerk_step)
                              ? (fpu_root((half * half) + (2.0f * jerk_step * at_once)) - half)
                              : at_once; /* the last step lands on the command */
    return (distance < 0.0f) ? -accel : accel;
}

/**
 * @brief Advances by one period towards the command.
 *
 * @param r               Reference, updated in place.
 * @param limits          Present limits of the drive.
 * @param command_e_radps Commanded electrical speed.
 * @param omega_e_radps   Actual speed. A reference outside limits->near_e_radps waits for it.
 * @param ts_s            Control period [s].
 *
 * Context: control ISR. No division, one square root.
 */
static inline void speed_ref_update(speed_ref_t *r, const speed_ref_limits_t *limits,
                                    float command_e_radps, float omega_e_radps, float ts_s)
{
    const float up_step   = limits->jerk_up_e_radps3 * ts_s;
    const float down_step = limits->jerk_down_e_radps3 * ts_s;
    const float before    = r->omega_dot_e_radps2;
    const float distance  = command_e_radps - r->omega_e_radps;
    const float wanted    = speed_ref_stopping_acceleration(
           distance, (distance > 0.0f) ? down_step : up_step, limits->samples_1ps);
    const float allowed = base_clamp(wanted, limits->accel_lo_e_radps2, limits->accel_hi_e_radps2);
    const float accel   = base_clamp(allowed, before - down_step, before + up_step);

    r->accel_wanted_e_radps2 = wanted;
    r->omega_2dot_e_radps3   = (accel - before) * limits->samples_1ps; /* EQ-SPEED-REF-2: over Ts */
    r->omega_dot_e_radps2    = accel;
    r->omega_e_radps =
        base_clamp(r->omega_e_radps + (ts_s * accel), omega_e_radps - limits->near_e_radps,
                   omega_e_radps + limits->near_e_radps);
}

#endif /* SPEED_REF_H */
