/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#define START_STEP 0.001f /* of INERTIA_START */

#if APP_WATCH_INERTIA
void app_registers_init_inertia(app_registers_t *r)
{
    app_watch_inertia_reset(&r->inertia, 1.0f);
    r->inertia_started         = 0U;
    r->requested.inertia_start = 0U;
}

uint16_t app_registers_inertia_start(const app_registers_t *r)
{
    return r->requested.inertia_start;
}

void app_registers_set_inertia_start(app_registers_request_t *w, float thousandths)
{
    w->inertia_start = (uint16_t)thousandths;
}

/* A new INERTIA_START takes the place of what was learned. */
static void start_anew(app_registers_t *r)
{
    const uint16_t start = r->requested.inertia_start;

    if (start != r->inertia_started) {
        r->inertia_started = start;
        app_watch_inertia_reset(&r->inertia, (start == 0U) ? 1.0f : (START_STEP * (float)start));
    }
}

static bool follows_the_speed(const app_registers_t *r)
{
    const int16_t mode = (int16_t)APP_CONTROL_PROFILE_VELOCITY;

    return (r->requested.objects.mode_of_operation == mode) &&
           (r->status.mode_of_operation == mode) && !r->status.without_angle;
}

void app_registers_see_inertia(app_registers_t *r, float believed)
{
    const app_status_t            *s    = &r->status;
    const app_watch_inertia_seen_t seen = {
        .ticks    = s->ticks,
        .believed = believed,
        .runs     = (s->mode == APP_MODE_RUN) && follows_the_speed(r) &&
                !base_within(s->d_omega, 0.0f), /* a law without an estimate has exactly zero */
        .omega_e_radps = s->speed_e_radps,
        .d_omega       = s->d_omega};

    start_anew(r);
    app_watch_inertia_see(&r->inertia, &seen, r->drive->speed_max_e_radps, r->drive->ts_s);
}

float app_registers_inertia(const app_registers_t *r)
{
    return r->inertia.ratio;
}

float app_registers_inertia_wanted(const app_registers_t *r)
{
    return ((r->requested.inertia_start != 0U) && follows_the_speed(r)) ? r->inertia.ratio : 1.0f;
}

float app_registers_inertia_believed(const app_registers_t *r)
{
    return r->inertia.believed;
}

uint16_t app_registers_inertia_changes(const app_registers_t *r)
{
    return r->inertia.changes;
}
#else
void app_registers_init_inertia(app_registers_t *r)
{
    (void)r;
}

uint16_t app_registers_inertia_start(const app_registers_t *r)
{
    (void)r;
    return 0U;
}

void app_registers_set_inertia_start(app_registers_request_t *w, float thousandths)
{
    (void)w;
    (void)thousandths;
}

void app_registers_see_inertia(app_registers_t *r, float believed)
{
    (void)r;
    (void)believed;
}

float app_registers_inertia(const app_registers_t *r)
{
    (void)r;
    return 1.0f;
}

float app_registers_inertia_wanted(const app_registers_t *r)
{
    (void)r;
    return 1.0f;
}

float app_registers_inertia_believed(const app_registers_t *r)
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
