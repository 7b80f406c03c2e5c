/* SPDX-License-Identifier: MIT */
/* Each mode may enter another one, or trip. These functions run from flash. */
#include "app_states.h"

#include <stddef.h>

void app_states_enter(app_modes_t *m, app_mode_t mode)
{
    m->mode             = mode;
    m->timer_ticks      = 0U;
    m->sum_a_cnt        = 0UL;
    m->sum_b_cnt        = 0UL;
    m->armed            = false;
    m->commission_armed = false;
    m->align_armed      = false;
    m->zero_a_A         = 0.0f;
    m->zero_b_A         = 0.0f;
#if BOARD_CURRENT_SENSORS == 3
    app_watch_sum_begin(&m->sum);
#endif
}

/* Chosen by simulation: less current keeps the estimated angle with other inductances, more brakes
 * against a load. With 0.3, motors of 0.7 to 1.5 times the inductance brake against two thirds of
 * the rated torque. */
#define WITHOUT_ANGLE_DERATING 0.3f

app_command_t app_states_stop_command(const app_modes_t *m, const app_modes_input_t *in)
{
    const float         derating = m->drive.answer.without_angle ? WITHOUT_ANGLE_DERATING : 0.0f;
    const app_command_t stop     = {.omega_e_radps = 0.0f,
                                    .derating      = base_max(in->command.derating, derating)};
    return stop;
}

static const law_aim_t *at_position(app_modes_t *m, const app_command_t *asked)
{
    m->to_position.actual  = m->position.actual;
    m->to_position.target  = asked->target;
    m->to_position.profile = asked->profile;
    m->to_position.moves   = false;
    m->aim.position        = &m->to_position;
    m->aim.torque          = NULL;
    return &m->aim;
}

/* A fault here is one of the next tick. */
static const law_aim_t *at_path(app_modes_t *m, const app_command_t *asked)
{
    app_path_t *const path = asked->path;

    m->to_position.actual = m->position.actual;
    m->to_position.moves  = true;
    m->aim.position       = &m->to_position;
    m->aim.torque         = NULL;
    app_path_tick(path, &m->position.actual, m->drive.config->ts_s, &m->to_position.motion);
    if (path->deviates) {
        m->sink_fault = APP_FAULT_FOLLOWING;
    }
    return &m->aim;
}

static const law_aim_t *at_torque(app_modes_t *m, const app_command_t *asked)
{
    const bool running = m->drive.state == DRIVE_RUN;
    const bool goes_on = running && ((m->ticks - m->torque_ticks) == 1UL);
    float      share   = m->to_torque.share;

    if (!goes_on) {
        share = running ? app_torque_share(m->drive.config, m->drive.answer.i_ref_A) : 0.0f;
        share = base_clamp(share, -TORQUE_SHARE_MAX, TORQUE_SHARE_MAX);
    }
    m->to_torque.share =
        base_clamp(asked->torque_share, share - asked->torque_step, share + asked->torque_step);
    m->to_torque.speed_max_e_radps = asked->torque_speed_max_e_radps;
    m->torque_ticks                = m->ticks;
    m->aim.position                = NULL;
    m->aim.torque                  = &m->to_torque;
    return &m->aim;
}

const law_aim_t *app_states_aim(app_modes_t *m, const app_command_t *asked)
{
    const law_aim_t *aim;

    if (asked->follows == APP_FOLLOWS_TORQUE) {
        aim = at_torque(m, asked);
    } else if (asked->follows == APP_FOLLOWS_PATH) {
        aim = at_path(m, asked);
    } else {
        aim = at_position(m, asked);
    }
    return aim;
}

bool app_states_gives_up(const app_modes_t *m)
{
    return m->drive.answer.without_angle && ((m->ticks - m->torque_ticks) == 1UL) &&
           base_within(m->drive.answer.now.omega_e_radps, m->stop.link_e_radps);
}

/* The drive gives its reason, and keeps it until a reset. */
static bool encoder_is_lost(const app_modes_t *m)
{
    return (m->drive.fault == DRIVE_FAULT_ENCODER) || m->drive.answer.without_angle;
}

bool app_states_know_speed(const app_modes_t *m)
{
    return m->sample.valid && m->reading.speed_valid && !encoder_is_lost(m);
}

bridge_t app_states_fault(app_modes_t *m, const app_modes_input_t *in)
{
    const app_stop_input_t now = {.omega_e_radps = m->reading.omega_e_radps,
                                  .ia_A          = m->sample.ia_A,
                                  .ib_A          = m->sample.ib_A,
                                  .speed_known   = app_states_know_speed(m),
                                  .valid         = m->sample.valid,
                                  .board_faults  = in->board_faults};
    return app_stop_bridge(&m->stop, &now);
}

