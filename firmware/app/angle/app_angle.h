/* SPDX-License-Identifier: MIT */
/**
 * @file app_angle.h
 * @brief Encoder position to electrical angle and speed, and what the angle is worth.
 *
 *     theta_e = theta_zero + n_p (2 (position - zero) + 1) pi / N, in [0, 2 pi)     EQ-APP-ANGLE-1
 *     omega_e = n_p (position - position before) 2 pi / (N Ts)                     EQ-APP-ANGLE-2
 *
 * with N positions per turn. With the times of the edges, those of the last edge of a period at the age a, and of the last
 * one before it at t_before earlier,
 *
 *     omega_e = n_p (edge - edge before) 2 pi / (N t_before)                       EQ-APP-ANGLE-3
 *     theta_e = theta at that edge + omega_e a, within the count                   EQ-APP-ANGLE-4
 *
 * Without times, a count alone in four periods has its edge in the middle of its own: EQ-APP-ANGLE-3, 4 with a = Ts / 2.
 * Where counts come more often they have EQ-APP-ANGLE-1, whose error is even within half a count: a difference below a quarter of one says little
 * and is let go.                                                                     EQ-APP-ANGLE-5
 *
 * A period without an edge says that the angle is within the count, and that the speed is at most one count in the time
 * since the last edge.
 *
 * A count stands for its middle. The angle means nothing until it is referenced: by the index mark, whose
 * electrical angle is a constant of the motor and its encoder, or by alignment.
 *
 * Later index pulses check the counter. A small difference is put right: the counter has missed edges, and the
 * index is the better witness; the rest of the turn would be driven at a wrong angle otherwise. A larger
 * one is a fault: torque would step, and index or counter is broken. The speed is the difference of raw positions,
 * so a correction does not show in it. Once there was an index, one has to come in every turn.
 *
 * A position that jumps says that counts were lost or read wrong: the reference is dropped, in every mode. A drive that
 * runs goes on with the angle that it has and the next index sets it right; without one the next run aligns anew.
 */
#ifndef APP_ANGLE_H
#define APP_ANGLE_H

#include "base.h"
#include "board.h"
#include "drive_config.h"

typedef struct {
    float    index_theta_e_rad;     /**< electrical angle at the index mark, [0, 2 pi) */
    uint16_t index_tolerance_cnt;   /**< width of the mark: no correction up to here */
    uint16_t index_correct_max_cnt; /**< a larger difference is a fault; >= the tolerance */
    uint16_t
        jump_cnt; /**< no shaft changes its counts of a period by more from one period to the next; > 0 */
} app_angle_config_t;

typedef enum {
    APP_ANGLE_NONE = 0, /**< the angle means nothing */
    APP_ANGLE_ALIGNED,  /**< found by turning the motor */
    APP_ANGLE_INDEX     /**< measured from the index mark */
} app_angle_reference_t;

typedef struct {
    const app_angle_config_t *config;
    uint16_t                  pole_pairs;
    uint16_t                  positions; /**< per turn */
    bool                      edge_times;
    float                     ts_s;
    float                     half_cnt_per_turn;
    float                     turns_per_half_cnt;
    float                     rad_per_half_cnt; /**< electrical, without the pole pairs */
    float                     rad_per_cnt;      /**< electrical */
    float                     radps_per_cnt;
    app_angle_reference_t     reference;
    uint16_t                  zero_cnt;       /**< position at which the angle is zero_theta_rad */
    float                     zero_theta_rad; /**< [0, 2 pi) */
    uint16_t                  before_cnt;
    bool                      have_before;
    int16_t                   turned_cnt; /**< of the period before */
    bool                      have_turned;
    int32_t                   since_index_cnt; /**< turned since the last index */
    bool                      have_index;      /**< there was one since the start */
    uint16_t                  jumps;           /**< since the start; stays at 65535 */
    bool                      have_edge;       /**< the next three mean something */
    uint16_t                  edge_cnt; /**< position that the last edge with a time begins */
    float                     edge_age_s;
    float                     edge_gap_s; /**< between the last two edges; 0: not known */
    float                     edge_speed_e_radps;
    uint16_t                  corrections; /**< by later index pulses since the start; wraps */
} app_angle_t;

typedef struct {
    float   theta_e_rad; /**< 0 .. 2 pi */
    float   band_rad;    /**< differences up to here say nothing; 0: theta_e_rad is a measurement */
    int16_t edge_of_line; /**< which of a line's edges theta_e_rad rests on, 1 .. 4; 0: none */
    float
          edge_gap_s; /**< between the last two edges, or since the last one when that is longer; 0 without edge times */
    float edge_age_s;    /**< since the edge of edge_of_line; 0: none */
    float omega_e_radps; /**< 0 unless speed_valid */
    bool  speed_valid;   /**< the sample before was valid too */
    bool
        index_fault; /**< the index came where it cannot be, or not at all; the reference is dropped */
} app_angle_reading_t;

/** @return CTL_BAD_CONFIG, a unusable, when a constant is out of range. Context: init. */
ctl_status_t app_angle_init(app_angle_t *a, const app_angle_config_t *config,
                            const drive_config_t *drive);

/**
 * @brief One sample, valid and with positions within a turn.
 *
 * Context: control ISR, once per tick. At most one division.
 */
void app_angle_update(app_angle_t *a, const board_sample_t *raw, app_angle_reading_t *reading);

/** The rotor stands at this angle, in [0, 2 pi). Context: control ISR. */
void app_angle_align(app_angle_t *a, uint16_t position_cnt, float theta_e_rad);

/** Counts may have been lost: no reference, and no speed from the next sample. Context: control ISR. */
void app_angle_drop(app_angle_t *a);

/** Counts from one position to another the short way round. */
int16_t app_angle_turned_cnt(uint16_t positions, uint16_t from_cnt, uint16_t to_cnt);

#endif /* APP_ANGLE_H */
