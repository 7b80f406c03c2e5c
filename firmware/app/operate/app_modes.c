/* SPDX-License-Identifier: MIT */
#include "app_modes.h"

#include <stddef.h>

#include "app_config_check.h"
#include "app_measure.h"
#include "app_states.h"
#include "app_warmth.h"

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
    app_warmth_init(m, c, d);
    app_position_init(&m->position, &m->angle);
    m->config           = c;
    m->mode             = ok ? APP_MODE_BOOT : APP_MODE_FAULT;
    m->fault            = ok ? APP_FAULT_NONE : APP_FAULT_CONFIG;
    m->sample           = no_sample;
    m->reading          = no_reading;
    m->ticks            = 0UL;
    m->torque_ticks     = 0UL;
    m->to_torque.share  = 0.0f;
    m->sum_a_cnt        = 0UL;
    m->sum_b_cnt        = 0UL;
    m->timer_ticks      = 0U;
    m->calibrated       = false;
    m->armed            = false;
    m->commission_armed = false;
    m->align_armed      = false;
    m->tripped          = false;
    m->locked           = false;
    m->gate_on          = false;
    app_commission_init(&m->commission, d);
    app_brake_init(&m->brake);
    m->zero_a_A = 0.0f;
    m->zero_b_A = 0.0f;
    clear_snapshot(&m->snapshot);
    m->snapshot.fault = m->fault;
#if BOARD_CHOPPER
    app_chopper_init(&m->chopper, ok ? &c->chopper : NULL, d->ts_s);
#endif
#if BOARD_CURRENT_SENSORS == 3
    app_watch_sum_init(&m->sum, c->board.current_sensors);
    m->sum_differs = false;
#endif
    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

/* True if app_fault_of() may find one. */
static bool is_suspicious(const app_modes_t *m, const app_modes_input_t *in)
{
    return in->memory_changed || in->background_lost || in->tick_missing ||
           m->reading.index_fault || !m->sample.valid ||
           (in->board_faults != (uint16_t)BOARD_FAULT_NONE) || (m->sink_fault != APP_FAULT_NONE) ||
           m->too_hot || app_modes_sum_differs(m);
}

static bridge_t act(app_modes_t *m, const app_modes_input_t *in)
{
    const bool runs = (m->mode == APP_MODE_RUN) || (m->mode == APP_MODE_STOP);

    return runs ? app_states_run(m, in) : app_states_rest(m, in);
}

APP_PART bridge_t app_modes_tick(app_modes_t *m, const app_modes_input_t *in)
{
    if (m->fault == APP_FAULT_CONFIG) {
        return bridge_open();
    }
    m->ticks++;
    app_measure(m, in);

    const app_fault_t fault = is_suspicious(m, in) ? app_fault_of(m, in) : APP_FAULT_NONE;
    const bridge_t    out = (fault == APP_FAULT_NONE) ? act(m, in) : app_states_trip(m, in, fault);
    m->gate_on            = out.gate_enable;
    return out;
}
