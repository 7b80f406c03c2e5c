/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#define POLARITY_BITS                                                                              \
    (APP_UNITS_REVERSES_POSITION | APP_UNITS_REVERSES_SPEED | APP_UNITS_REVERSES_TORQUE)

#define WINDOW 4U /* chosen: one line; a shaft at rest moves by one or two counts */

void app_registers_init_units(app_registers_t *r)
{
    const app_units_positions_t none  = {.window = WINDOW};
    const app_units_scale_t     count = {.num = 1U, .den = 1U};

    r->requested.units      = app_units_default();
    r->requested.scale      = count;
    r->requested.positions  = none;
    r->requested.window_cnt = WINDOW;

    r->requested.speed_most_e_radps = 0.0f;
}

static bool is_other(const app_units_t *a, const app_units_t *b)
{
    return (a->feed != b->feed) || (a->feed_shaft != b->feed_shaft) ||
           (a->gear_motor != b->gear_motor) || (a->gear_shaft != b->gear_shaft) ||
           (a->polarity != b->polarity);
}

static float sense_of(uint16_t turned, uint16_t bit)
{
    return ((turned & bit) != 0U) ? -1.0f : 1.0f;
}

static void turn_round(app_objects_t *o, uint16_t turned)
{
    const float speed  = sense_of(turned, APP_UNITS_REVERSES_SPEED);
    const float torque = sense_of(turned, APP_UNITS_REVERSES_TORQUE);

    o->omega_e_radps *= speed;
    o->omega_offset_e_radps *= speed;
    o->torque_share *= torque;
    o->torque_offset *= torque;
}

bool app_registers_see_units(const app_registers_t *r, app_registers_request_t *w)
{
    const app_units_t *now     = &r->requested.units;
    const uint16_t     turned  = (uint16_t)(now->polarity ^ w->units.polarity);
    const uint16_t     counts  = (uint16_t)r->drive->hardware.encoder_positions;
    const uint32_t     known   = POLARITY_BITS;
    bool               reduces = (w->units.polarity & ~known) == 0U;

    if (is_other(now, &w->units)) {
        reduces = reduces && app_units_reduce(&w->units, counts, &w->scale);
        turn_round(&w->objects, turned);
    }
    w->window_cnt = app_units_window_cnt(&w->scale, w->positions.window);
    return reduces && app_units_fit(&w->scale, &w->positions);
}

/* The lower of two limits, either of which may be 0: none. */
static float lower(float a, float b)
{
    return ((a > 0.0f) && ((b <= 0.0f) || (a < b))) ? a : b;
}

bool app_registers_cuts_speed(const app_registers_t *r)
{
    const float most = r->requested.speed_most_e_radps;

    return (most > 0.0f) && app_control_is_speed(r->status.mode_of_operation) &&
           !base_within(r->requested.objects.omega_e_radps, most);
}

void app_registers_command(const app_registers_request_t *w, app_objects_t *out)
{
    const float most = w->speed_most_e_radps;

    *out = w->objects;
    if (most > 0.0f) {
        out->omega_e_radps            = base_clamp(out->omega_e_radps, -most, most);
        out->profile_e_radps          = lower(out->profile_e_radps, most);
        out->torque_speed_max_e_radps = lower(out->torque_speed_max_e_radps, most);
    }
    app_units_apply(&w->scale, &w->positions, out);
}

int32_t app_registers_position(const app_registers_t *r)
{
    const app_position_t *p = &r->status.position;

    return app_units_of(&r->requested.scale, app_position_cnt(p, &p->actual));
}

int32_t app_registers_target(const app_registers_t *r)
{
    return app_units_of(&r->requested.scale, r->status.target_cnt);
}

float app_registers_turn_units(const app_registers_t *r)
{
    const app_units_scale_t *s = &r->requested.scale;

    return (float)r->drive->hardware.encoder_positions * ((float)s->den / (float)s->num);
}
