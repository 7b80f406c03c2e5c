/* SPDX-License-Identifier: MIT */
#include "app_modes.h"

/* Two statements of the same number, both in single precision. */
#define SAME_RATIO 1.0e-4f

static bool same(float x, float y)
{
    return base_in_range(x, y * (1.0f - SAME_RATIO), y * (1.0f + SAME_RATIO));
}

static bool drive_fits(const app_config_t *c, const drive_config_t *d)
{
    const drive_hardware_t *h       = &d->hardware;
    const float             top_cnt = (float)(BOARD_ADC_CODES - 1U);

    return (h->updates_per_period >= 1U) && (h->updates_per_period <= BOARD_UPDATES_MAX) &&
           same(d->ts_s * (float)h->updates_per_period, c->pwm_period_s) &&
           (h->encoder_positions == BOARD_POSITIONS) && same(h->dead_time_s, c->dead_time_s) &&
           (d->dc_link_max_V <= (top_cnt * c->scale.dc_link_V_per_cnt));
}

static bool values_ok(const app_config_t *c)
{
    return base_in_range(c->temperature_trip_degC, -100.0f, 300.0f) &&
           base_in_range(c->temperature_limit_degC, -100.0f, c->temperature_trip_degC) &&
           (c->calibrate_ticks > 0U) && (c->background_ticks > 0U);
}

static void clear_snapshot(app_snapshot_t *s)
{
    const app_snapshot_t none = {.fault = APP_FAULT_NONE, .mode = APP_MODE_BOOT};
    *s                        = none;
}

