/* SPDX-License-Identifier: MIT */
/**
 * @file app_commission.h
 * @brief Self-commissioning (commission.h) on the board's samples: bounds of the command, a count that does not end with the turn.
 *
 * The drive's tables may be of another motor. Of them the control period, the dc link's range, the positions of a turn and
 * the largest current are used: what is the board's.
 */
#ifndef APP_COMMISSION_H
#define APP_COMMISSION_H

#include "app_scale.h"
#include "board.h"
#include "commission.h"
#include "drive_config.h"

/** What the operator allows. */
typedef struct {
    float current_A;     /**< > 0, at most the drive's limit */
    float speed_m_radps; /**< mechanical, > 0 */
} app_commission_bounds_t;

/** How it stands, and what was found. */
typedef struct {
    commission_stage_t  stage;
    commission_stage_t  last_stage; /**< the one that ran when it ended */
    commission_reason_t reason;
    int16_t             percent;
    commission_result_t found;
} app_commission_status_t;

typedef struct {
    commission_config_t config;
    commission_t        module;
    float               current_max_A; /**< that may be allowed */
    uint16_t            positions;     /**< of a turn */
    uint16_t            before_cnt;
    int32_t             position_cnt; /**< since the start */
} app_commission_t;

/** Nothing was commissioned yet. Context: init. */
void app_commission_init(app_commission_t *a, const drive_config_t *drive);

/** true when these bounds can be started with. Context: control ISR. */
bool app_commission_allows(const app_commission_t *a, const app_commission_bounds_t *bounds);

/** From the beginning, at this position. Context: control ISR. */
void app_commission_start(app_commission_t *a, const app_commission_bounds_t *bounds,
                          uint16_t position_cnt);

/** One period. @param run false: withdrawn. Context: control ISR. */
bridge_t app_commission_tick(app_commission_t *a, const app_scale_sample_t *sample,
                             const board_sample_t *raw, bool run);

/** Context: background; of one tick, unless one interrupts. */
app_commission_status_t app_commission_status(const volatile app_commission_t *a);

#endif /* APP_COMMISSION_H */
