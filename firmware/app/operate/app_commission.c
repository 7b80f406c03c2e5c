/* SPDX-License-Identifier: MIT */
#include "app_commission.h"

#include "app_angle.h"

void app_commission_init(app_commission_t *a, const drive_config_t *drive)
{
    const commission_config_t        board   = {.ts_s              = drive->ts_s,
                                                .current_max_A     = drive->current_max_A,
                                                .speed_max_m_radps = 1.0f, /* placeholder */
                                                .dc_link_min_V     = drive->dc_link_min_V,
                                                .dc_link_max_V     = drive->dc_link_max_V,
                                                .counts_per_turn =
                                                    (int32_t)drive->hardware.encoder_positions};
    static const commission_result_t nothing = {.counts_per_turn = 0L}; /* not on the stack */

    a->config        = board;
    a->current_max_A = drive->current_max_A;
    a->positions     = (uint16_t)drive->hardware.encoder_positions;
    a->before_cnt    = 0U;
    a->position_cnt  = 0L;
    a->module.found  = nothing;
    (void)commission_init(&a->module, &a->config);
}

bool app_commission_allows(const app_commission_t *a, const app_commission_bounds_t *bounds)
{
    return base_in_range(bounds->current_A, 1.0e-3f, a->current_max_A) &&
           base_in_range(bounds->speed_m_radps, 0.1f, 1.0e5f);
}

void app_commission_start(app_commission_t *a, const app_commission_bounds_t *bounds,
                          uint16_t position_cnt)
{
    a->config.current_max_A     = bounds->current_A;
    a->config.speed_max_m_radps = bounds->speed_m_radps;
    a->before_cnt               = position_cnt;
    a->position_cnt             = 0L;
    (void)commission_init(&a->module, &a->config);
    commission_start(&a->module);
}

bridge_t app_commission_tick(app_commission_t *a, const app_scale_sample_t *sample,
                             const board_sample_t *raw, bool run)
{
    if (sample->valid) {
        a->position_cnt += app_angle_turned_cnt(a->positions, a->before_cnt, raw->position_cnt);
        a->before_cnt = raw->position_cnt;
    }
    const commission_sample_t s = {
        .ia_A         = sample->ia_A,
        .ib_A         = sample->ib_A,
        .dc_link_V    = sample->dc_link_V,
        .position_cnt = a->position_cnt,
        .index_cnt =
            a->position_cnt + app_angle_turned_cnt(a->positions, raw->position_cnt, raw->index_cnt),
        .index_seen = raw->index_seen,
        .valid      = sample->valid};
    return commission_tick(&a->module, &s, run);
}

app_commission_status_t app_commission_status(const volatile app_commission_t *a)
{
    const commission_stage_t      last  = a->module.last_stage;
    const commission_stage_t      stage = a->module.stage;
    const app_commission_status_t s     = {.stage      = stage,
                                           .last_stage = last,
                                           .reason     = a->module.reason,
                                           .percent    = commission_percent(stage, last),
                                           .found      = a->module.found};
    return s;
}
