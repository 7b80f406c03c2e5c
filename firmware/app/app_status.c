/* SPDX-License-Identifier: MIT */
#include "app_modes.h"

#define AT_LIMIT2 0.81f /* 0.9, as motion_watch.c has it */

app_status_t app_modes_status(const volatile app_modes_t *m, uint16_t board_faults)
{
    const bool   running = (m->mode == APP_MODE_RUN) || (m->mode == APP_MODE_STOP);
    const dq_t   zero    = {0.0f, 0.0f};
    const dq_t   now_A   = {.d = m->drive.wanted.now.id_A, .q = m->drive.wanted.now.iq_A};
    const float  max_A   = m->current_max_A * (1.0f - m->heat.derating);
    const float  i2_A2   = (now_A.d * now_A.d) + (now_A.q * now_A.q);
    app_status_t s       = {.mode              = m->mode,
                            .fault             = m->fault,
                            .drive_fault       = m->drive.fault,
                            .board_faults      = board_faults,
                            .hot               = m->hot,
                            .dc_link_out       = m->dc_link_out,
                            .tripped           = m->tripped,
                            .shorted           = m->stop.shorted,
                            .gate_enable       = m->gate_on,
                            .voltage_limited   = running && m->drive.v_limited,
                            .current_limited   = running && (i2_A2 >= (AT_LIMIT2 * max_A * max_A)),
                            .derating          = m->heat.derating,
                            .motor_heat        = m->heat.motor.x,
                            .inverter_heat     = m->heat.inverter.x,
                            .position_jumps    = m->angle.jumps,
                            .reference         = m->angle.reference,
                            .align_stage       = m->align.stage,
                            .position_cnt      = m->angle.before_cnt,
                            .index_corrections = m->angle.corrections,
                            .phase_errors      = m->phase_errors,
                            .ignored_angles    = m->drive.wanted.ignored_angles,
                            .without_angle     = running && m->drive.wanted.without_angle,
                            .ignored_currents  = m->drive.current_gate.ignored,
                            .reset_cause       = BOARD_RESET_PIN,
                            .theta_e_rad       = m->reading.theta_e_rad,
                            .speed_e_radps =
                          running ? m->drive.wanted.now.omega_e_radps : m->reading.omega_e_radps,
                            .dc_link_V         = m->sample.dc_link_V,
                            .temperature_degC  = m->sample.temperature_degC,
                            .i_A               = running ? now_A : zero,
                            .i_ref_A           = running ? m->drive.wanted.i_ref_A : zero,
                            .v_V               = running ? m->drive.v_V : zero,
                            .zero_a_cnt        = m->scale.zero_a_cnt,
                            .zero_b_cnt        = m->scale.zero_b_cnt,
                            .tick_cycles       = 0U,
                            .tick_cycles_worst = 0U,
                            .ticks             = m->ticks,
                            .snapshot          = m->snapshot,
                            .commission        = app_commission_status(&m->commission)};
    return s;
}
