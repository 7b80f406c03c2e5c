/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#if APP_TRIM
void app_registers_init_trim(app_registers_t *r)
{
    app_trim_reset(&r->trim);
    r->trimmed        = r->trim.values;
    r->requested.trim = 1U;
}

static bool are_the_same(const app_trim_values_t *x, const app_trim_values_t *y)
{
    return base_within(x->a_A - y->a_A, 0.0f) && base_within(x->b_A - y->b_A, 0.0f) &&
           base_within(x->gain - y->gain, 0.0f);
}

/* Brings the learned values into force. Zeros that would be too far from the nominal ones end it,
 * as any other bound does. */
static void put_in_force(app_registers_t *r, volatile app_scale_t *scale)
{
    const app_trim_values_t *was = &r->trimmed;
    const app_trim_values_t *now = &r->trim.values;

    if (are_the_same(was, now)) {
        return;
    }
    if (!app_scale_trim(scale, now->a_A - was->a_A, now->b_A - was->b_A, now->gain)) {
        app_trim_end(&r->trim);
        (void)app_scale_trim(scale, -was->a_A, -was->b_A, 0.0f);
    }
    r->trimmed = r->trim.values;
}

void app_registers_see_trim(app_registers_t *r, volatile app_scale_t *scale)
{
    const app_status_t     *s    = &r->status;
    const app_trim_seen_t   seen = {.ticks = s->ticks,
                                    .runs  = (s->mode == APP_MODE_RUN) && !s->without_angle &&
                                            !s->voltage_limited,
                                    .theta_e_rad   = s->theta_e_rad,
                                    .omega_e_radps = s->speed_e_radps,
                                    .ia_A          = s->ia_A,
                                    .ib_A          = s->ib_A,
                                    .v_V           = s->v_V};
    const app_trim_config_t c    = {.motor         = &r->drive->motor,
                                    .ts_s          = r->drive->ts_s,
                                    .current_max_A = r->drive->current_max_A,
                                    .offset_most_A = r->config->zero_drift_A};

    if (s->mode == APP_MODE_CALIBRATE) {
        app_trim_zeroed(&r->trim);
        r->trimmed.a_A = 0.0f; /* the tick measures the zeros itself */
        r->trimmed.b_A = 0.0f;
    } else if (r->requested.trim == 0U) {
        app_trim_reset(&r->trim);
    } else {
        (void)app_trim_see(&r->trim, &seen, &c);
    }
    put_in_force(r, scale);
}

uint16_t app_registers_trim_on(const app_registers_t *r)
{
    return r->requested.trim;
}

void app_registers_set_trim(app_registers_request_t *w, float on)
{
    w->trim = (uint16_t)on;
}

app_trim_values_t app_registers_trimmed(const app_registers_t *r)
{
    return r->trimmed;
}

uint16_t app_registers_trim_blocks(const app_registers_t *r)
{
    return r->trim.blocks;
}
#else
void app_registers_init_trim(app_registers_t *r)
{
    (void)r;
}

void app_registers_see_trim(app_registers_t *r, volatile app_scale_t *scale)
{
    (void)r;
    (void)scale;
}

uint16_t app_registers_trim_on(const app_registers_t *r)
{
    (void)r;
    return 0U;
}

void app_registers_set_trim(app_registers_request_t *w, float on)
{
    (void)w;
    (void)on;
}

app_trim_values_t app_registers_trimmed(const app_registers_t *r)
{
    const app_trim_values_t nothing = {0.0f, 0.0f, 0.0f};

    (void)r;
    return nothing;
}

uint16_t app_registers_trim_blocks(const app_registers_t *r)
{
    (void)r;
    return 0U;
}
#endif
