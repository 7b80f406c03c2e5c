/* SPDX-License-Identifier: MIT */
#include "estimate.h"

#include "frames.h"

nodo_meas_t estimate_measurement(const drive_sample_t *s)
{
    const dq_t i_A = frames_park(frames_clarke(s->ia_A, s->ib_A), frames_angle(s->theta_e_rad));
    const nodo_meas_t y = {.omega_e_radps = s->omega_e_radps, .iq_A = i_A.q, .id_A = i_A.d};
    return y;
}

float estimate_middle_angle_rad(const drive_config_t *c, const drive_sample_t *s)
{
    return s->theta_e_rad + (1.5f * c->ts_s * s->omega_e_radps); /* EQ-DRIVE-2 */
}

void estimate_start(drive_t *d, const drive_sample_t *s)
{
    const nodo_meas_t y = estimate_measurement(s);

    nodo_reset(&d->observer, &y);
    d->theta_hat_rad = nodo_encoder_wrap(s->theta_e_rad);
    d->d_omega_dot   = 0.0f;
    if (DRIVE_HAS_LAW(DRIVE_LAW_NOC_H)) {
        nodo_harmonic_reset(&d->harmonic, &y, s->theta_e_rad);
    }
}

/* Paper A's observer or the conventional one, which correct and predict in one step. */
static float update_from_speed(drive_t *d, const drive_sample_t *s)
{
    const drive_config_t *c = d->config;

    d->now = estimate_measurement(s);
    if (drive_config_is(c, DRIVE_LAW_CONVENTIONAL)) {
        conventional_update(&d->observer, &c->conventional, &c->motor, &d->now, d->v_V, c->ts_s);
    } else if (drive_config_is(c, DRIVE_LAW_NOC)) {
        nodo_update(&d->observer, &c->nodo, &c->motor, &d->now, d->v_V, c->ts_s);
    } else {
        /* drive_init() lets no other law have the speed form */
    }
    return estimate_middle_angle_rad(c, s);
}

/* Both correct with this sample and predict to the next. */
static void observe_plain(drive_t *d, dq_t i_A, float angle_error)
{
    const drive_config_t *c = d->config;

    nodo_encoder_correct(&d->observer, &d->theta_hat_rad, &c->nodo_encoder, i_A, angle_error,
                         c->ts_s);
    nodo_encoder_predict(&d->observer, &d->theta_hat_rad, &c->motor, d->v_V, c->ts_s);
}

static void observe_harmonic(drive_t *d, dq_t i_A, float angle_error)
{
    const drive_config_t *c = d->config;

    nodo_harmonic_correct(&d->harmonic, c->nodo_harmonic, i_A, angle_error);
    const nodo_harmonic_view_t view =
        nodo_harmonic_predict(&d->harmonic, c->nodo_harmonic, &c->motor, d->v_V, c->ts_s);

    d->observer      = view.total;
    d->d_omega_dot   = view.d_omega_dot;
    d->theta_hat_rad = d->harmonic.theta_rad;
}

static float update_from_encoder(drive_t *d, const drive_sample_t *s, bool *plausible)
{
    const drive_config_t *c = d->config;
    const dq_t  i_A = frames_park(frames_clarke(s->ia_A, s->ib_A), frames_angle(d->theta_hat_rad));
    const float angle_error = nodo_encoder_wrap(s->theta_e_rad - d->theta_hat_rad);

    if (drive_config_is(c, DRIVE_LAW_NOC_H)) {
        observe_harmonic(d, i_A, angle_error);
    } else if (drive_config_is(c, DRIVE_LAW_NOC)) {
        observe_plain(d, i_A, angle_error);
    } else {
        /* drive_init() lets no other law have the encoder form */
    }
    /* A standing angle looks like a load that no motor could carry. */
    *plausible = base_within(angle_error, c->trip_angle_rad) &&
                 base_within(d->observer.d_omega, c->trip_d_omega);
    d->now.omega_e_radps = d->observer.omega_e_radps;
    d->now.iq_A          = d->observer.iq_A;
    d->now.id_A          = d->observer.id_A;
    return d->theta_hat_rad + (0.5f * c->ts_s * d->now.omega_e_radps); /* EQ-DRIVE-2 */
}

float estimate_update(drive_t *d, const drive_sample_t *s, bool *plausible)
{
    return (d->config->form == DRIVE_FORM_ENCODER) ? update_from_encoder(d, s, plausible)
                                                   : update_from_speed(d, s);
}
