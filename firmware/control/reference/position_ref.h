/* SPDX-License-Identifier: MIT */
/**
 * @file position_ref.h
 * @brief Reference model of a position: time-optimal within limits on speed, acceleration and jerk.
 *
 * The stopping distance s(w, a) of a shaft with speed w and acceleration a is given below. The
 * acceleration falls with the jerk j to the deceleration, and returns to zero. Both limits are used
 * to 99 %. With t = a / j and w_1 = w + a t / 2, the speed at which a is zero,
 *
 *     s(w, a) = t (w + a t / 3) + s_1(w_1),   s_1 = w_1 sqrt(w_1 / j)      for w_1 j <= a_dec^2
 *                                             s_1 = w_1 (w_1 / a_dec + a_dec / j) / 2  beyond
 *     with opposite signs if w + a |t| / 2 < 0                                 EQ-POSITION-REF-1
 *
 * The jerk is constant in a period. It is the largest one towards the target for which, a period
 * later,
 *
 *     |a| <= a_acc or a_dec,   the speed that follows <= w_max,
 *     s(w, a) <= way to the target                                           EQ-POSITION-REF-2
 *
 * While the shaft brakes, the third condition holds with equality. Two steps of false position then
 * find the jerk, and the next period corrects their error. The end is exact. Limits and target may
 * change at any time.
 *
 * The limits of a profile are those of what is there. With the share s of the q current's limit
 * that is allowed now, and d_0 = d_w where the reference last rested,
 *
 *     a_now = clamp((1.8 s a_most - |d_0| - |d_w - d_0 - (1 - k) a_ref|) / max(k, 1),
 *                   0.05 a_most, a_most)                                      EQ-POSITION-REACH-1
 *     a_acc, a_dec <= the least a_now of the motion with a_now |way| >= w^2   EQ-POSITION-REACH-2
 *
 * k is the inertia (inertia.h). The jerk of a motion is divided by the max(k, 1) of its start.
 */
#ifndef POSITION_REF_H
#define POSITION_REF_H

#include "base.h"
#include "check.h"
#include "position.h"

/** Limits of a motion: for each, the smaller one of the operator's and the drive's. */
typedef struct {
    float speed_e_radps;  /**< > 0 */
    float accel_e_radps2; /**< while the speed grows, > 0 */
    float decel_e_radps2; /**< while it falls, > 0 */
    float jerk_e_radps3;  /**< > 0 */
} position_profile_t;

typedef struct {
    position_t at;
    float      omega_e_radps;
    float      omega_dot_e_radps2;
    float      omega_2dot_e_radps3; /**< over the last step */
    float      reach_e_radps2;      /**< acceleration that the profile may use; 0: not known */
    float      d_rest_e_radps2;     /**< d_w where the reference last rested */
    float      jerk_share;          /**< of the drive's jerk, by the inertia known there, (0, 1] */
    bool       arrived;             /**< rests at the target */
    bool       waits;               /**< waits for the shaft */
} position_ref_t;

/** A motion at one instant. */
typedef struct {
    position_t at;
    float      omega_e_radps;
    float      omega_dot_e_radps2;
    float      omega_2dot_e_radps3;
} position_motion_t;

/** Torque that is there, and what it has to move. */
typedef struct {
    float share;   /**< of the q current limit, what may brake in this period, 0 .. 1 */
    float d_omega; /**< disturbance of the speed equation [rad/s^2] */
    float inertia; /**< of the shaft over the drive's, > 0 */
} position_torque_t;

#define POSITION_LEAST                                                                             \
    1.0e-3f /**< least limit: far below any drive's, and quotients of limits stay finite */

/* Inline, so that a tick whose law takes no positions does not link this module. */

/** True if every limit is > 0 and at most that of `most`. Context: any. */
static inline bool position_profile_ok(const position_profile_t *p, const position_profile_t *most)
{
    return base_in_range(p->speed_e_radps, POSITION_LEAST, most->speed_e_radps) &&
           base_in_range(p->accel_e_radps2, POSITION_LEAST, most->accel_e_radps2) &&
           base_in_range(p->decel_e_radps2, POSITION_LEAST, most->decel_e_radps2) &&
           base_in_range(p->jerk_e_radps3, POSITION_LEAST, most->jerk_e_radps3);
}

/** True if every limit is > 0 and at most CHECK_LARGEST. Context: any. */
static inline bool position_profile_is_any(const position_profile_t *p)
{
    const position_profile_t most = {CHECK_LARGEST, CHECK_LARGEST, CHECK_LARGEST, CHECK_LARGEST};

    return position_profile_ok(p, &most);
}

/** Starts at a position with the given speed and acceleration. */
void position_ref_start(position_ref_t *r, const position_t *at, float omega_e_radps,
                        float omega_dot_e_radps2);

/**
 * @brief Limits of the next period, EQ-POSITION-REACH-1 and 2.
 *
 * @param r       Reference; its reach is updated.
 * @param asked   The operator's limits.
 * @param most    The drive's. Its acceleration takes half of the torque.
 * @param target  Target position.
 * @param torque  Available torque.
 *
 * Context: control ISR. One division.
 */
position_profile_t position_ref_profile(position_ref_t *r, const position_profile_t *asked,
                                        const position_profile_t *most, const position_t *target,
                                        const position_torque_t *torque);

/**
 * @brief Advances by one period.
 *
 * @param r        Reference, updated in place.
 * @param profile  Limits.
 * @param target   Target position.
 * @param is       Shaft position. A reference further away than near_rad waits for the shaft.
 * @param near_rad > 0.
 * @param ts_s     Control period [s].
 *
 * Context: control ISR. At most nine divisions and six square roots.
 */
void position_ref_update(position_ref_t *r, const position_profile_t *profile,
                         const position_t *target, const position_t *is, float near_rad,
                         float ts_s);

/**
 * @brief Takes a motion as the reference. It never arrives.
 *
 * @param r        Reference, updated in place.
 * @param motion   Position, speed, acceleration and jerk of this period.
 * @param is       Shaft position, as above.
 * @param near_rad > 0.
 *
 * Context: control ISR. No division.
 */
void position_ref_take(position_ref_t *r, const position_motion_t *motion, const position_t *is,
                       float near_rad);

#endif /* POSITION_REF_H */
