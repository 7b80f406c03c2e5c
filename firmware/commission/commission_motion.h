/* SPDX-License-Identifier: MIT */
/**
 * @file commission_motion.h
 * @brief Inertia and friction from windows of a run in which the shaft was driven or left alone.
 *
 * Between two instants, with the torque's integral from measured currents:
 *
 *     J (w1 - w0) = int T - B (theta1 - theta0) - C sign(w) (t1 - t0)                    EQ-COMMISSION-11
 *
 * Windows without current give B / J and C / J: torque that is a little wrong cannot hide what friction does. Windows with
 * current then give J, as one quotient. Speeds are those of whole counts around the instant, as many before as after it.
 */
#ifndef COMMISSION_MOTION_H
#define COMMISSION_MOTION_H

#include "commission_types.h"

#define COMMISSION_WINDOWS 64

/** Mechanical units. */
typedef struct {
    float speed_radps; /**< gained */
    float way_rad;     /**< turned */
    float time_s;      /**< with the sign of the speed */
    float iq_As;       /**< integrals */
    float idiq_A2s;
    bool  driven;
} commission_window_t;

typedef struct {
    commission_window_t windows[COMMISSION_WINDOWS];
    int16_t             count;
    /* The run of windows that is being taken. */
    bool    driven;
    int32_t length_ticks;
    int32_t around_ticks; /**< before and after an instant, for its speed */
    int32_t ticks;        /**< to the next instant, then from it */
    int32_t early_cnt;
    int32_t mark_cnt; /**< position at the instant */
    int32_t last_cnt; /**< the same of the instant before */
    float   last_radps;
    float   iq_As;
    float   idiq_A2s;
    float   closed_iq_As; /**< integrals from instant to instant */
    float   closed_idiq_A2s;
    bool    have_last;
} commission_motion_t;

/** No windows. */
void commission_motion_start(commission_motion_t *m);

/** Windows of so many periods begin, the first one after `settle` of them. */
void commission_motion_begin(commission_motion_t *m, bool driven, int32_t length_ticks,
                             int32_t settle_ticks);

/** One period; i of this sample. */
void commission_motion_tick(commission_motion_t *m, const commission_config_t *c,
                            const commission_result_t *known, int32_t position_cnt, dq_t i_A);

/** EQ-COMMISSION-11. @return false: the windows do not say it. */
bool commission_motion_solve(const commission_motion_t *m, commission_result_t *found);

/** Torque of integrals of i_q and i_d i_q [N m s], or of the values themselves [N m]. */
float commission_motion_torque(const commission_result_t *known, float iq, float idiq);

#endif /* COMMISSION_MOTION_H */
