/* SPDX-License-Identifier: MIT */
#include "app_control_change.h"

static app_control_ask_t asked_for(uint16_t controlword)
{
    app_control_ask_t ask = APP_CONTROL_ASK_ENABLE;

    if (!app_control_has(controlword, APP_CONTROL_ENABLE_VOLTAGE)) {
        ask = APP_CONTROL_ASK_DISABLE_VOLTAGE;
    } else if (!app_control_has(controlword, APP_CONTROL_NO_QUICK_STOP)) {
        ask = APP_CONTROL_ASK_QUICK_STOP;
    } else if (!app_control_has(controlword, APP_CONTROL_SWITCH_ON)) {
        ask = APP_CONTROL_ASK_SHUT_DOWN;
    } else if (!app_control_has(controlword, APP_CONTROL_ENABLE)) {
        ask = APP_CONTROL_ASK_SWITCH_ON;
    } else {
        /* APP_CONTROL_ASK_ENABLE */
    }
    return ask;
}

bool app_control_enables(uint16_t controlword)
{
    return asked_for(controlword) == APP_CONTROL_ASK_ENABLE;
}

static bool stands(const app_control_t *c, const app_control_seen_t *seen)
{
    return base_within(seen->speed_e_radps, c->config->stop.still_e_radps);
}

/* Steady run, the most expensive ticks: the state machine is skipped, as it would change
 * nothing. */
static bool is_steady(const app_control_t *c, const app_control_seen_t *seen, app_control_ask_t ask)
{
    return (seen->mode == APP_MODE_RUN) && (c->state == APP_CONTROL_OPERATION_ENABLED) &&
           (ask == APP_CONTROL_ASK_ENABLE);
}

static bool is_stopping(const app_control_t *c, app_control_ask_t ask)
{
    return (c->state == APP_CONTROL_QUICK_STOP_ACTIVE) || (ask != APP_CONTROL_ASK_ENABLE);
}

/* True during a stop along a ramp, until standstill. Otherwise app_modes ends the run as the drive
 * file says. */
static bool brakes(const app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                   app_control_ask_t ask)
{
    bool ramps = false;

    if (c->state == APP_CONTROL_QUICK_STOP_ACTIVE) {
        ramps =
            (o->quick_option != APP_CONTROL_QUICK_OFF) && (ask != APP_CONTROL_ASK_DISABLE_VOLTAGE);
    } else if (ask == APP_CONTROL_ASK_SHUT_DOWN) {
        ramps = o->shutdown_option != 0;
    } else if (ask == APP_CONTROL_ASK_SWITCH_ON) {
        ramps = o->disable_option != 0;
    } else {
        /* no ramp */
    }
    const bool stays = (c->state == APP_CONTROL_QUICK_STOP_ACTIVE) && app_control_stays_quick(o);
    return ramps && (stays || !stands(c, seen)) && (seen->mode == APP_MODE_RUN);
}

static float deceleration(const app_control_t *c, const app_objects_t *o)
{
    const bool fast = (c->state == APP_CONTROL_QUICK_STOP_ACTIVE) &&
                      ((o->quick_option == APP_CONTROL_QUICK_FAST) ||
                       (o->quick_option == APP_CONTROL_QUICK_FAST_STAY));
    return fast ? o->quick_e_radps2 : o->decel_e_radps2;
}

/* Ramps the reference speed: away from zero with accel, towards zero with decel; 0: a step. */
static void ramp(app_control_t *c, float target, float accel, float decel)
{
    const float ref   = c->ref_e_radps;
    const bool  up    = (ref >= 0.0f) ? (target > ref) : (target < ref);
    const float rate  = up ? accel : decel;
    const float most  = c->ts_s * rate;
    const float moved = ref + base_clamp(target - ref, -most, most);

    c->ref_e_radps = (rate > 0.0f) ? moved : target;
}

static void move_reference(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                           bool stopping)
{
    const bool runs = (seen->mode == APP_MODE_RUN) || (seen->mode == APP_MODE_STOP);

    if (runs || !(o->accel_e_radps2 > 0.0f)) {
        const bool still = stopping || app_control_has(o->controlword, APP_CONTROL_HALT) ||
                           (c->mode == APP_CONTROL_PROFILE_POSITION);

        ramp(c, still ? 0.0f : o->omega_e_radps, o->accel_e_radps2, deceleration(c, o));
    } else {
        c->ref_e_radps =
            base_clamp(seen->speed_e_radps, -c->speed_max_e_radps, c->speed_max_e_radps);
    }
}

void app_control_tick(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                      app_command_t *out)
{
    const bool              reset_now = app_control_has(o->controlword, APP_CONTROL_FAULT_RESET);
    const app_control_ask_t ask       = asked_for(o->controlword);

    if (is_steady(c, seen, ask)) {
        c->moved = true;
    } else {
        app_control_change(c, o, seen, ask);
    }
    const bool stopping = is_stopping(c, ask);
    out->positioning    = (c->mode == APP_CONTROL_PROFILE_POSITION)
                              ? app_control_position(c, o, seen, stopping)
                              : false;
    if (out->positioning) {
        out->target    = c->setpoint.target;
        out->profile   = c->setpoint.now.profile;
        c->ref_e_radps = seen->speed_e_radps; /* a stop ramp begins here */
    } else {
        move_reference(c, o, seen, stopping);
    }
    const bool on = app_control_is_enabled(c->state);
    const bool go = on && (!stopping || brakes(c, o, seen, ask)) && !c->done;

    out->omega_e_radps = c->ref_e_radps;
    out->run           = go && app_control_runs(c);
    out->reset = reset_now && !c->reset_high && (c->state >= APP_CONTROL_FAULT_REACTION_ACTIVE);
    out->commission = go && (c->mode == APP_CONTROL_COMMISSIONING);
    out->align      = go && (c->mode == APP_CONTROL_HOMING);
    out->derating   = base_clamp(1.0f - (o->current_max_A * c->per_current_max), 0.0f, 1.0f);
    if (out->commission) {
        out->bounds = o->bounds;
    }
    c->reset_high = reset_now;
    c->asked      = on;
}