/* Speed, sensors, wires and motor are judged by the angle. Without it, whatever is wrong with them
 * follows from the loss of the encoder. A drive that has none tripped because of that loss. */
static drive_fault_t reason(const app_modes_t *m, app_fault_t tripped)
{
    const drive_fault_t fault    = m->drive.fault;
    const bool          none     = (tripped == APP_FAULT_DRIVE) && (fault == DRIVE_FAULT_NONE);
    const bool          by_angle = none || (fault == DRIVE_FAULT_OVER_SPEED) ||
                          ((fault >= DRIVE_FAULT_CURRENT_SENSOR) && (fault <= DRIVE_FAULT_AWAY));

    return (m->drive.answer.without_angle && by_angle) ? DRIVE_FAULT_ENCODER : fault;
}

/* A running drive gives its speed estimate. The measured speed is missing in an invalid sample and
 * wrong with a failing encoder. */
bridge_t app_states_trip(app_modes_t *m, const app_modes_input_t *in, app_fault_t fault)
{
    m->drive.fault            = reason(m, fault);
    const bool  off           = (m->drive.state == DRIVE_OFF);
    const float speed_e_radps = off ? m->reading.omega_e_radps : m->drive.answer.now.omega_e_radps;
    const app_snapshot_t snapshot = {.fault          = fault,
                                     .mode           = m->mode,
                                     .drive_fault    = m->drive.fault,
                                     .board_faults   = in->board_faults,
                                     .raw            = *in->raw,
                                     .speed_e_radps  = m->reading.omega_e_radps,
                                     .wanted_e_radps = in->command.omega_e_radps,
                                     .ticks          = m->ticks};
    const bool           encoder =
        ((in->board_faults & (uint16_t)BOARD_FAULT_ENCODER) != 0U) || encoder_is_lost(m);

    if (encoder) {
        app_angle_drop(&m->angle);
    }
    m->snapshot = snapshot;
    m->fault    = fault;
    app_states_enter(m, APP_MODE_FAULT);
    if (m->gate_on) {
        app_stop_fault(&m->stop, speed_e_radps, m->drive.fault, in->board_faults);
    }
    return app_states_fault(m, in);
}

bridge_t app_states_align_vector(app_modes_t *m, const app_modes_input_t *in)
{
    return app_align_tick(&m->align, &m->drive.config->dead_time, m->sample.ia_A, m->sample.ib_A,
                          m->sample.dc_link_V, in->raw->position_cnt);
}

bridge_t app_states_hold_aligned(app_modes_t *m, const app_modes_input_t *in)
{
    bridge_t out = bridge_shorted();

    if (m->angle.reference != APP_ANGLE_INDEX) {
        out = app_states_align_vector(m, in);
    }
    if (m->align.stage == APP_ALIGN_FAILED) {
        out = app_states_trip(m, in, APP_FAULT_ALIGN);
    }
    return out;
}

/* The law or the alignment's vector hold the shaft before the brake is released. A motor that is
 * commissioned is shorted until then. */
static app_brake_ask_t brake_ask(const app_modes_t *m)
{
    const bool still =
        base_within(m->drive.answer.now.omega_e_radps, m->config->stop.still_e_radps);
    const bool aligns = m->mode == APP_MODE_ALIGN;
    const bool vector =
        aligns && ((m->align.stage == APP_ALIGN_SWEEP) || (m->align.stage == APP_ALIGN_SETTLE));
    app_brake_ask_t ask = APP_BRAKE_KEEP;

    if (!m->gate_on || (m->mode == APP_MODE_FAULT)) {
        ask = APP_BRAKE_BRIDGE_OFF;
    } else if ((m->mode == APP_MODE_RUN) || (m->mode == APP_MODE_COMMISSION) || vector) {
        ask = APP_BRAKE_RELEASE;
    } else if (m->mode == APP_MODE_STOP) {
        ask = still ? APP_BRAKE_CLOSE : APP_BRAKE_KEEP;
    } else if (aligns && (m->align.stage == APP_ALIGN_DONE)) {
        ask = APP_BRAKE_CLOSE;
    } else {
        /* as it is */
    }
    return ask;
}

void app_modes_brake(app_modes_t *m, const app_objects_t *o, bool turn, float ts_s)
{
    app_brake_tick(&m->brake, o, brake_ask(m), turn, ts_s);
}

/* An unknown temperature does not prevent a start; it is a fault of the run. */
bool app_modes_in_the_way(const app_modes_t *m)
{
    return (m->hot && m->sample.temperature_valid) || m->dc_link_out || m->tripped || m->locked ||
           !app_gate_may_start(&m->config->gate, m->reading.omega_e_radps);
}
