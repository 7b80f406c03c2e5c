/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
#include "app_scope_signals.h"

/* While the drive runs this is its estimate. */
static float app_scope_speed(const app_modes_t *m)
{
    return (m->drive.state == DRIVE_RUN) ? m->drive.answer.now.omega_e_radps : m->reading.omega_e_radps;
}

float app_scope_signals_value(const app_scope_view_t *v, uint16_t signal)
{
    float x = 0.0f;

    switch (signal) {
    case APP_SCOPE_NONE:
        x = 0.0f;
        break;
    case APP_SCOPE_SPEED:
        x = app_scope_speed(v->modes);
        break;
    case APP_SCOPE_SPEED_MEASURED:
        x = v->modes->reading.omega_e_radps;
        break;
    case APP_SCOPE_SPEED_WANTED:
        x = v->command->omega_e_radps;
        break;
    case APP_SCOPE_IQ:
        x = v->modes->drive.answer.now.iq_A;
        break;
    case APP_SCOPE_ID:
        x = v->modes->drive.answer.now.id_A;
        break;
    case APP_SCOPE_IQ_REF:
        x = v->modes->drive.answer.i_ref_A.q;
        break;
    case APP_SCOPE_ID_REF:
        x = v->modes->drive.answer.i_ref_A.d;
        break;
    case APP_SCOPE_VQ:
        x = v->modes->drive.v_V.q;
        break;
    case APP_SCOPE_VD:
        x = v->modes->drive.v_V.d;
        break;
    case APP_SCOPE_IA:
        x = v->modes->sample.ia_A;
        break;
    case APP_SCOPE_IB:
        x = v->modes->sample.ib_A;
        break;
    case APP_SCOPE_DC_LINK:
        x = v->modes->sample.dc_link_V;
        break;
    case APP_SCOPE_THETA:
        x = v->modes->reading.theta_e_rad;
        break;
    case APP_SCOPE_DUTY_A:
        x = v->out->duty.a;
        break;
    case APP_SCOPE_DUTY_B:
        x = v->out->duty.b;
        break;
    case APP_SCOPE_DUTY_C:
        x = v->out->duty.c;
        break;
    case APP_SCOPE_LOAD:
        x = v->modes->drive.answer.d_omega;
        break;
    case APP_SCOPE_MODE:
        x = (float)v->modes->mode;
        break;
    case APP_SCOPE_EDGE:
        x = app_angle_edge(&v->modes->angle, &v->modes->reading);
        break;
    case APP_SCOPE_CHOPPER:
        x = app_modes_chopper(v->modes);
        break;
    default:
        break;
    }
    return x;
}
