/* SPDX-License-Identifier: MIT */
/**
 * @file app_angle.h
 * @brief Electrical angle and speed from the encoder, with the uncertainty of the angle.
 *
 *     theta_e = theta_zero + n_p (2 (position - zero) + 1) pi / N, in [0, 2 pi)     EQ-APP-ANGLE-1
 *     omega_e = n_p (position - position before) 2 pi / (N Ts)                     EQ-APP-ANGLE-2
 *
 * N is the number of positions per turn. With edge times, a is the age of a period's last edge. The
 * last edge of an earlier period came t_before earlier:
 *
 *     omega_e = n_p (edge - edge before) 2 pi / (N t_before)                       EQ-APP-ANGLE-3
 *     theta_e = theta at that edge + omega_e a, within the count                   EQ-APP-ANGLE-4
 *
 * Without edge times, two cases differ:                                             EQ-APP-ANGLE-5
 *
 * - At most one count in four periods: the edge is taken in the middle of its period,
 * EQ-APP-ANGLE-3
 *   and 4 with a = Ts / 2.
 * - More counts: EQ-APP-ANGLE-1. Its error is uniform within half a count, and differences below a
 *   quarter of a count are ignored.
 *
 * In a period without an edge the angle stays within the count. The speed is then at most one count
 * in the time since the last edge.
 *
 * A position means the middle of its count. The angle is undefined until it is referenced, by the
 * index mark or by alignment. The electrical angle of the index is a constant of motor and encoder.
 *
 * Later index pulses check the counter. A small difference means missed edges: the index corrects
 * the angle. A larger difference is a fault of index or counter. After the first index, every turn
 * must have one. The speed comes from raw positions, so a correction does not change it.
 *
 * A correction is no step: the law would take it for a movement. The zero approaches the one by the
 * index, z, with k = n .. 0 periods left:
 *
 *     theta_zero = z + k step, |step| <= CORRECT_radps Ts                          EQ-APP-ANGLE-6
 *
 * A position jump means lost or wrong counts: it drops the reference in every mode. A running drive
 * continues with its present angle, and the next index corrects it. Without an index the next run
 * aligns again.
 */
#ifndef APP_ANGLE_H
#define APP_ANGLE_H

#include "app_disc.h"
#include "app_part.h"
#include "base.h"
#include "board.h"
#include "drive_config.h"

typedef struct {
    float    index_theta_e_rad;     /**< electrical angle at the index mark, [0, 2 pi) */
    uint16_t index_tolerance_cnt;   /**< width of the mark: no correction up to here */
    uint16_t index_correct_max_cnt; /**< a larger difference is a fault; >= the tolerance */
    uint16_t
        jump_cnt; /**< largest plausible change of the counts per period between periods; > 0 */
} app_angle_config_t;

typedef enum {
    APP_ANGLE_NONE = 0, /**< the angle is undefined */
    APP_ANGLE_ALIGNED,  /**< found by alignment */
    APP_ANGLE_INDEX     /**< measured from the index mark */
} app_angle_reference_t;

typedef struct {
    const app_angle_config_t *config;
    uint16_t                  pole_pairs;
    uint16_t                  positions;    /**< per turn */
    uint16_t                  pattern_mask; /**< places of the disc's pattern, less one */
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
    uint16_t                  correct_ticks;  /**< left of a correction */
    float                     correct_step_rad; /**< of theta_zero, in each of them */
    uint16_t                  before_cnt;
    bool                      have_before;
    int16_t                   turned_cnt; /**< counts in the previous period */
    bool                      have_turned;
    int32_t                   since_index_cnt; /**< turned since the last index */
    bool                      have_index;      /**< an index was seen since the start */
    uint16_t                  jumps;           /**< since the start; stays at 65535 */
    bool                      have_edge;       /**< the next three are valid */
    uint16_t                  edge_cnt; /**< position at whose lower end the last timed edge is */
    float                     edge_age_s;
    float                     edge_gap_s; /**< time between the last two edges; 0: unknown */
    float                     edge_speed_e_radps;
    uint16_t                  corrections; /**< corrections by the index since the start; wraps */
#if APP_DISC_MAP
    app_disc_t disc;
#endif
} app_angle_t;

typedef struct {
    float   theta_e_rad;     /**< 0 .. 2 pi */
    float   band_rad;        /**< uncertainty of theta_e_rad; 0: it is a measurement */
    int16_t edge_of_pattern; /**< place of the edge that gave theta_e_rad, 1 .. 16; 0: none
                              * (EQ-ENCODER-FORM-4) */
    float   edge_gap_s;      /**< between the last two edges, or since the last one; 0: unknown */
    float   edge_age_s;      /**< since the edge of edge_of_pattern; 0: none */
    float   omega_e_radps;   /**< 0 unless speed_valid */
    bool    speed_valid;     /**< the previous sample was valid too */
    bool    index_fault;     /**< index at a wrong position, or missing; the reference is dropped */
} app_angle_reading_t;

/** @return CTL_BAD_CONFIG when a constant is out of range. Context: init, or the loader. */
ctl_status_t app_angle_check(const app_angle_config_t *config, const drive_config_t *drive);

/** @return Result of the check. After CTL_BAD_CONFIG a is unusable. Context: init. */
ctl_status_t app_angle_init(app_angle_t *a, const app_angle_config_t *config,
                            const drive_config_t *drive);

/**
 * @brief Takes one valid sample with its position within a turn.
 *
 * Context: control ISR, once per tick. At most one division; three more where the index corrects.
 */
APP_MEASURE_PART void app_angle_update(app_angle_t *a, const board_sample_t *raw,
                                       app_angle_reading_t *reading);

/** References the angle: the rotor is at theta_e_rad, [0, 2 pi). Context: control ISR. */
void app_angle_align(app_angle_t *a, uint16_t position_cnt, float theta_e_rad);

/**
 * @brief Number of the edge that the last reading rests on, in the turn that begins at the index.
 *
 * It is -1 without such an edge, before an index came while the shaft turned forward, and in a
 * program without APP_DISC_MAP.
 *
 * Context: control ISR, for the scope.
 */
float app_angle_edge(const app_angle_t *a, const app_angle_reading_t *reading);

/** Drops the reference after lost counts. The next sample has no speed. Context: control ISR. */
void app_angle_drop(app_angle_t *a);

/** True if |cnt| <= most_cnt, in one comparison; most_cnt >= 0. */
static inline bool app_angle_cnt_within(int32_t cnt, int32_t most_cnt)
{
    const uint32_t most = (uint32_t)most_cnt;

    return ((uint32_t)cnt + most) <= (2UL * most); /* below -most wraps to a large number */
}

/** Counts from one position to another, in the shorter direction. */
static inline int16_t app_angle_turned_cnt(uint16_t positions, uint16_t from_cnt, uint16_t to_cnt)
{
    int32_t turned_cnt = (int32_t)to_cnt - (int32_t)from_cnt;

    if (!app_angle_cnt_within(turned_cnt, (int32_t)(positions / 2U))) {
        turned_cnt += (turned_cnt < 0) ? (int32_t)positions : -(int32_t)positions;
    }
    return (int16_t)turned_cnt;
}

#endif /* APP_ANGLE_H */
