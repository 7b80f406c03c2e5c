/* SPDX-License-Identifier: MIT */
#include "app_modes.h"

#define AT_LIMIT2 0.81f /* 0.9^2, as in motion_watch.c */

/* The drive has to run: without constants it does not. */
static bool current_limited(const volatile app_modes_t *m)
{
    const float id_A  = m->drive.answer.now.id_A;
    const float iq_A  = m->drive.answer.now.iq_A;
    const float max_A = m->drive.config->current_max_A * (1.0f - m->heat.derating);

    return ((id_A * id_A) + (iq_A * iq_A)) >= (AT_LIMIT2 * max_A * max_A);
}

float app_torque_share(const drive_config_t *c, dq_t i_A)
{
    const motor_reduced_t *m = &c->motor;

    return (i_A.q * (m->l1 + (m->l11 * i_A.d))) / (m->l3 * c->rated_torque_Nm);
}

void app_modes_status(const volatile app_modes_t *m, uint16_t board_faults, app_status_t *s)
{
    const bool running = (m->mode == APP_MODE_RUN) || (m->mode == APP_MODE_STOP);
    const dq_t zero    = {0.0f, 0.0f};
    const dq_t now_A   = {.d = m->drive.answer.now.id_A, .q = m->drive.answer.now.iq_A};

    s->mode              = m->mode;
    s->fault             = m->fault;
    s->drive_fault       = m->drive.fault;
    s->board_faults      = board_faults;
    s->hot               = m->hot;
    s->dc_link_out       = m->dc_link_out;
    s->tripped           = m->tripped;
    s->shorted           = m->stop.shorted;
    s->gate_enable       = m->gate_on;
    s->voltage_limited   = running && m->drive.v_limited;
    s->current_limited   = running && current_limited(m);
    s->derating          = m->heat.derating;
    s->motor_heat        = m->heat.motor.x;
    s->inverter_heat     = m->heat.inverter.x;
    s->position_jumps    = m->angle.jumps;
    s->reference         = m->angle.reference;
    s->align_stage       = m->align.stage;
    s->position_cnt      = m->angle.before_cnt;
    s->index_corrections = m->angle.corrections;
    s->phase_errors      = m->phase_errors;
    s->ignored_angles    = m->drive.answer.ignored_angles;
    s->without_angle     = running && m->drive.answer.without_angle;
    s->ignored_currents  = m->drive.current_gate.ignored;
    s->reset_cause       = BOARD_RESET_PIN;
    s->theta_e_rad       = m->reading.theta_e_rad;
    s->speed_e_radps     = running ? m->drive.answer.now.omega_e_radps : m->reading.omega_e_radps;
    s->dc_link_V         = m->sample.dc_link_V;
    s->temperature_degC  = m->sample.temperature_degC;
    s->i_A               = running ? now_A : zero;
    s->i_ref_A           = running ? m->drive.answer.i_ref_A : zero;
    s->v_V               = running ? m->drive.v_V : zero;
#if APP_TRIM
    s->ia_A = m->sample.ia_A;
    s->ib_A = m->sample.ib_A;
#endif
    s->d_omega             = running ? m->drive.answer.d_omega : 0.0f;
    s->zero_a_cnt          = m->scale.zero_a_cnt;
    s->zero_b_cnt          = m->scale.zero_b_cnt;
    s->tick_cycles         = 0U;
    s->tick_cycles_worst   = 0U;
    s->ticks               = m->ticks;
    s->snapshot            = m->snapshot;
    s->commission          = app_commission_status(&m->commission);
    s->state               = APP_CONTROL_NOT_READY; /* app.c sets this and the next */
    s->mode_of_operation   = 0;
    s->done                = false;
    s->demand_e_radps      = 0.0f;
    s->position            = m->position;
    s->arrived             = running && m->drive.answer.arrived;
    s->waits               = running && m->drive.answer.waits;
    s->torque_share        = running ? app_torque_share(m->drive.config, now_A) : 0.0f;
    s->torque_demand_share = running ? app_torque_share(m->drive.config, s->i_ref_A) : 0.0f;
    s->target_cnt          = 0L;
    s->beyond              = false; /* as the next five */
    s->unled               = false;
    s->acknowledged        = false;
    s->held                = false;
    s->homing              = APP_HOMING_IDLE;
    s->inputs              = 0U;
    s->brake               = m->brake.state;
#if BOARD_CHOPPER
    s->chopper      = app_chopper_state(&m->chopper);
    s->chopper_heat = m->chopper.heat;
#endif
#if APP_DISC_MAP
    s->disc = m->angle.disc.state;
#endif
}
