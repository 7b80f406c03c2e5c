/* SPDX-License-Identifier: MIT */
#include "drive_tick.h"

#include <math.h>
#include <stddef.h>

#include "estimate.h"
#include "feedforward.h"
#include "frames.h"
#include "svpwm.h"
#include "voltage.h"

/* Beyond anything a law asks for, and below where squares overflow. */
#define VOLTAGE_ANY_V 1.0e9f

static const dq_t           zero_dq     = {0.0f, 0.0f};
static const drive_output_t open_bridge = {.duty = {0.5f, 0.5f, 0.5f}, .gate_enable = false};

/* The speed now and the q voltage that holds it. */
static void reset_laws(drive_t *d, float omega_e_radps, float hold_q_V)
{
    if (DRIVE_HAS_LAW(DRIVE_LAW_NOC) || DRIVE_HAS_LAW(DRIVE_LAW_NOC_H) ||
        DRIVE_HAS_LAW(DRIVE_LAW_CONVENTIONAL)) {
        speed_ref_reset(&d->speed_ref, omega_e_radps);
        current_ref_reset(&d->current_ref);
    }
    if (DRIVE_HAS_LAW(DRIVE_LAW_SERVO)) {
        servo_law_reset(&d->servo, hold_q_V);
    }
}

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

    d->state         = DRIVE_OFF;
    d->fault         = DRIVE_FAULT_NONE;
    d->theta_hat_rad = 0.0f;
    d->now           = zero;
    nodo_reset(&d->observer, &zero);
    d->d_omega_dot = 0.0f;
    reset_laws(d, 0.0f, 0.0f);
    d->v_V       = zero_dq;
    d->v_limited = false;
}

