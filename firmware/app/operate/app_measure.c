/* SPDX-License-Identifier: MIT */
#include "app_measure.h"

#include "app_slow.h"
#include "app_warmth.h"

void app_measure(app_modes_t *m, const app_modes_input_t *in)
{
    app_scale_sample(&m->scale, in->raw, &m->sample);
    if (m->sample.valid) {
        app_angle_update(&m->angle, in->raw, &m->reading);
        app_position_track(&m->position, &m->angle, &m->reading);
#if BOARD_CURRENT_SENSORS == 3
        m->sum_differs = app_watch_sum_differs(&m->sum, in->raw);
#endif
        if ((in->slow & (uint16_t)APP_SLOW_SINK) != 0U) {
            app_warmth_sink(m, in->raw);
        }
        if ((in->slow & (uint16_t)APP_SLOW_HEAT) != 0U) {
            app_warmth_heat(m);
#if BOARD_CHOPPER
            app_chopper_turn(&m->chopper, in->raw, m->sample.dc_link_V, m->ticks);
#endif
        }
    } else {
        app_angle_drop(&m->angle);
        m->reading.speed_valid = false;
        m->reading.index_fault = false;
    }
}
