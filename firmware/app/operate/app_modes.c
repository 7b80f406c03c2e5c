/* SPDX-License-Identifier: MIT */
#include "app_modes.h"

#include "app_config_check.h"
#include "app_states.h"

static void clear_snapshot(app_snapshot_t *s)
{
    const app_snapshot_t none = {.fault = APP_FAULT_NONE, .mode = APP_MODE_BOOT};
    *s                        = none;
}

ctl_status_t app_modes_init(app_modes_t *m, const app_config_t *c, const drive_config_t *d)
{
    const bool                ok         = app_config_check(c, d) == CTL_OK;
    const app_scale_sample_t  no_sample  = {.valid = false};
    const app_angle_reading_t no_reading = {.speed_valid = false};

    (void)drive_init(&m->drive, d);
    (void)app_scale_init(&m->scale, &c->scale, c->board.positions, d->trip_current_A);
    (void)app_angle_init(&m->angle, &c->angle, d);
    (void)app_align_init(&m->align, &c->align, d);
    (void)app_stop_init(&m->stop, &c->stop, d);
    (void)app_watch_heat_init(&m->heat, &c->heat, d->current_max_A, d->ts_s);
    app_position_init(&m->position, &m->angle);
    m->config           = c;
    m->mode             = ok ? APP_MODE_BOOT : APP_MODE_FAULT;
    m->fault            = ok ? APP_FAULT_NONE : APP_FAULT_CONFIG;
    m->sample           = no_sample;
    m->reading          = no_reading;
    m->ticks            = 0UL;
    m->sum_a_cnt        = 0UL;
    m->sum_b_cnt        = 0UL;
    m->timer_ticks      = 0U;
    m->calibrated       = false;
    m->armed            = false;
    m->commission_armed = false;
    m->align_armed      = false;
    m->hot              = true;
    m->dc_link_out      = true;
    m->tripped          = false;
    m->locked           = false;
    m->gate_on          = false;
    m->phase_errors     = 0U;
    m->current_max_A    = d->current_max_A;
    m->too_hot          = false;
    m->per_sink_degC    = (c->temperature_trip_degC > c->temperature_limit_degC)
                              ? (1.0f / (c->temperature_trip_degC - c->temperature_limit_degC))
                              : 0.0f;
    app_commission_init(&m->commission, d);
    m->zero_a_A = 0.0f;
    m->zero_b_A = 0.0f;
    clear_snapshot(&m->snapshot);
    m->snapshot.fault = m->fault;
    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

/* (T - T_limit) / (T_trip - T_limit) of the heat sink. */
static float warmth_of_sink(const app_modes_t *m)
{
    return (m->sample.temperature_degC - m->config->temperature_limit_degC) * m->per_sink_degC;
}

/* Converts the sample to SI units and angle. An invalid sample drops the angle reference, because
 * counts may be lost. */
static void measure(app_modes_t *m, const board_sample_t *raw)
{
    app_scale_sample(&m->scale, raw, &m->sample);
    if (m->sample.valid) {
        app_angle_update(&m->angle, raw, &m->reading);
        app_position_track(&m->position, &m->angle, &m->reading);
        m->hot = !m->sample.temperature_valid ||
                 !(m->sample.temperature_degC <= m->config->temperature_limit_degC);
        m->dc_link_out  = !base_in_range(m->sample.dc_link_V, m->drive.config->dc_link_min_V,
                                         m->drive.config->dc_link_max_V);
        m->phase_errors = raw->phase_errors;
        m->too_hot =
            !app_watch_heat_tick(&m->heat, m->sample.ia_A, m->sample.ib_A, warmth_of_sink(m));
    } else {
        app_angle_drop(&m->angle);
        m->reading.speed_valid = false;
        m->reading.index_fault = false;
    }
}

/* First fault found. Order: faults of any mode, faults of the samples, faults that need a driven
 * motor. */
static app_fault_t watch(const app_modes_t *m, const app_modes_input_t *in)
{
    const bool driving = (m->mode == APP_MODE_ALIGN) || (m->mode == APP_MODE_PRECHARGE) ||
                         (m->mode == APP_MODE_RUN) || (m->mode == APP_MODE_STOP) ||
                         (m->mode == APP_MODE_COMMISSION);

    if (in->memory_changed) {
        return APP_FAULT_MEMORY;
    }
    if (in->background_lost) {
        return APP_FAULT_BACKGROUND;
    }
    if (m->gate_on && (in->board_faults != (uint16_t)BOARD_FAULT_NONE)) {
        return APP_FAULT_BOARD;
    }
    if (m->gate_on && in->tick_missing) {
        return APP_FAULT_TICK;
    }
    if (m->reading.index_fault &&
        (m->mode != APP_MODE_COMMISSION)) { /* the lines are unknown there */
        return APP_FAULT_INDEX;
    }
    if ((driving || (m->mode == APP_MODE_CALIBRATE)) && !m->sample.valid) {
        return APP_FAULT_SAMPLE;
    }
    if (driving && m->too_hot) {
        return APP_FAULT_HEAT;
    }
    if (driving && !m->sample.temperature_valid) {
        return APP_FAULT_TEMPERATURE_SENSOR;
    }
    if (driving && !(m->sample.temperature_degC <= m->config->temperature_trip_degC)) {
        return APP_FAULT_TEMPERATURE;
    }
    return APP_FAULT_NONE;
}

static bridge_t act(app_modes_t *m, const app_modes_input_t *in)
{
    const bool runs = (m->mode == APP_MODE_RUN) || (m->mode == APP_MODE_STOP);

    return runs ? app_states_run(m, in) : app_states_rest(m, in);
}

bridge_t app_modes_tick(app_modes_t *m, const app_modes_input_t *in)
{
    if (m->fault == APP_FAULT_CONFIG) {
        return bridge_open();
    }
    m->ticks++;
    measure(m, in->raw);

    const app_fault_t fault = (m->mode == APP_MODE_FAULT) ? APP_FAULT_NONE : watch(m, in);
    const bridge_t    out = (fault == APP_FAULT_NONE) ? act(m, in) : app_states_trip(m, in, fault);
    m->gate_on            = out.gate_enable;
    return out;
}
