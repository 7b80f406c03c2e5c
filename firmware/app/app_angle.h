/* SPDX-License-Identifier: MIT */
/**
 * @file app_angle.h
 * @brief Encoder position to electrical angle and speed, and what the angle is worth.
 *
 *     theta_e = theta_zero + n_p (2 (position - zero) + 1) pi / N, in [0, 2 pi)     EQ-APP-ANGLE-1
 *     omega_e = n_p (position - position before) 2 pi / (N Ts)                     EQ-APP-ANGLE-2
 *
 * with N = BOARD_POSITIONS.
 *
 * A count stands for its middle. The angle means nothing until it is referenced: by the index mark, whose
 * electrical angle is a constant of the motor and its encoder, or by alignment.
 *
 * Later index pulses check the counter. A small difference is put right: the counter has missed edges, and the
 * index is the better witness; the rest of the turn would be driven at a wrong angle otherwise. A larger
 * one is a fault: torque would step, and index or counter is broken. The speed is the difference of raw positions,
 * so a correction does not show in it.
 */
#ifndef APP_ANGLE_H
#define APP_ANGLE_H

#include "base.h"

typedef struct {
    uint16_t pole_pairs;            /**< 1 .. 64 */
    float    index_theta_e_rad;     /**< electrical angle at the index mark, [0, 2 pi) */
    uint16_t index_tolerance_cnt;   /**< width of the mark: no correction up to here */
    uint16_t index_correct_max_cnt; /**< a larger difference is a fault; >= the tolerance */
} app_angle_config_t;

typedef enum {
    APP_ANGLE_NONE = 0, /**< the angle means nothing */
    APP_ANGLE_ALIGNED,  /**< found by turning the motor */
    APP_ANGLE_INDEX     /**< measured from the index mark */
} app_angle_reference_t;

typedef struct {
    const app_angle_config_t *config;
    float                     rad_per_half_cnt; /**< electrical, without the pole pairs */
    float                     radps_per_cnt;
    app_angle_reference_t     reference;
    uint16_t                  zero_cnt;       /**< position at which the angle is zero_theta_rad */
    float                     zero_theta_rad; /**< [0, 2 pi) */
    uint16_t                  before_cnt;
    bool                      have_before;
    uint16_t                  corrections; /**< by later index pulses since the start; wraps */
} app_angle_t;

typedef struct {
    float theta_e_rad;   /**< 0 .. 2 pi */
    float omega_e_radps; /**< 0 unless speed_valid */
    bool  speed_valid;   /**< the sample before was valid too */
    bool  index_fault;   /**< the index came where it cannot be; the reference is dropped */
} app_angle_reading_t;

/** @return CTL_BAD_CONFIG, a unusable, when a constant is out of range. Context: init. */
ctl_status_t app_angle_init(app_angle_t *a, const app_angle_config_t *config, float ts_s);

/**
 * @brief One valid sample.
 *
 * @param position_cnt Position, < BOARD_POSITIONS.
 * @param index_seen   An index pulse came since the sample before.
 * @param index_cnt    Position at that pulse, < BOARD_POSITIONS; ignored otherwise.
 *
 * Context: control ISR, once per tick. One integer division.
 */
app_angle_reading_t app_angle_update(app_angle_t *a, uint16_t position_cnt, bool index_seen,
                                     uint16_t index_cnt);

/** The rotor's d axis stands at phase a, here. Context: control ISR. */
void app_angle_align(app_angle_t *a, uint16_t position_cnt);

/** Counts may have been lost: no reference, and no speed from the next sample. Context: control ISR. */
void app_angle_drop(app_angle_t *a);

/** Counts from one position to another the short way round. */
int16_t app_angle_turned_cnt(uint16_t from_cnt, uint16_t to_cnt);

#endif /* APP_ANGLE_H */
