/* SPDX-License-Identifier: MIT */
#include "app_warmth.h"

#include "app_slow.h"

void app_warmth_init(app_modes_t *m, const app_config_t *c, const drive_config_t *d)
{
    m->per_sink_degC = (c->temperature_trip_degC > c->temperature_limit_degC)
                           ? (1.0f / (c->temperature_trip_degC - c->temperature_limit_degC))
                           : 0.0f;
    m->over_degC     = 0.0f;
    m->sink_fault    = APP_FAULT_TEMPERATURE_SENSOR;
    m->too_hot       = false;
    m->hot           = true;
    m->dc_link_out   = true;
    m->phase_errors  = 0U;
    (void)app_watch_heat_init(&m->heat, &c->heat, d->current_max_A, app_slow_s(d->ts_s));
}

static app_fault_t fault_of_sink(const app_modes_t *m)
{
    app_fault_t fault = APP_FAULT_NONE;

    if (!m->sample.temperature_valid) {
        fault = APP_FAULT_TEMPERATURE_SENSOR;
    } else if (!(m->sample.temperature_degC <= m->config->temperature_trip_degC)) {
        fault = APP_FAULT_TEMPERATURE;
    } else {
        /* none */
    }
    return fault;
}

void app_warmth_sink(app_modes_t *m, const board_sample_t *raw)
{
    app_scale_temperature(&m->scale, raw, &m->sample);

    const float over_degC = m->sample.temperature_degC - m->config->temperature_limit_degC;
    m->over_degC          = over_degC;
    m->sink_fault         = fault_of_sink(m);
    m->hot                = !m->sample.temperature_valid || !(over_degC <= 0.0f);
    m->phase_errors       = raw->phase_errors;
}

void app_warmth_heat(app_modes_t *m)
{
    const float warmth = m->over_degC * m->per_sink_degC;

    m->too_hot     = !app_watch_heat_tick(&m->heat, m->sample.ia_A, m->sample.ib_A, warmth);
    m->dc_link_out = !base_in_range(m->sample.dc_link_V, m->drive.config->dc_link_min_V,
                                    m->drive.config->dc_link_max_V);
}
