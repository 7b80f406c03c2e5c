/* SPDX-License-Identifier: MIT */
/**
 * @file app_commission.h
 * @brief Runs self-commissioning (commission.h) on the board's samples.
 *
 * It checks the limits of the command and extends the encoder count over many turns. The drive's
 * tables may belong to another motor. Only their board data are used: control period, dc-link
 * range, positions per turn and current limit.
 */
#ifndef APP_COMMISSION_H
#define APP_COMMISSION_H

#include "app_scale.h"
#include "board.h"
#include "commission.h"
#include "drive_config.h"

/** Limits set by the operator. */
typedef struct {
    float current_A;     /**< > 0, at most the drive's limit */
    float speed_m_radps; /**< mechanical, > 0 */
} app_commission_bounds_t;

/** Progress and results. */
typedef struct {
    commission_stage_t  stage;
    commission_stage_t  last_stage; /**< stage that ran when it ended */
    commission_reason_t reason;
    int16_t             percent;
    commission_result_t found;
} app_commission_status_t;

typedef struct {
    commission_config_t config;
    commission_t        module;
    float               current_max_A; /**< largest allowed limit */
    uint16_t            positions;     /**< of a turn */
    uint16_t            before_cnt;
    int32_t             position_cnt; /**< since the start */
} app_commission_t;

/** Sets up, without results. Context: init. */
void app_commission_init(app_commission_t *a, const drive_config_t *drive);

/** True if the limits are valid. Context: control ISR. */
bool app_commission_allows(const app_commission_t *a, const app_commission_bounds_t *bounds);

/** Starts at the first stage, at this position. Context: control ISR. */
void app_commission_start(app_commission_t *a, const app_commission_bounds_t *bounds,
                          uint16_t position_cnt);

/** Executes one period. @param run false ends it. Context: control ISR. */
bridge_t app_commission_tick(app_commission_t *a, const app_scale_sample_t *sample,
                             const board_sample_t *raw, bool run);

/** Status of one tick, unless a tick interrupts the call. Context: background. */
app_commission_status_t app_commission_status(const volatile app_commission_t *a);

#endif /* APP_COMMISSION_H */
