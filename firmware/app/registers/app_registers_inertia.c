/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#if APP_WATCH_INERTIA
void app_registers_see_inertia(app_registers_t *r)
{
    const app_status_t            *s    = &r->status;
    const app_watch_inertia_seen_t seen = {
        .ticks = s->ticks,
        .runs  = (s->mode == APP_MODE_RUN) && !s->without_angle &&
                (s->mode_of_operation == (int16_t)APP_CONTROL_PROFILE_VELOCITY) &&
                !base_within(s->d_omega, 0.0f), /* a law without an estimate has exactly zero */
        .omega_e_radps = s->speed_e_radps,
        .d_omega       = s->d_omega};

    app_watch_inertia_see(&r->inertia, &seen, r->drive->speed_max_e_radps, r->drive->ts_s);
}

float app_registers_inertia(const app_registers_t *r)
{
    return r->inertia.ratio;
}

uint16_t app_registers_inertia_changes(const app_registers_t *r)
{
    return r->inertia.changes;
}
#else
void app_registers_see_inertia(app_registers_t *r)
{
    (void)r;
}

float app_registers_inertia(const app_registers_t *r)
{
    (void)r;
    return 1.0f;
}

uint16_t app_registers_inertia_changes(const app_registers_t *r)
{
    (void)r;
    return 0U;
}
#endif