ctl_status_t app_modes_init(app_modes_t *m, const app_config_t *c, const drive_config_t *d)
{
    const bool drive_ok = drive_init(&m->drive, d) == CTL_OK;
    const bool scale_ok = app_scale_init(&m->scale, &c->scale, d->trip_current_A) == CTL_OK;
    const bool angle_ok = app_angle_init(&m->angle, &c->angle, d) == CTL_OK;
    const bool align_ok = app_align_init(&m->align, &c->align, d) == CTL_OK;
    const bool gate_ok  = app_gate_check(&c->gate) == CTL_OK;
    const bool ok =
        drive_ok && scale_ok && angle_ok && align_ok && gate_ok && drive_fits(c, d) && values_ok(c);
    const app_scale_sample_t  no_sample  = {.valid = false};
    const app_angle_reading_t no_reading = {.speed_valid = false};

    m->config       = c;
    m->mode         = ok ? APP_MODE_BOOT : APP_MODE_FAULT;
    m->fault        = ok ? APP_FAULT_NONE : APP_FAULT_CONFIG;
    m->sample       = no_sample;
    m->reading      = no_reading;
    m->ticks        = 0UL;
    m->sum_a_cnt    = 0UL;
    m->sum_b_cnt    = 0UL;
    m->timer_ticks  = 0U;
    m->calibrated   = false;
    m->armed        = false;
    m->hot          = true;
    m->dc_link_out  = true;
    m->tripped      = false;
    m->gate_on      = false;
    m->phase_errors = 0U;
    clear_snapshot(&m->snapshot);
    m->snapshot.fault = m->fault;
    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

static void enter(app_modes_t *m, app_mode_t mode)
{
    m->mode        = mode;
    m->timer_ticks = 0U;
    m->sum_a_cnt   = 0UL;
    m->sum_b_cnt   = 0UL;
    m->armed       = false;
}

/* SI units and angle of this tick. After an invalid sample the count cannot be trusted any more. */
static void measure(app_modes_t *m, const board_sample_t *raw)
{
    m->sample = app_scale_sample(&m->scale, raw);
    if (m->sample.valid) {
        m->reading = app_angle_update(&m->angle, raw);
        m->hot     = !m->sample.temperature_valid ||
                 !(m->sample.temperature_degC <= m->config->temperature_limit_degC);
        m->dc_link_out  = !base_in_range(m->sample.dc_link_V, m->drive.config->dc_link_min_V,
                                         m->drive.config->dc_link_max_V);
        m->phase_errors = raw->phase_errors;
    } else {
        app_angle_drop(&m->angle);
        m->reading.speed_valid = false;
        m->reading.index_fault = false;
    }
}

static drive_sample_t drive_sample(const app_modes_t *m)
{
    const drive_sample_t s = {.ia_A          = m->sample.ia_A,
                              .ib_A          = m->sample.ib_A,
                              .dc_link_V     = m->sample.dc_link_V,
                              .theta_e_rad   = m->reading.theta_e_rad,
                              .band_rad      = m->reading.band_rad,
                              .edge_gap_s    = m->reading.edge_gap_s,
                              .omega_e_radps = m->reading.omega_e_radps,
                              .valid         = m->sample.valid && m->reading.speed_valid};
    return s;
}

/* What would be wrong in any mode, then what matters as soon as samples are used, then what needs the bridge. */
static app_fault_t watch(const app_modes_t *m, const app_modes_input_t *in)
{
    const bool driving =
        (m->mode == APP_MODE_ALIGN) || (m->mode == APP_MODE_PRECHARGE) || (m->mode == APP_MODE_RUN);

    if (in->background_lost) {
        return APP_FAULT_BACKGROUND;
    }
    if (m->gate_on && (in->board_faults != (uint16_t)BOARD_FAULT_NONE)) {
        return APP_FAULT_BOARD;
    }
    if (m->reading.index_fault) {
        return APP_FAULT_INDEX;
    }
    if ((driving || (m->mode == APP_MODE_CALIBRATE)) && !m->sample.valid) {
        return APP_FAULT_SAMPLE;
    }
    if (driving && !m->sample.temperature_valid) {
        return APP_FAULT_TEMPERATURE_SENSOR;
    }
    if (driving && !(m->sample.temperature_degC <= m->config->temperature_trip_degC)) {
        return APP_FAULT_TEMPERATURE;
    }
    return APP_FAULT_NONE;
}

static bridge_t trip(app_modes_t *m, const app_modes_input_t *in, app_fault_t fault)
{
    const app_snapshot_t snapshot = {.fault          = fault,
                                     .mode           = m->mode,
                                     .drive_fault    = m->drive.fault,
                                     .board_faults   = in->board_faults,
                                     .raw            = in->raw,
                                     .speed_e_radps  = m->reading.omega_e_radps,
                                     .wanted_e_radps = in->command.omega_e_radps,
                                     .ticks          = m->ticks};
    const bool           encoder  = ((in->board_faults & (uint16_t)BOARD_FAULT_ENCODER) != 0U) ||
                         (m->drive.fault == DRIVE_FAULT_ENCODER);

    if (encoder) {
        app_angle_drop(&m->angle);
    }
    m->snapshot = snapshot;
    m->fault    = fault;
    enter(m, APP_MODE_FAULT);
    return bridge_open();
}

static bridge_t boot(app_modes_t *m)
{
    m->timer_ticks = (uint16_t)(m->timer_ticks + 1U);
    if (m->timer_ticks >= m->config->boot_ticks) {
        enter(m, APP_MODE_CALIBRATE);
    }
    return bridge_open();
}

static bridge_t calibrate(app_modes_t *m, const app_modes_input_t *in)
{
    m->sum_a_cnt += in->raw.ia_cnt;
    m->sum_b_cnt += in->raw.ib_cnt;
    m->timer_ticks = (uint16_t)(m->timer_ticks + 1U);
    if (m->timer_ticks < m->config->calibrate_ticks) {
        return bridge_open();
    }
    if (!app_scale_set_zero(&m->scale, m->sum_a_cnt, m->sum_b_cnt, m->timer_ticks)) {
        return trip(m, in, APP_FAULT_OFFSET);
    }
    m->calibrated = true;
    enter(m, APP_MODE_READY);
    return bridge_open();
}

/* What is in the way of a start and may go again. An unknown temperature is a fault of the run instead. */
static bool in_the_way(const app_modes_t *m)
{
    return (m->hot && m->sample.temperature_valid) || m->dc_link_out || m->tripped ||
           !app_gate_may_start(&m->config->gate, m->reading.omega_e_radps);
}

static void enter_run(app_modes_t *m)
{
    const bool precharge = !m->gate_on && (m->config->gate.precharge_ticks > 0U);
    enter(m, precharge ? APP_MODE_PRECHARGE : APP_MODE_RUN);
}

/* The bridge stays open in this tick: the next one looks at everything again in the new mode. */
static bridge_t ready(app_modes_t *m, const app_modes_input_t *in)
{
    m->tripped = (in->board_faults & (uint16_t)BOARD_FAULT_INPUT) != 0U;
    if (!in->command.run) {
        m->armed = true;
        return bridge_open();
    }
    const bool start = m->armed && !in_the_way(m);
    m->armed         = false; /* a refused start is not made up for later */
    if (start && (m->angle.reference != APP_ANGLE_NONE)) {
        enter_run(m);
    } else if (start) {
        app_align_start(&m->align, in->raw.position_cnt);
        enter(m, APP_MODE_ALIGN);
    }
    return bridge_open();
}

static bridge_t drive(app_modes_t *m, const app_command_t *wanted, bool run)
{
    const drive_sample_t  sample  = drive_sample(m);
    const drive_command_t command = {.omega_e_radps = wanted->omega_e_radps, .run = run};
    return drive_tick(&m->drive, &sample, &command);
}

/* The drive itself stays off: it only checks samples and command against its limits. False: one of them is wrong. */
static bool drive_watches(app_modes_t *m, const app_modes_input_t *in)
{
    (void)drive(m, &in->command, false);
    return m->drive.state != DRIVE_FAULT;
}

static bridge_t run(app_modes_t *m, const app_modes_input_t *in)
{
    const bridge_t out = drive(m, &in->command, in->command.run);

    if (m->drive.state == DRIVE_FAULT) {
        return trip(m, in, APP_FAULT_DRIVE);
    }
    if (!in->command.run) {
        enter(m, APP_MODE_READY);
    }
    return out;
}

static bridge_t precharge(app_modes_t *m, const app_modes_input_t *in)
{
    const abc_t lower_on = {0.0f, 0.0f, 0.0f};

    if (!in->command.run) {
        enter(m, APP_MODE_READY);
        return bridge_open();
    }
    if (!drive_watches(m, in)) {
        return trip(m, in, APP_FAULT_DRIVE);
    }
    if (m->timer_ticks >= m->config->gate.precharge_ticks) {
        enter(m, APP_MODE_RUN);
        return run(m, in);
    }
    m->timer_ticks = (uint16_t)(m->timer_ticks + 1U);
    return bridge_closed(lower_on);
}

static bridge_t align(app_modes_t *m, const app_modes_input_t *in)
{
    if (!in->command.run) {
        enter(m, APP_MODE_READY);
        return bridge_open();
    }
    if (!drive_watches(m, in)) {
        return trip(m, in, APP_FAULT_DRIVE);
    }
    if (m->angle.reference == APP_ANGLE_INDEX) { /* the mark came by: better than alignment */
        enter_run(m);
        return (m->mode == APP_MODE_RUN) ? run(m, in) : bridge_open();
    }
    const bridge_t out = app_align_tick(&m->align, m->sample.ia_A, m->sample.ib_A,
                                        m->sample.dc_link_V, in->raw.position_cnt);
    if (m->align.stage == APP_ALIGN_FAILED) {
        return trip(m, in, APP_FAULT_ALIGN);
    }
    if (m->align.stage == APP_ALIGN_DONE) {
        app_angle_align(&m->angle, in->raw.position_cnt);
        enter(m, APP_MODE_RUN);
    }
    return out;
}

static void leave_fault(app_modes_t *m)
{
    m->fault = APP_FAULT_NONE;
    drive_reset(&m->drive);
    enter(m, m->calibrated ? APP_MODE_READY : APP_MODE_BOOT);
}

static bridge_t act(app_modes_t *m, const app_modes_input_t *in)
{
    switch (m->mode) {
    case APP_MODE_BOOT:
        return boot(m);
    case APP_MODE_CALIBRATE:
        return calibrate(m, in);
    case APP_MODE_READY:
        return ready(m, in);
    case APP_MODE_ALIGN:
        return align(m, in);
    case APP_MODE_PRECHARGE:
        return precharge(m, in);
    case APP_MODE_RUN:
        return run(m, in);
    case APP_MODE_FAULT:
    default:
        break;
    }
    if (in->command.reset && !in->command.run && (m->fault != APP_FAULT_CONFIG)) {
        leave_fault(m);
    }
    return bridge_open();
}

bridge_t app_modes_tick(app_modes_t *m, const app_modes_input_t *in)
{
    if (m->fault == APP_FAULT_CONFIG) {
        return bridge_open();
    }
    m->ticks++;
    measure(m, &in->raw);

    const app_fault_t fault = (m->mode == APP_MODE_FAULT) ? APP_FAULT_NONE : watch(m, in);
    const bridge_t    out   = (fault == APP_FAULT_NONE) ? act(m, in) : trip(m, in, fault);
    m->gate_on              = out.gate_enable;
    return out;
}
