/* SPDX-License-Identifier: MIT */
#include "drive_tick.h"

#include <stddef.h>

#include "feedforward.h"
#include "frames.h"
#include "svpwm.h"
#include "voltage.h"

static const dq_t           zero_dq     = {0.0f, 0.0f};
static const drive_output_t open_bridge = {.duty = {0.5f, 0.5f, 0.5f}, .gate_enable = false};

ctl_status_t drive_init(drive_t *d, const drive_config_t *config)
{
    const ctl_status_t status = drive_config_check(config);

    d->config = (status == CTL_OK) ? config : NULL;
    drive_reset(d);
    return status;
}

void drive_reset(drive_t *d)
{
    const nodo_meas_t zero = {0.0f, 0.0f, 0.0f};

    d->state = DRIVE_OFF;
    d->fault = DRIVE_FAULT_NONE;
    d->meas  = zero;
    nodo_reset(&d->observer, &zero);
    speed_ref_reset(&d->speed_ref, 0.0f);
    current_ref_reset(&d->current_ref);
    d->v_V       = zero_dq;
    d->v_limited = false;
}

static bool symmetric_range(float x, float limit)
{
    return base_in_range(x, -limit, limit);
}

static drive_fault_t find_fault(const drive_config_t *c, const drive_sample_t *s,
                                const drive_command_t *command)
{
    if (!s->valid || !symmetric_range(s->theta_e_rad, BASE_TWO_PI)) {
        return DRIVE_FAULT_SAMPLE;
    }
    if (!symmetric_range(s->ia_A, c->trip_current_A) ||
        !symmetric_range(s->ib_A, c->trip_current_A) ||
        !symmetric_range(s->ia_A + s->ib_A, c->trip_current_A)) { /* phase c */
        return DRIVE_FAULT_OVER_CURRENT;
    }
    if (!base_in_range(s->dc_link_V, c->dc_link_min_V, c->dc_link_max_V)) {
        return DRIVE_FAULT_DC_LINK;
    }
    if (!symmetric_range(s->omega_e_radps, c->trip_speed_e_radps)) {
        return DRIVE_FAULT_OVER_SPEED;
    }
    if (!symmetric_range(command->omega_e_radps, c->trip_speed_e_radps)) {
        return DRIVE_FAULT_COMMAND;
    }
    return DRIVE_FAULT_NONE;
}

static drive_output_t trip(drive_t *d, drive_fault_t fault)
{
    d->state = DRIVE_FAULT;
    d->fault = fault;
    d->v_V   = zero_dq;
    return open_bridge;
}

/* Bumpless: the observer takes over the measurement and the reference the present speed. */
static void start(drive_t *d)
{
    nodo_reset(&d->observer, &d->meas);
    speed_ref_reset(&d->speed_ref, d->meas.omega_e_radps);
    current_ref_reset(&d->current_ref);
    d->v_V   = zero_dq;
    d->state = DRIVE_RUN;
}

/* EQ-DRIVE-1 and the limits; the result is stored as the voltage of the next period. */
static void control_law(drive_t *d, float v_max_V)
{
    const drive_config_t *c   = d->config;
    const dq_t            ref = d->current_ref.i_A;

    nosc_error_t e = {.omega_e_radps = d->meas.omega_e_radps - d->speed_ref.omega_e_radps,
                      .iq_A          = d->meas.iq_A - ref.q,
                      .id_A          = d->meas.id_A - ref.d};
    e = nosc_limit_speed_error(&c->nosc, e, ref.q, d->current_ref.iq_lo_A, d->current_ref.iq_hi_A);

    const float w_d =
        d->meas.omega_e_radps - e.omega_e_radps; /* the reference as far as it is followed */
    const dq_t fb_V = nosc_feedback_V(&c->nosc, &e);
    const dq_t ff_V = feedforward_V(&c->motor, &d->current_ref, w_d, &d->meas, &d->observer);
    const dq_t u_V  = {.d = fb_V.d + ff_V.d, .q = fb_V.q + ff_V.q};

    const dq_t              hold_V = feedforward_hold_V(&c->motor, &d->meas, &d->observer);
    const voltage_limited_t v      = voltage_limit(u_V, hold_V, v_max_V);
    d->v_V                         = v.v_V;
    d->v_limited                   = v.limited;
}

static drive_output_t run(drive_t *d, const drive_sample_t *s, const drive_command_t *command)
{
    const drive_config_t *c       = d->config;
    const float           v_max_V = s->dc_link_V * BASE_1_SQRT3;

    nodo_update(&d->observer, &c->nodo, &c->motor, &d->meas, d->v_V, c->ts_s);
    speed_ref_update(&d->speed_ref, command->omega_e_radps, c->accel_max_e_radps2, c->ts_s);

    const float               e_w = d->meas.omega_e_radps - d->speed_ref.omega_e_radps;
    const current_ref_input_t in  = {.est        = &d->observer,
                                     .meas       = &d->meas,
                                     .iq_speed_A = nosc_speed_current_A(&c->nosc, e_w),
                                     .v_max_V    = v_max_V};
    current_ref_update(&d->current_ref, &c->current_ref, &c->motor, &d->speed_ref, &in);
    control_law(d, v_max_V);

    if (!symmetric_range(d->v_V.d, s->dc_link_V) || !symmetric_range(d->v_V.q, s->dc_link_V)) {
        return trip(d, DRIVE_FAULT_NUMERIC);
    }
    /* EQ-DRIVE-2: in force from one to two periods after this sample. */
    const float          theta = s->theta_e_rad + (1.5f * c->ts_s * s->omega_e_radps);
    const drive_output_t out   = {
          .duty        = svpwm_duty(frames_inverse_park(d->v_V, frames_angle(theta)), s->dc_link_V),
          .gate_enable = true};
    return out;
}

drive_output_t drive_tick(drive_t *d, const drive_sample_t *sample, const drive_command_t *command)
{
    if ((d->config == NULL) || (d->state == DRIVE_FAULT)) {
        return open_bridge;
    }
    const drive_fault_t fault = find_fault(d->config, sample, command);
    if (fault != DRIVE_FAULT_NONE) {
        return trip(d, fault);
    }

    const dq_t i_A =
        frames_park(frames_clarke(sample->ia_A, sample->ib_A), frames_angle(sample->theta_e_rad));
    d->meas.omega_e_radps = sample->omega_e_radps;
    d->meas.iq_A          = i_A.q;
    d->meas.id_A          = i_A.d;

    if (!command->run) {
        d->state = DRIVE_OFF;
        return open_bridge;
    }
    if (d->state == DRIVE_OFF) {
        start(d);
    }
    return run(d, sample, command);
}
