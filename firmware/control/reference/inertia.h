/* SPDX-License-Identifier: MIT */
/**
 * @file inertia.h
 * @brief Inertia of the shaft, learned from motions to a position.
 *
 * The observer believes one inertia. A shaft with k times that one, accelerated by a, shows
 *
 *     d_w = d_0 + (1 - k) a                                                        EQ-INERTIA-1
 *
 * with d_0 = d_w where the reference last rested. With the acceleration a_ref of the reference,
 * and a_g = 0.15 a_most, in each period with |a_ref| > a_g and a a_ref > 0
 *
 *     k -= 0.02 (d_w - d_0 - (1 - k) a) a_ref / (a_ref^2 + a_g^2)                  EQ-INERTIA-2
 *
 * within 0.5 .. 5. A load step without acceleration teaches nothing. The observer gets in advance
 * what the reference will ask for, and the errors get a gain g:
 *
 *     d_w += (1 - k) (a_ref - a_ref of the period before)                          EQ-INERTIA-3
 *     g = k below 1, (1 + k) / 2 above, at most g_most of the law                 EQ-INERTIA-4
 */
#ifndef INERTIA_H
#define INERTIA_H

#include "base.h"

#define INERTIA_LEAST 0.5f
#define INERTIA_MOST  5.0f

typedef struct {
    float ratio;          /**< k, INERTIA_LEAST .. INERTIA_MOST */
    float gain;           /**< g */
    float gain_most;      /**< g_most, >= 1 */
    float accel_e_radps2; /**< a_ref of the period before */
} inertia_t;

/** Values of one period. */
typedef struct {
    float asked_e_radps2; /**< a_ref */
    float seen_e_radps2;  /**< a, by the observer */
    float more_e_radps2;  /**< d_w - d_0 */
    float most_e_radps2;  /**< a_most: the largest acceleration of a motion, > 0 */
} inertia_seen_t;

/* Inline, so that a tick whose law takes no positions does not link a module. */

/** Believes the drive's inertia. */
static inline void inertia_reset(inertia_t *j)
{
    j->ratio          = 1.0f;
    j->gain           = 1.0f;
    j->gain_most      = INERTIA_MOST;
    j->accel_e_radps2 = 0.0f;
}

/** EQ-INERTIA-4 */
static inline float inertia_gain(float ratio)
{
    return base_min(ratio, 0.5f + (0.5f * ratio));
}

/** EQ-INERTIA-1, 2 and 4. Context: control ISR. At most one division. */
void inertia_learn(inertia_t *j, const inertia_seen_t *seen);

/** Addition to d_w in this period, EQ-INERTIA-3. Context: control ISR. No division. */
float inertia_ahead(inertia_t *j, float accel_e_radps2);

#endif /* INERTIA_H */
