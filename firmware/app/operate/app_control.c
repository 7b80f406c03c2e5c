/* SPDX-License-Identifier: MIT */
#include "app_control_change.h"

/* Beyond every speed: a ramp without a limit. */
#define ANY_STEP_E_RADPS 1.0e9f

#define OFF   APP_CONTROL_ASK_DISABLE_VOLTAGE
#define QUICK APP_CONTROL_ASK_QUICK_STOP
#define DOWN  APP_CONTROL_ASK_SHUT_DOWN
#define ON    APP_CONTROL_ASK_SWITCH_ON
#define RUN   APP_CONTROL_ASK_ENABLE

/* The first of bits 1, 2, 0 and 3 that is missing. */
static app_control_ask_t asked_for(uint16_t controlword)
{
    static const app_control_ask_t asks[16] = {OFF, OFF, QUICK, QUICK, OFF, OFF, DOWN, ON,
                                               OFF, OFF, QUICK, QUICK, OFF, OFF, DOWN, RUN};

    return asks[controlword & 15U];
}

bool app_control_enables(uint16_t controlword)
{
    return asked_for(controlword) == APP_CONTROL_ASK_ENABLE;
}

/* Steady run: the state machine is skipped, as it would change nothing. */
static bool is_steady(const app_control_t *c, const app_control_seen_t *seen, app_control_ask_t ask)
{
    return (seen->mode == APP_MODE_RUN) && (c->state == APP_CONTROL_OPERATION_ENABLED) &&
           (ask == APP_CONTROL_ASK_ENABLE);
}

static bool is_stopping(const app_control_t *c, app_control_ask_t ask)
{
    return (c->state == APP_CONTROL_QUICK_STOP_ACTIVE) || (ask != APP_CONTROL_ASK_ENABLE);
}

static float deceleration(const app_control_t *c, const app_objects_t *o)
{
    const bool fast = c->blocked || ((c->state == APP_CONTROL_QUICK_STOP_ACTIVE) &&
                                     ((o->quick_option == APP_CONTROL_QUICK_FAST) ||
                                      (o->quick_option == APP_CONTROL_QUICK_FAST_STAY)));
    return fast ? o->quick_e_radps2 : o->decel_e_radps2;
}

static float step_of(const app_control_t *c, float rate_e_radps2)
{
    return (rate_e_radps2 > 0.0f) ? (c->ts_s * rate_e_radps2) : ANY_STEP_E_RADPS;
}

/* Sets the ramp of the reference speed: away from zero with accel, towards zero with decel; 0: a
 * step. */
static void set_ramp(app_control_t *c, float goal, float accel, float decel)
{
    const bool  forward = c->ref_e_radps >= 0.0f;
    const float away    = step_of(c, accel);
    const float back    = step_of(c, decel);

    c->goal_e_radps = goal;
    c->up_e_radps   = forward ? away : back;
    c->down_e_radps = forward ? back : away;
}

static void set_reference(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen)
{
    const bool runs = (seen->mode == APP_MODE_RUN) || (seen->mode == APP_MODE_STOP);

    if (runs || !(o->accel_e_radps2 > 0.0f)) {
        const bool still = c->stopping || app_control_has(o->controlword, APP_CONTROL_HALT) ||
                           (c->mode != APP_CONTROL_PROFILE_VELOCITY) || c->blocked;

        set_ramp(c, still ? 0.0f : o->omega_e_radps, o->accel_e_radps2, deceleration(c, o));
    } else {
        app_control_put_speed(c, seen);
    }
}

/* A steady run at a speed, the most expensive ticks, has one answer. */
static void keep_running(app_control_t *c, app_command_t *out)
{
    c->moved        = true;
    c->stopping     = false;
    c->blocked      = false;
    c->follows      = APP_FOLLOWS_SPEED;
    c->asked        = true;
    out->run        = true;
    out->reset      = false;
    out->commission = false;
    out->align      = false;
}

void app_control_decide(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                        app_command_t *out)
{
    const bool              reset_now = app_control_has(o->controlword, APP_CONTROL_FAULT_RESET);
    const app_control_ask_t ask       = asked_for(o->controlword);
    const bool              steady    = is_steady(c, seen, ask);

    if (steady && (c->mode == APP_CONTROL_PROFILE_VELOCITY) && (c->mode == o->mode_of_operation) &&
        (o->inputs_used == 0U) && !c->braked) {
        keep_running(c, out);
        c->reset_high = reset_now;
        return;
    }
    app_control_hand_over(c, o);
    if (steady) {
        c->moved    = true;
        c->stopping = false;
    } else {
        app_control_change(c, o, seen, ask);
        c->stopping = is_stopping(c, ask);
    }
    c->follows = app_control_followed(c, o, seen);

    const bool on = app_control_is_enabled(c->state);
    const bool go = on && (!c->stopping || app_control_brakes(c, o, seen, ask)) && !c->done;

    out->run   = go && app_control_runs(c);
    out->reset = reset_now && !c->reset_high && (c->state >= APP_CONTROL_FAULT_REACTION_ACTIVE);
    out->commission = go && (c->mode == APP_CONTROL_COMMISSIONING);
    out->align      = go && (c->mode == APP_CONTROL_FIND_ANGLE);
    if (out->commission) {
        out->bounds = o->bounds;
    }
    c->reset_high = reset_now;
    c->asked      = on;
}

void app_control_aim(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                     app_command_t *out)
{
    out->follows = c->follows;
    if (c->follows == APP_FOLLOWS_SPEED) {
        set_reference(c, o, seen);
    } else {
        app_control_aim_beyond(c, o, seen, out);
    }
    out->derating = base_clamp(1.0f - (o->current_max_A * c->per_current_max), 0.0f, 1.0f);
}

void app_control_tick(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                      app_command_t *out)
{
    app_control_decide(c, o, seen, out);
    app_control_aim(c, o, seen, out);
    app_control_follow(c, out);
}
