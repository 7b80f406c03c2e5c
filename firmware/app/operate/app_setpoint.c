/* SPDX-License-Identifier: MIT */
#include "app_setpoint.h"

/* Means "no limit": it exceeds every limit of the drive, which then acts. */
#define ANY_LIMIT 1.0e9f

static float limit_or_any(float asked)
{
    return (asked > 0.0f) ? asked : ANY_LIMIT;
}

static position_profile_t profile_of(const app_objects_t *o)
{
    const position_profile_t p = {.speed_e_radps  = limit_or_any(o->profile_e_radps),
                                  .accel_e_radps2 = limit_or_any(o->accel_e_radps2),
                                  .decel_e_radps2 = limit_or_any(o->decel_e_radps2),
                                  .jerk_e_radps3  = limit_or_any(o->jerk_e_radps3)};
    return p;
}

void app_setpoint_start(app_setpoint_t *s, const app_objects_t *o, const app_position_t *position)
{
    s->now.target_cnt = app_position_cnt(position, &position->actual);
    s->now.profile    = profile_of(o);
    s->now.limited    = false;
    s->target         = position->actual;
    s->waits          = false;
    s->acknowledged   = false;
    s->new_high       = true;
}

static void begin(app_setpoint_t *s, const app_setpoint_one_t *one, const app_position_t *position)
{
    s->now    = *one;
    s->waits  = false;
    s->target = app_position_at(position, one->target_cnt);
}

static app_setpoint_one_t setpoint_asked(const app_setpoint_t *s, const app_objects_t *o)
{
    const app_setpoint_one_t *before   = s->waits ? &s->next : &s->now;
    const bool                relative = app_control_has(o->controlword, APP_CONTROL_RELATIVE);
    const int32_t             from_cnt = relative ? before->target_cnt : 0L;

    const int32_t asked =
        app_position_held(from_cnt + app_position_held(o->target_cnt)); /* at most 2e9 */
    const int32_t            count = app_control_limited_cnt(o, asked);
    const app_setpoint_one_t one   = {
          .target_cnt = count, .profile = profile_of(o), .limited = count != asked};
    return one;
}

void app_setpoint_tick(app_setpoint_t *s, const app_objects_t *o, const app_position_t *position,
                       bool arrived)
{
    const bool high = app_control_has(o->controlword, APP_CONTROL_NEW_SETPOINT);
    const bool rose = high && !s->new_high;

    const bool follows = s->waits && arrived;

    if (follows) {
        begin(s, &s->next, position);
    }
    if (rose && ((arrived && !follows) || app_control_has(o->controlword, APP_CONTROL_AT_ONCE))) {
        const app_setpoint_one_t one = setpoint_asked(s, o);
        begin(s, &one, position);
        s->acknowledged = true;
    } else if (rose && !s->waits) {
        s->next         = setpoint_asked(s, o);
        s->waits        = true;
        s->acknowledged = true;
    } else {
        /* the set-point stays; there is no room for a third one */
    }
    s->new_high     = high;
    s->acknowledged = s->acknowledged && (high || s->waits);
}
