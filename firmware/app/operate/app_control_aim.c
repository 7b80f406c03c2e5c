/* SPDX-License-Identifier: MIT */
/* Runs without a ramp of the speed aim at a path, a torque, or a line of cyclic velocity. */
#include "app_control_change.h"

#define ANY_STEP 1.0e9f /* beyond every torque and speed: no slope */

/* Chosen: as the limits of a position profile by the shipped drive's design, half of the torque. */
#define ACCEL_SHARE 0.6f
#define JERK_s      0.005f /* time in which the acceleration may come */
#define SPEED_SHARE 0.98f  /* of the drive's largest: rounding stays within it */

static void set_limits(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen)
{
    app_path_aim_t *a      = &c->path.aim;
    const float     jerk   = c->accel_e_radps2 * (1.0f / JERK_s);
    const float     window = (float)o->following_window_cnt * seen->position->rad_per_cnt;

    a->track.period_s       = base_max(o->interpolation_s, c->ts_s);
    a->track.speed_e_radps  = SPEED_SHARE * c->speed_max_e_radps;
    a->track.accel_e_radps2 = c->accel_e_radps2;
    a->jerk_e_radps3        = (o->jerk_e_radps3 > 0.0f) ? base_min(o->jerk_e_radps3, jerk) : jerk;
    a->window_rad           = window;
    a->time_out_s           = o->following_s;
    a->start_e_radps        = seen->speed_e_radps;
}

/* A velocity offset is the speed at the set-points, from the first that is not zero on. */
static void take_point(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen)
{
    app_path_aim_t *a     = &c->path.aim;
    const int32_t   asked = app_control_asked_cnt(o);
    const int32_t   count = app_control_limited_cnt(o, asked);

    c->velocity            = c->velocity || !base_within(o->omega_offset_e_radps, 0.0f);
    a->point.at            = app_position_at(seen->position, count);
    a->point.omega_e_radps = o->omega_offset_e_radps;
    a->point.given         = c->velocity;
    a->fresh               = true;
    c->limited             = count != asked;
    c->target_number       = o->target_number;
}

static void aim_path(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                     app_command_t *out)
{
    if (!c->holds) { /* a period that had this command longer may have begun it again */
        app_path_end(&c->path);
        c->target_number = o->target_number;
        c->velocity      = false;
        c->holds         = true;
    }
    set_limits(c, o, seen);
    if (c->target_number != o->target_number) {
        take_point(c, o, seen);
    }
    out->path = &c->path;
}

float app_control_path_accel(const drive_config_t *drive)
{
    return ACCEL_SHARE * drive->motor.l1 * drive->current_max_A;
}

void app_control_put_speed(app_control_t *c, const app_control_seen_t *seen)
{
    const float most        = c->speed_max_e_radps;
    const float ref_e_radps = base_clamp(seen->speed_e_radps, -most, most);

    c->ref_e_radps  = ref_e_radps;
    c->goal_e_radps = ref_e_radps;
    c->up_e_radps   = 0.0f;
    c->down_e_radps = 0.0f;
}

static void aim_torque(const app_control_t *c, const app_objects_t *o, app_command_t *out)
{
    const bool  slope = (c->mode == APP_CONTROL_PROFILE_TORQUE) && (o->torque_slope_1ps > 0.0f);
    const float most_e_radps = o->torque_speed_max_e_radps;

    out->torque_share = app_control_target_torque(o, c->mode);
    out->torque_step  = slope ? (c->ts_s * o->torque_slope_1ps) : ANY_STEP;
    out->torque_speed_max_e_radps =
        (most_e_radps > 0.0f) ? base_min(most_e_radps, c->speed_max_e_radps) : c->speed_max_e_radps;
}

/* A new set-point is reached on a straight line after the interpolation period. A late one finds
 * the speed of the one before, an early one the speed on the way to it. */
static void aim_cyclic_speed(app_control_t *c, const app_objects_t *o,
                             const app_control_seen_t *seen)
{
    const float most = c->speed_max_e_radps;
    const float goal = base_clamp(app_control_target_e_radps(o, c->mode), -most, most);

    if (seen->mode != APP_MODE_RUN) {
        app_control_put_speed(c, seen);
        c->holds = false;
    } else if (!c->holds || !base_within(goal - c->goal_e_radps, 0.0f)) {
        const float share = c->ts_s / base_max(o->interpolation_s, c->ts_s);
        const float step  = share * fabsf(goal - c->ref_e_radps);

        c->goal_e_radps = goal;
        c->up_e_radps   = step;
        c->down_e_radps = step;
        c->holds        = true;
    } else {
        /* on its way, or there */
    }
}

static void aim_homing(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen)
{
    const app_homing_seen_t sees = {.position = seen->position,
                                    .angle    = seen->angle,
                                    .active   = app_control_active(o, seen->inputs),
                                    .ticks    = seen->ticks,
                                    .ts_s     = c->ts_s};
    const float             most = c->speed_max_e_radps;
    const float             rate = o->homing_accel_e_radps2;
    const float             step = (rate > 0.0f) ? (c->ts_s * rate) : ANY_STEP;

    if (seen->mode != APP_MODE_RUN) {
        app_control_put_speed(c, seen);
    } else {
        c->goal_e_radps = base_clamp(app_homing_tick(&c->homing, o, &sees), -most, most);
        c->up_e_radps   = step;
        c->down_e_radps = step;
    }
}

void app_control_aim_beyond(app_control_t *c, const app_objects_t *o,
                            const app_control_seen_t *seen, app_command_t *out)
{
    if (c->follows == APP_FOLLOWS_CYCLIC_SPEED) {
        out->follows = APP_FOLLOWS_SPEED;
        aim_cyclic_speed(c, o, seen);
    } else if (c->follows == APP_FOLLOWS_HOMING) {
        out->follows = APP_FOLLOWS_SPEED;
        aim_homing(c, o, seen);
    } else if (c->follows == APP_FOLLOWS_PATH) {
        aim_path(c, o, seen, out);
        app_control_put_speed(c, seen);
    } else if (c->follows == APP_FOLLOWS_TORQUE) {
        aim_torque(c, o, out);
        app_control_put_speed(c, seen);
    } else {
        out->target  = c->setpoint.target;
        out->profile = c->setpoint.now.profile;
        app_control_put_speed(c, seen);
    }
}
