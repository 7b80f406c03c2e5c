/* SPDX-License-Identifier: MIT */
/**
 * @file commission_motion.h
 * @brief Inertia and friction from time windows of a run, with the shaft driven or coasting.
 *
 * Between two instants, with the torque's integral from measured currents:
 *
 *     J (w1 - w0) = int T - B (theta1 - theta0) - C sign(w) (t1 - t0)                    EQ-COMMISSION-11
 *
 * Windows without current give B / J and C / J: a torque error cannot hide friction there. Windows
 * with current then give J as one quotient. The speed at an instant is the mean over an equal
 * number of periods before and after it.
 */
#ifndef COMMISSION_MOTION_H
#define COMMISSION_MOTION_H

#include "commission_types.h"

#define COMMISSION_WINDOWS 62 /**< chosen: what the data of noc_h leave room for */

/** One window, in mechanical units. */
typedef struct {
    float speed_radps; /**< change of speed */
    float way_rad;     /**< angle turned */
    float time_s;      /**< with the sign of the speed */
    float iq_As;       /**< integrals */
    float idiq_A2s;
    bool  driven;
} commission_window_t;

typedef struct {
    commission_window_t windows[COMMISSION_WINDOWS];
    int16_t             count;
    /* State of the present series of windows. */
    bool    driven;
    int32_t length_ticks;
    int32_t around_ticks; /**< periods before and after an instant for its speed */
    int32_t ticks;        /**< to the next instant, then from it */
    int32_t early_cnt;
    int32_t mark_cnt; /**< position at the instant */
    int32_t last_cnt; /**< position at the previous instant */
    float   last_radps;
    float   iq_As;
    float   idiq_A2s;
    float   closed_iq_As; /**< integrals from instant to instant */
    float   closed_idiq_A2s;
    bool    have_last;
} commission_motion_t;

/** Removes all windows. */
void commission_motion_start(commission_motion_t *m);

/** Begins windows of `length_ticks` periods. The first one starts after `settle_ticks` periods. */
void commission_motion_begin(commission_motion_t *m, bool driven, int32_t length_ticks,
                             int32_t settle_ticks);

/** Adds one period with the current of this sample. Context: control ISR. */
void commission_motion_tick(commission_motion_t *m, const commission_config_t *c,
                            const commission_result_t *known, int32_t position_cnt, dq_t i_A);

/* Parts of the solution: one of them is enough work for a period. The third one is inertia and
 * friction. */
#define COMMISSION_MOTION_ROUGH   0 /**< inertia without friction */
#define COMMISSION_MOTION_SLOWING 1 /**< friction per inertia; `found` has it until the third */

/**
 * @brief Computes a part of inertia and friction, EQ-COMMISSION-11, in their order.
 *
 * @return COMMISSION_BUSY: the next part follows. COMMISSION_FAILED: the windows do not suffice.
 */
commission_step_t commission_motion_solve(const commission_motion_t *m, int32_t part,
                                          commission_result_t *found);

/** Torque integral [N m s] from integrals of i_q and i_d i_q; torque [N m] from their values. */
float commission_motion_torque(const commission_result_t *known, float iq, float idiq);

#endif /* COMMISSION_MOTION_H */