static drive_fault_t find_fault(const drive_config_t *c, const drive_sample_t *s,
                                const drive_command_t *command)
{
    if (!s->valid || !base_within(s->theta_e_rad, BASE_TWO_PI)) {
        return DRIVE_FAULT_SAMPLE;
    }
    if (!base_within(s->ia_A, c->trip_current_A) || !base_within(s->ib_A, c->trip_current_A) ||
        !base_within(s->ia_A + s->ib_A, c->trip_current_A)) { /* phase c */
        return DRIVE_FAULT_OVER_CURRENT;
    }
    if (!base_in_range(s->dc_link_V, c->dc_link_min_V, c->dc_link_max_V)) {
        return DRIVE_FAULT_DC_LINK;
    }
    if (!base_within(s->omega_e_radps, c->trip_speed_e_radps)) {
        return DRIVE_FAULT_OVER_SPEED;
    }
    if (!base_within(command->omega_e_radps, c->trip_speed_e_radps)) {
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
static void start(drive_t *d, const drive_sample_t *s)
{
    const nodo_meas_t y = estimate_measurement(s);

    estimate_start(d, s);
    reset_laws(d, y.omega_e_radps, feedforward_hold_q_V(&d->config->motor, &y, &d->observer));
    d->v_V   = zero_dq;
    d->state = DRIVE_RUN;
}

static dq_t feedback_V(const drive_config_t *c, const nosc_error_t *e)
{
    return drive_config_is(c, DRIVE_LAW_CONVENTIONAL)
               ? conventional_feedback_V(&c->conventional, &c->motor, e)
               : nosc_feedback_V(&c->nosc, e);
}

static void update_references(drive_t *d, const drive_sample_t *s, float command_e_radps)
{
    const drive_config_t     *c   = d->config;
    const float               e_w = d->now.omega_e_radps - d->speed_ref.omega_e_radps;
    const current_ref_input_t in  = {.est         = &d->observer,
                                     .state       = &d->now,
                                     .d_omega_dot = d->d_omega_dot,
                                     .iq_speed_A  = nosc_speed_current_A(&c->nosc, e_w),
                                     .dc_link_V   = s->dc_link_V,
                                     .v_max_V     = s->dc_link_V * BASE_1_SQRT3};
    const speed_ref_limits_t  limits =
        current_ref_speed_limits(&d->current_ref, &c->current_ref, &c->motor, &in, command_e_radps);

    speed_ref_update(&d->speed_ref, &limits, command_e_radps, d->now.omega_e_radps, c->ts_s);
    current_ref_update(&d->current_ref, &c->current_ref, &c->motor, &d->speed_ref, &in);
}

/* EQ-VOLTAGE-1 within the hexagon's reach in the direction of u. The limit turns the vector; what cannot be
 * produced in the new direction is cut off. */
static void limit_to_hexagon(drive_t *d, float length_V, frames_angle_t angle, float dc_link_V)
{
    const motor_reduced_t *m     = &d->config->motor;
    const float            share = svpwm_share(frames_inverse_park(d->v_V, angle), dc_link_V);

    if (share < 1.0f) {
        const float hold_q_V = feedforward_hold_q_V(m, &d->now, &d->observer);
        const dq_t  v_V      = voltage_limit(d->v_V, hold_q_V, share * length_V);
        const float cut      = svpwm_share(frames_inverse_park(v_V, angle), dc_link_V);

        d->v_V.d     = cut * v_V.d;
        d->v_V.q     = cut * v_V.q;
        d->v_limited = true;
    }
}

/* What the modulator can produce of u: up to the circle, or to the hexagon around it. */
static void limit_voltage(drive_t *d, dq_t u_V, frames_angle_t angle, float dc_link_V)
{
    const drive_config_t *c        = d->config;
    const float           circle_V = dc_link_V * BASE_1_SQRT3;
    const float           square   = (u_V.d * u_V.d) + (u_V.q * u_V.q);

    d->v_V       = u_V;
    d->v_limited = false;
    if (square <= circle_V * circle_V) {
        return;
    }
    if (c->overmodulation) {
        limit_to_hexagon(d, sqrtf(square), angle, dc_link_V);
    } else {
        d->v_V =
            voltage_limit(u_V, feedforward_hold_q_V(&c->motor, &d->now, &d->observer), circle_V);
        d->v_limited = true;
    }
}

/* EQ-DRIVE-1 and the limits; the result is stored as the voltage of the next period. False when the law gives
 * no number: the limit would turn a NaN into full voltage. */
static bool control_law(drive_t *d, frames_angle_t angle, float dc_link_V)
{
    const drive_config_t *c   = d->config;
    const dq_t            ref = d->current_ref.i_A;

    nosc_error_t e = {.omega_e_radps = d->now.omega_e_radps - d->speed_ref.omega_e_radps,
                      .iq_A          = d->now.iq_A - ref.q,
                      .id_A          = d->now.id_A - ref.d};
    e = nosc_limit_speed_error(&c->nosc, e, ref.q, d->current_ref.iq_lo_A, d->current_ref.iq_hi_A);

    const float w_d =
        d->now.omega_e_radps - e.omega_e_radps; /* the reference as far as it is followed */
    const dq_t fb_V = feedback_V(c, &e);
    const dq_t ff_V = feedforward_V(&c->motor, &d->current_ref, w_d, &d->now, &d->observer);
    const dq_t u_V  = {.d = fb_V.d + ff_V.d, .q = fb_V.q + ff_V.q};

    if (!base_within(u_V.d, VOLTAGE_ANY_V) || !base_within(u_V.q, VOLTAGE_ANY_V)) {
        return false;
    }
    limit_voltage(d, u_V, angle, dc_link_V);
    return true;
}

/* Paper B's laws in the place of EQ-DRIVE-1; false as above. */
static bool servo_law(drive_t *d, frames_angle_t angle, float dc_link_V, float command_e_radps)
{
    const servo_law_config_t *c   = &d->config->servo;
    const dq_t                u_V = servo_law_voltage_V(&d->servo, c, &d->now, command_e_radps);

    if (!base_within(u_V.d, VOLTAGE_ANY_V) || !base_within(u_V.q, VOLTAGE_ANY_V)) {
        return false;
    }
    limit_voltage(d, u_V, angle, dc_link_V);
    servo_law_realise(&d->servo, c, d->v_V);
    return true;
}

static drive_output_t modulate(const drive_t *d, frames_angle_t angle, float dc_link_V)
{
    const drive_config_t *c     = d->config;
    const dq_t            i_A   = {.d = d->now.id_A, .q = d->now.iq_A};
    const abc_t           duty  = svpwm_duty(frames_inverse_park(d->v_V, angle), dc_link_V);
    const abc_t           i_abc = frames_inverse_clarke(frames_inverse_park(i_A, angle));
    const drive_output_t  out   = {.duty        = dead_time_compensate(&c->dead_time, duty, i_abc),
                                   .gate_enable = true};
    return out;
}

static drive_output_t run_servo(drive_t *d, const drive_sample_t *s, float command_e_radps)
{
    const frames_angle_t angle = frames_angle(estimate_middle_angle_rad(d->config, s));

    d->now = estimate_measurement(s);
    return servo_law(d, angle, s->dc_link_V, command_e_radps) ? modulate(d, angle, s->dc_link_V)
                                                              : trip(d, DRIVE_FAULT_NUMERIC);
}

static drive_output_t run_noc(drive_t *d, const drive_sample_t *s, float command_e_radps)
{
    bool        plausible = true;
    const float theta_rad = estimate_update(d, s, &plausible);

    if (!plausible) {
        return trip(d, DRIVE_FAULT_ENCODER);
    }
    if (!base_within(d->now.omega_e_radps, d->config->trip_speed_e_radps)) {
        return trip(d, DRIVE_FAULT_OVER_SPEED);
    }
    update_references(d, s, command_e_radps);

    const frames_angle_t angle = frames_angle(theta_rad);
    if (!control_law(d, angle, s->dc_link_V)) {
        return trip(d, DRIVE_FAULT_NUMERIC);
    }
    return modulate(d, angle, s->dc_link_V);
}

/* The only place where the laws part; drive_init() let no other law through. */
static drive_output_t run(drive_t *d, const drive_sample_t *s, float command_e_radps)
{
    if (drive_config_is(d->config, DRIVE_LAW_NOC) || drive_config_is(d->config, DRIVE_LAW_NOC_H) ||
        drive_config_is(d->config, DRIVE_LAW_CONVENTIONAL)) {
        return run_noc(d, s, command_e_radps);
    }
    return drive_config_is(d->config, DRIVE_LAW_SERVO) ? run_servo(d, s, command_e_radps)
                                                       : trip(d, DRIVE_FAULT_NUMERIC);
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
    if (!command->run) {
        d->state = DRIVE_OFF;
        return open_bridge;
    }
    if (d->state == DRIVE_OFF) {
        start(d, sample);
    }
    return run(d, sample, command->omega_e_radps);
}
