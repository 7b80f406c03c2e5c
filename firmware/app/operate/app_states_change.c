/* SPDX-License-Identifier: MIT */
/* Each mode may enter another one, or trip. These functions run from flash. */
#include "app_states.h"

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
 * follows from the loss of the encoder. */
static drive_fault_t reason(const app_modes_t *m)
{
    const drive_fault_t fault    = m->drive.fault;
    const bool          by_angle = (fault == DRIVE_FAULT_OVER_SPEED) ||
                          ((fault >= DRIVE_FAULT_CURRENT_SENSOR) && (fault <= DRIVE_FAULT_AWAY));

    return (m->drive.answer.without_angle && by_angle) ? DRIVE_FAULT_ENCODER : fault;
}

/* A running drive gives its speed estimate. The measured speed is missing in an invalid sample and
 * wrong with a failing encoder. */
bridge_t app_states_trip(app_modes_t *m, const app_modes_input_t *in, app_fault_t fault)
{
    m->drive.fault            = reason(m);
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

/* An unknown temperature does not prevent a start; it is a fault of the run. */
bool app_modes_in_the_way(const app_modes_t *m)
{
    return (m->hot && m->sample.temperature_valid) || m->dc_link_out || m->tripped || m->locked ||
           !app_gate_may_start(&m->config->gate, m->reading.omega_e_radps);
}
