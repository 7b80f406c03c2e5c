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

bridge_t app_states_fault(app_modes_t *m, const app_modes_input_t *in)
{
    const app_stop_input_t now = {.omega_e_radps = m->reading.omega_e_radps,
                                  .ia_A          = m->sample.ia_A,
                                  .ib_A          = m->sample.ib_A,
                                  .valid         = m->sample.valid && m->reading.speed_valid,
                                  .board_faults  = in->board_faults};
    return app_stop_bridge(&m->stop, &now);
}

/* A running drive gives its speed estimate. The measured speed is missing in an invalid sample and
 * wrong with a failing encoder. */
bridge_t app_states_trip(app_modes_t *m, const app_modes_input_t *in, app_fault_t fault)
{
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
    const bool           encoder  = ((in->board_faults & (uint16_t)BOARD_FAULT_ENCODER) != 0U) ||
                         (m->drive.fault == DRIVE_FAULT_ENCODER);

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
