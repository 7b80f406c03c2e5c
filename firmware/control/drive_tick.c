/* SPDX-License-Identifier: MIT */
#include "drive_tick.h"

#include <math.h>
#include <stddef.h>

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
    if (DRIVE_HAS_LAW(DRIVE_LAW_NOC) || DRIVE_HAS_LAW(DRIVE_LAW_CONVENTIONAL)) {
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
    reset_laws(d, 0.0f, 0.0f);
    d->v_V       = zero_dq;
    d->v_limited = false;
}

/* One comparison; false for NaN, as base_in_range(). */
static bool symmetric_range(float x, float limit)
{
    return fabsf(x) <= limit;
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

static nodo_meas_t measurement(const drive_sample_t *s)
{
    const dq_t i_A = frames_park(frames_clarke(s->ia_A, s->ib_A), frames_angle(s->theta_e_rad));
    const nodo_meas_t y = {.omega_e_radps = s->omega_e_radps, .iq_A = i_A.q, .id_A = i_A.d};
    return y;
}

/* Bumpless: the observer takes over the measurement and the reference the present speed. */
static void start(drive_t *d, const drive_sample_t *s)
{
    const nodo_meas_t y = measurement(s);

    nodo_reset(&d->observer, &y);
    d->theta_hat_rad = nodo_encoder_wrap(s->theta_e_rad);
    reset_laws(d, y.omega_e_radps, feedforward_hold_q_V(&d->config->motor, &y, &d->observer));
    d->v_V   = zero_dq;
    d->state = DRIVE_RUN;
}

/* From the measured speed: the angle of the middle of the period in which the new voltage acts. EQ-DRIVE-2 */
static float middle_angle_rad(const drive_config_t *c, const drive_sample_t *s)
{
    return s->theta_e_rad + (1.5f * c->ts_s * s->omega_e_radps);
}

/* Observer and feedback: all in which paper A's law and the conventional one differ. */
static void observe(drive_t *d)
{
    const drive_config_t *c = d->config;

    if (drive_config_is(c, DRIVE_LAW_CONVENTIONAL)) {
        conventional_update(&d->observer, &c->conventional, &c->motor, &d->now, d->v_V, c->ts_s);
    } else {
        nodo_update(&d->observer, &c->nodo, &c->motor, &d->now, d->v_V, c->ts_s);
    }
}

static dq_t feedback_V(const drive_config_t *c, const nosc_error_t *e)
{
    return drive_config_is(c, DRIVE_LAW_CONVENTIONAL)
               ? conventional_feedback_V(&c->conventional, &c->motor, e)
               : nosc_feedback_V(&c->nosc, e);
}

/* Paper A's observer; returns the angle of the middle of the period in which the new voltage acts. */
static float estimate_from_speed(drive_t *d, const drive_sample_t *s)
{
    const drive_config_t *c = d->config;

    d->now = measurement(s);
    observe(d);
    return middle_angle_rad(c, s);
}

/* Correct with this sample, predict to the next; returns the angle as above. */
static float estimate_from_encoder(drive_t *d, const drive_sample_t *s, bool *plausible)
{
    const drive_config_t *c = d->config;
    const dq_t  i_A = frames_park(frames_clarke(s->ia_A, s->ib_A), frames_angle(d->theta_hat_rad));
    const float angle_error = nodo_encoder_wrap(s->theta_e_rad - d->theta_hat_rad);

    nodo_encoder_correct(&d->observer, &d->theta_hat_rad, &c->nodo_encoder, i_A, angle_error,
                         c->ts_s);
    nodo_encoder_predict(&d->observer, &d->theta_hat_rad, &c->motor, d->v_V, c->ts_s);
    /* A standing angle looks like a load that no motor could carry. */
    *plausible = symmetric_range(angle_error, c->trip_angle_rad) &&
                 symmetric_range(d->observer.d_omega, c->trip_d_omega);
    d->now.omega_e_radps = d->observer.omega_e_radps;
    d->now.iq_A          = d->observer.iq_A;
    d->now.id_A          = d->observer.id_A;
    return d->theta_hat_rad + (0.5f * c->ts_s * d->now.omega_e_radps); /* EQ-DRIVE-2 */
}

static void update_references(drive_t *d, const drive_sample_t *s, float command_e_radps)
{
    const drive_config_t     *c   = d->config;
    const float               e_w = d->now.omega_e_radps - d->speed_ref.omega_e_radps;
    const current_ref_input_t in  = {.est        = &d->observer,
                                     .state      = &d->now,
                                     .iq_speed_A = nosc_speed_current_A(&c->nosc, e_w),
                                     .dc_link_V  = s->dc_link_V,
                                     .v_max_V    = s->dc_link_V * BASE_1_SQRT3};
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

    if (!symmetric_range(u_V.d, VOLTAGE_ANY_V) || !symmetric_range(u_V.q, VOLTAGE_ANY_V)) {
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

    if (!symmetric_range(u_V.d, VOLTAGE_ANY_V) || !symmetric_range(u_V.q, VOLTAGE_ANY_V)) {
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
    const frames_angle_t angle = frames_angle(middle_angle_rad(d->config, s));

    d->now = measurement(s);
    return servo_law(d, angle, s->dc_link_V, command_e_radps) ? modulate(d, angle, s->dc_link_V)
                                                              : trip(d, DRIVE_FAULT_NUMERIC);
}

static drive_output_t run_noc(drive_t *d, const drive_sample_t *s, float command_e_radps)
{
    bool        plausible = true;
    const float theta_rad = (d->config->form == DRIVE_FORM_ENCODER)
                                ? estimate_from_encoder(d, s, &plausible)
                                : estimate_from_speed(d, s);

    if (!plausible) {
        return trip(d, DRIVE_FAULT_ENCODER);
    }
    if (!symmetric_range(d->now.omega_e_radps, d->config->trip_speed_e_radps)) {
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
    if (drive_config_is(d->config, DRIVE_LAW_NOC) ||
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
