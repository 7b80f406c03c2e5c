/* SPDX-License-Identifier: MIT */
#include "app_control_change.h"

#include "check.h"

#define WINDOW_E_RADPS 5.0f /* chosen: above noise and ripple */

#define STAY APP_CONTROL_STATES

/* Chosen: nothing moves until a method is set. A turn in a second meets a switch softly; a tenth of
 * that passes its edge within a few counts of a millisecond. */
#define HOMING_METHOD         37
#define HOMING_SWITCH_m_radps BASE_TWO_PI
#define HOMING_ZERO_m_radps   (0.1f * BASE_TWO_PI)
#define HOMING_s              60.0f

/* Chosen: above what data sheets say of brakes for motors up to some kW. */
#define BRAKE_RELEASE_ms 100U
#define BRAKE_CLOSE_ms   100U

#define THERE_cnt 8L /* chosen: a shaft that holds a position moves less */

#define INTERPOLATION_s 0.01f /* chosen: a master on a serial line can keep it */

#define FOLLOWING_s 0.1f /* chosen: longer than a load step, shorter than a jam lasts */

ctl_status_t app_control_init(app_control_t *c, const app_config_t *config,
                              const drive_config_t *drive)
{
    const bool ok = check_positive(drive->current_max_A);

    c->config            = config;
    c->ts_s              = drive->ts_s;
    c->per_current_max   = ok ? (1.0f / drive->current_max_A) : 0.0f;
    c->state             = APP_CONTROL_NOT_READY;
    c->mode              = APP_CONTROL_PROFILE_VELOCITY;
    c->armed             = false;
    c->reset_high        = true;
    c->asked             = false;
    c->moved             = false;
    c->speed_max_e_radps = drive->speed_max_e_radps;
    c->accel_e_radps2    = app_control_path_accel(drive);
    c->done              = false;
    c->ref_e_radps       = 0.0f;
    c->goal_e_radps      = 0.0f;
    c->up_e_radps        = 0.0f;
    c->down_e_radps      = 0.0f;
    c->stopping          = false;
    c->follows           = APP_FOLLOWS_SPEED;
    c->holds             = false;
    c->limited           = false;
    c->blocked           = false;
    c->braked            = false;
    app_homing_reset(&c->homing);
    app_path_end(&c->path);
    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

app_objects_t app_control_default(const drive_config_t *drive)
{
    const float pairs = (float)drive->hardware.pole_pairs;

    const app_objects_t o = {.controlword           = APP_CONTROL_DISABLE_VOLTAGE,
                             .mode_of_operation     = APP_CONTROL_PROFILE_VELOCITY,
                             .quick_option          = APP_CONTROL_QUICK_FAST,
                             .lost_option           = APP_CONTROL_LOST_DISABLE,
                             .window_e_radps        = WINDOW_E_RADPS,
                             .current_max_A         = drive->current_max_A,
                             .torque_most           = TORQUE_SHARE_MAX,
                             .interpolation_s       = INTERPOLATION_s,
                             .following_s           = FOLLOWING_s,
                             .homing_method         = HOMING_METHOD,
                             .homing_switch_e_radps = pairs * HOMING_SWITCH_m_radps,
                             .homing_zero_e_radps   = pairs * HOMING_ZERO_m_radps,
                             .homing_time_s         = HOMING_s,
                             .brake_release_ms      = BRAKE_RELEASE_ms,
                             .brake_close_ms        = BRAKE_CLOSE_ms};
    return o;
}

bool app_control_knows(const app_objects_t *o, const drive_config_t *drive)
{
    const int16_t mode  = o->mode_of_operation;
    const int16_t quick = o->quick_option;

    return (app_control_is_speed(mode) || (mode == APP_CONTROL_HOMING) ||
            (mode == APP_CONTROL_COMMISSIONING) || (mode == APP_CONTROL_FIND_ANGLE) ||
            (app_control_is_position(mode) && drive->positions) ||
            (app_control_is_torque(mode) && drive->torques)) &&
           ((quick <= APP_CONTROL_QUICK_FAST) || (quick >= APP_CONTROL_QUICK_RAMP_STAY)) &&
           app_homing_knows(o->homing_method);
}

static bool is_moving(const app_control_seen_t *seen)
{
    return (seen->mode == APP_MODE_RUN) || (seen->mode == APP_MODE_STOP) ||
           (seen->mode == APP_MODE_ALIGN) || (seen->mode == APP_MODE_PRECHARGE) ||
           (seen->mode == APP_MODE_COMMISSION);
}

/* State with the bridge off, as the application mode dictates. */
static app_control_state_t by_modes(const app_control_t *c, const app_control_seen_t *seen)
{
    app_control_state_t next = c->state;

    if (seen->mode == APP_MODE_FAULT) {
        next = seen->shorted ? APP_CONTROL_FAULT_REACTION_ACTIVE : APP_CONTROL_FAULT;
    } else if ((seen->mode == APP_MODE_BOOT) || (seen->mode == APP_MODE_CALIBRATE)) {
        next = APP_CONTROL_NOT_READY;
    } else if ((c->state == APP_CONTROL_NOT_READY) ||
               (c->state >= APP_CONTROL_FAULT_REACTION_ACTIVE)) {
        next = APP_CONTROL_SWITCH_ON_DISABLED;
    } else {
        /* the operator's request decides */
    }
    return next;
}

static void start(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen)
{
    c->state       = APP_CONTROL_OPERATION_ENABLED;
    c->mode        = o->mode_of_operation;
    c->armed       = false;
    c->asked       = false;
    c->moved       = false;
    c->done        = false;
    c->ref_e_radps = seen->speed_e_radps;
    c->holds       = false;
    app_homing_reset(&c->homing);
}

/* Change with the bridge off. A start needs a rising bit 3; a refused start is not repeated
 * later. */
static void change_at_rest(app_control_t *c, app_control_state_t to, const app_objects_t *o,
                           const app_control_seen_t *seen)
{
    if (to != APP_CONTROL_OPERATION_ENABLED) {
        c->state = to;
    } else if (c->armed && !seen->in_the_way && !is_moving(seen)) {
        start(c, o, seen);
    } else {
        c->armed = false;
        c->state = APP_CONTROL_SWITCHED;
    }
}

/* Change while the bridge is on or starts. The state ends after app_modes has opened the bridge. */
static void change_enabled(app_control_t *c, app_control_state_t to, const app_objects_t *o,
                           const app_control_seen_t *seen)
{
    const bool moving = is_moving(seen);
    const bool ended  = c->asked && !moving;

    c->moved = c->moved || moving;
    if ((to == APP_CONTROL_QUICK_STOP_ACTIVE) ||
        ((to == APP_CONTROL_OPERATION_ENABLED) && app_control_stays_quick(o) && !ended)) {
        c->state = to;
    } else if ((to != STAY) && (to != APP_CONTROL_OPERATION_ENABLED)) {
        c->state = ended ? to : c->state;
    } else if (ended && (c->state == APP_CONTROL_QUICK_STOP_ACTIVE)) {
        c->state = APP_CONTROL_SWITCH_ON_DISABLED;
    } else if (ended && (!c->moved || app_control_runs(c))) {
        c->state = APP_CONTROL_SWITCHED; /* refused, or stopped by the drive itself */
    } else {
        c->done = c->done || ended;
    }
}

static app_control_state_t next_of(app_control_state_t state, app_control_ask_t ask)
{
    /* Commanded transitions by state and request. docs/modbus.md has their numbers in CiA 402. */
    static const app_control_state_t transitions[APP_CONTROL_STATES][APP_CONTROL_ASKS] = {
        /* disable voltage, quick stop, shut down, switch on, enable operation */
        {STAY, STAY, STAY, STAY, STAY},                           /* NOT_READY */
        {STAY, STAY, APP_CONTROL_READY_TO_SWITCH_ON, STAY, STAY}, /* SWITCH_ON_DISABLED */
        {APP_CONTROL_SWITCH_ON_DISABLED, APP_CONTROL_SWITCH_ON_DISABLED, STAY, APP_CONTROL_SWITCHED,
         APP_CONTROL_OPERATION_ENABLED}, /* READY_TO_SWITCH_ON */
        {APP_CONTROL_SWITCH_ON_DISABLED, APP_CONTROL_SWITCH_ON_DISABLED,
         APP_CONTROL_READY_TO_SWITCH_ON, STAY, APP_CONTROL_OPERATION_ENABLED}, /* SWITCHED_ON */
        {APP_CONTROL_SWITCH_ON_DISABLED, APP_CONTROL_QUICK_STOP_ACTIVE,
         APP_CONTROL_READY_TO_SWITCH_ON, APP_CONTROL_SWITCHED, STAY}, /* OPERATION_ENABLED */
        {APP_CONTROL_SWITCH_ON_DISABLED, STAY, STAY, STAY,
         APP_CONTROL_OPERATION_ENABLED}, /* QUICK_STOP */
        {STAY, STAY, STAY, STAY, STAY},  /* FAULT_REACTION_ACTIVE */
        {STAY, STAY, STAY, STAY, STAY}   /* FAULT: a reset in app_modes ends it */
    };
    return transitions[state][ask];
}

void app_control_change(app_control_t *c, const app_objects_t *o, const app_control_seen_t *seen,
                        app_control_ask_t ask)
{
    const app_control_state_t modes =
        (c->state < APP_CONTROL_STATES) ? by_modes(c, seen) : APP_CONTROL_NOT_READY;

    if (modes != c->state) {
        c->state = modes;
        c->armed = false;
        return;
    }
    const app_control_state_t to = next_of(c->state, ask);
    if (app_control_is_enabled(c->state)) {
        change_enabled(c, to, o, seen);
    } else if (to != STAY) {
        change_at_rest(c, to, o, seen);
    } else {
        /* this state has no transition for the request */
    }
    c->armed = c->armed || !app_control_has(o->controlword, APP_CONTROL_ENABLE);
}

static bool stands(const app_control_t *c, const app_control_seen_t *seen)
{
    return base_within(seen->speed_e_radps, c->config->stop.still_e_radps);
}

bool app_control_brakes(const app_control_t *c, const app_objects_t *o,
                        const app_control_seen_t *seen, app_control_ask_t ask)
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

/* True if a position can be followed. False: the drive follows a speed, which a halt or a stop
 * ramps to zero. */
static bool has_position(app_control_t *c, const app_control_seen_t *seen)
{
    const bool enabled = (seen->mode == APP_MODE_RUN) && app_control_is_enabled(c->state);
    const bool known   = seen->position->known; /* not before a reference, nor after lost counts */

    if (!enabled) {
        c->holds = false;
    } else if (!known && c->holds) {
        c->state = APP_CONTROL_QUICK_STOP_ACTIVE;
    } else {
        /* it can, or could not yet */
    }
    return enabled && known;
}

/* Executes profile position for one period. True: the drive moves to a position or holds one. */
static bool follows_position(app_control_t *c, const app_objects_t *o,
                             const app_control_seen_t *seen, bool halted)
{
    if (!has_position(c, seen)) {
        return false;
    }
    if (!c->holds) {
        app_setpoint_start(&c->setpoint, o, seen->position);
        c->holds = true;
    }
    app_setpoint_tick(&c->setpoint, o, seen->position, seen->arrived || c->blocked);
    return !halted;
}

void app_control_hand_over(app_control_t *c, const app_objects_t *o)
{
    const int16_t to = o->mode_of_operation;

    if ((to != c->mode) && app_control_is_enabled(c->state) && app_control_runs(c) &&
        app_control_is_run(to)) {
        c->mode  = to;
        c->holds = false;
        app_homing_reset(&c->homing);
    }
}

static float far_of(int32_t way_cnt)
{
    return app_angle_cnt_within(way_cnt, THERE_cnt) ? 0.0f : (float)way_cnt;
}

/* The sign says what the run wants to do, in the motor's sense. A shaft that holds a position wants
 * nothing. */
static float wanted_way(const app_control_t *c, const app_objects_t *o,
                        const app_control_seen_t *seen)
{
    const int32_t now_cnt = app_position_cnt(seen->position, &seen->position->actual);
    float         way     = app_control_target_e_radps(o, c->mode);

    if (app_control_is_torque(c->mode)) {
        way = app_control_target_torque(o, c->mode);
    } else if (c->mode == APP_CONTROL_PROFILE_POSITION) {
        way = c->holds ? far_of(c->setpoint.now.target_cnt - now_cnt) : 0.0f;
    } else if (c->mode == APP_CONTROL_CYCLIC_POSITION) {
        way = far_of(app_control_asked_cnt(o) - now_cnt);
    } else {
        /* a speed */
    }
    return way;
}

/* True if an active limit switch is ahead. */
static bool is_at_switch(const app_control_t *c, const app_objects_t *o,
                         const app_control_seen_t *seen)
{
    const uint16_t active   = app_control_active(o, seen->inputs);
    const uint16_t negative = active & (uint16_t)BOARD_INPUT_NEGATIVE;
    const uint16_t positive = active & (uint16_t)BOARD_INPUT_POSITIVE;
    const bool     forward  = (o->reversed ? negative : positive) != 0U;
    const bool     back     = (o->reversed ? positive : negative) != 0U;
    bool           stops    = false;

    if ((forward || back) && (c->mode != APP_CONTROL_HOMING)) {
        const float way = wanted_way(c, o, seen);

        stops = (forward && !(way <= 0.0f)) || (back && !(way >= 0.0f));
    }
    return stops;
}

app_follows_t app_control_followed(app_control_t *c, const app_objects_t *o,
                                   const app_control_seen_t *seen)
{
    const bool    blocked = is_at_switch(c, o, seen) || c->braked;
    const bool    halt    = app_control_has(o->controlword, APP_CONTROL_HALT);
    const bool    halted  = c->stopping || halt || blocked;
    app_follows_t follows = APP_FOLLOWS_SPEED;

    c->blocked = blocked;
    if (app_control_is_torque(c->mode)) {
        follows = (!halted && app_control_is_enabled(c->state)) ? APP_FOLLOWS_TORQUE : follows;
    } else if (c->mode == APP_CONTROL_PROFILE_POSITION) {
        follows = follows_position(c, o, seen, halted) ? APP_FOLLOWS_POSITION : follows;
    } else if (c->mode == APP_CONTROL_CYCLIC_POSITION) {
        follows = (has_position(c, seen) && !halted) ? APP_FOLLOWS_PATH : follows;
    } else if (c->mode == APP_CONTROL_CYCLIC_VELOCITY) {
        follows =
            (!halted && app_control_is_enabled(c->state)) ? APP_FOLLOWS_CYCLIC_SPEED : follows;
    } else if (c->mode == APP_CONTROL_HOMING) {
        follows = (!halted && app_control_is_enabled(c->state)) ? APP_FOLLOWS_HOMING : follows;
        if (c->braked) {
            app_homing_wait(&c->homing, o);
        }
    } else {
        /* a speed */
    }
    if (follows != APP_FOLLOWS_PATH) {
        app_path_end(&c->path);
        c->holds = c->holds && (c->mode != APP_CONTROL_CYCLIC_POSITION);
    }
    return follows;
}
