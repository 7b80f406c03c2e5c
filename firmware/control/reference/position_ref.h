/* SPDX-License-Identifier: MIT */
/**
 * @file position_ref.h
 * @brief Reference model of a position: the fastest way to a target within speed, acceleration and jerk.
 *
 * The way on which a shaft with speed w and acceleration a comes to rest, its acceleration falling with the jerk j to the
 * deceleration and back (99 % of both), is with t = a / j and w_1 = w + a t / 2 (the speed of the point where a is zero)
 *
 *     s(w, a) = t (w + a t / 3) + s_1(w_1),   s_1 = w_1 sqrt(w_1 / j)              for w_1 j <= a_dec^2
 *                                             s_1 = w_1 (w_1 / a_dec + a_dec / j) / 2  beyond
 *     with the signs turned when w + a |t| / 2 < 0                             EQ-POSITION-REF-1
 *
 * A period has one jerk. It is the largest towards the target with which, a period later,
 *
 *     |a| <= a_acc or a_dec,   the speed that follows <= w_max,   s(w, a) <= way to the target     EQ-POSITION-REF-2
 *
 * The third is met with equality once the shaft has to brake: then the jerk is found by two steps of false position, and what
 * they leave is put right in the next period. The end is exact. Limits and target may change at any time.
 */
#ifndef POSITION_REF_H
#define POSITION_REF_H

#include "base.h"
#include "check.h"
#include "position.h"

/** Of the way to a target; the smaller ones of what an operator asks for and of what the drive can do. */
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
    bool       arrived;             /**< rests at the target */
    bool       waits;               /**< for the shaft */
} position_ref_t;

#define POSITION_LEAST                                                                             \
    1.0e-3f /**< of a limit: far below any drive's, and quotients of limits stay numbers */

/* Inline in C and C++, so that a tick whose law takes no positions needs nothing of this module. */

/** Every limit is a number > 0 and at most that of the other. Context: any. */
static inline bool position_profile_ok(const position_profile_t *p, const position_profile_t *most)
{
    return base_in_range(p->speed_e_radps, POSITION_LEAST, most->speed_e_radps) &&
           base_in_range(p->accel_e_radps2, POSITION_LEAST, most->accel_e_radps2) &&
           base_in_range(p->decel_e_radps2, POSITION_LEAST, most->decel_e_radps2) &&
           base_in_range(p->jerk_e_radps3, POSITION_LEAST, most->jerk_e_radps3);
}

/** The same of limits that nobody bounds: at most CHECK_LARGEST. Context: any. */
static inline bool position_profile_is_any(const position_profile_t *p)
{
    const position_profile_t most = {CHECK_LARGEST, CHECK_LARGEST, CHECK_LARGEST, CHECK_LARGEST};

    return position_profile_ok(p, &most);
}

/** Goes on from a position, with the speed and acceleration given. */
void position_ref_start(position_ref_t *r, const position_t *at, float omega_e_radps,
                        float omega_dot_e_radps2);

/**
 * @brief Advance by one period.
 *
 * @param r        Reference, updated in place.
 * @param profile  Limits.
 * @param target   Where to.
 * @param is       Where the shaft is: a reference further away than near_rad waits for it.
 * @param near_rad > 0.
 * @param ts_s     Control period [s].
 *
 * Context: control ISR. At most nine divisions and six square roots.
 */
void position_ref_update(position_ref_t *r, const position_profile_t *profile,
                         const position_t *target, const position_t *is, float near_rad,
                         float ts_s);

#endif /* POSITION_REF_H */
