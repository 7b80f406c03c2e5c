/* SPDX-License-Identifier: MIT */
#include "app_states.h"

#include <stddef.h>

/* Chosen: 20 ms, several times the decay of a motor's current; the mean covers as many ticks. */
#define ZERO_TICKS   100U
#define ZERO_FORGETS 0.03f

static bridge_t boot(app_modes_t *m)
{
    m->timer_ticks = (uint16_t)(m->timer_ticks + 1U);
    if (m->timer_ticks >= m->config->boot_ticks) {
        app_states_enter(m, APP_MODE_CALIBRATE);
    }
    return bridge_open();
}

static bool set_zeros(app_modes_t *m)
{
    const bool phases = app_scale_set_zero(&m->scale, m->sum_a_cnt, m->sum_b_cnt, m->timer_ticks);

#if BOARD_CURRENT_SENSORS == 3
    const app_scale_config_t *c = &m->config->scale;
    const bool                sum =
        app_watch_sum_set_zero(&m->sum, m->timer_ticks, c->current_zero_cnt, c->offset_max_cnt);
    return phases && sum;
#else
    return phases;
#endif
}

static bridge_t calibrate(app_modes_t *m, const app_modes_input_t *in)
{
    m->sum_a_cnt += in->raw->ia_cnt;
    m->sum_b_cnt += in->raw->ib_cnt;
#if BOARD_CURRENT_SENSORS == 3
    app_watch_sum_add(&m->sum, in->raw);
#endif
    m->timer_ticks = (uint16_t)(m->timer_ticks + 1U);
    if (m->timer_ticks < m->config->calibrate_ticks) {
        return bridge_open();
    }
    if (!set_zeros(m)) {
        return app_states_trip(m, in, APP_FAULT_OFFSET);
    }
    m->calibrated = true;
    app_states_enter(m, APP_MODE_READY);
    return bridge_open();
}

static void enter_run(app_modes_t *m)
{
    const bool precharge = !m->gate_on && (m->config->gate.precharge_ticks > 0U);
    app_states_enter(m, precharge ? APP_MODE_PRECHARGE : APP_MODE_RUN);
}

/* Below omega_link no current flows through the open bridge (app_stop.h). */
static bool sees_zeros(const app_modes_t *m)
{
    return m->sample.valid && base_within(m->reading.omega_e_radps, m->stop.link_e_radps);
}

static bool is_zero(const app_modes_t *m, float ia_A, float ib_A)
{
    return base_within(ia_A, m->config->zero_drift_A) && base_within(ib_A, m->config->zero_drift_A);
}

/* True while the current offsets stay in tolerance with an open bridge. The check uses a mean over
 * some tens of ticks. It waits until the currents have decayed. */
static bool zeros_hold(app_modes_t *m)
{
    if (!sees_zeros(m)) {
        m->timer_ticks = 0U;
        return true;
    }
    m->zero_a_A += ZERO_FORGETS * (m->sample.ia_A - m->zero_a_A);
    m->zero_b_A += ZERO_FORGETS * (m->sample.ib_A - m->zero_b_A);
    if (m->timer_ticks < ZERO_TICKS) {
        m->timer_ticks = (uint16_t)(m->timer_ticks + 1U);
        return true;
    }
    return is_zero(m, m->zero_a_A, m->zero_b_A);
}

/* A run takes the measured currents as its first state. A sensor that moved in this tick, which the
 * mean does not show yet, delays it. */
static bool reads_zero(const app_modes_t *m)
{
    return !sees_zeros(m) || is_zero(m, m->sample.ia_A, m->sample.ib_A);
}

/* True if commissioning starts. It requires a rising request, no run, no start condition and valid
 * limits. */
static bool commissioning_starts(app_modes_t *m, const app_modes_input_t *in)
{
    const app_command_t *c = &in->command;

    if (!c->commission) {
        m->commission_armed = true;
        return false;
    }
    const bool start = m->commission_armed && !c->run && !app_modes_in_the_way(m) &&
                       app_commission_allows(&m->commission, &c->bounds);
    m->commission_armed = false;
    return start;
}

static bool alignment_starts(app_modes_t *m, const app_modes_input_t *in)
{
    const app_command_t *c = &in->command;

    if (!c->align) {
        m->align_armed = true;
        return false;
    }
    const bool start = m->align_armed && !c->run && !app_modes_in_the_way(m);
    m->align_armed   = false;
    return start;
}

static void enter_align(app_modes_t *m, const app_modes_input_t *in)
{
    app_align_start(&m->align, in->raw->position_cnt);
    app_states_enter(m, APP_MODE_ALIGN);
}

/* The bridge stays open in this tick. The next tick checks everything again in the new mode. */
static bridge_t ready(app_modes_t *m, const app_modes_input_t *in)
{
    m->tripped = (in->board_faults & (uint16_t)BOARD_FAULT_INPUT) != 0U;
    if (!zeros_hold(m)) {
        m->calibrated = false; /* a reset measures the offsets again */
        return app_states_trip(m, in, APP_FAULT_OFFSET);
    }
    if (commissioning_starts(m, in)) {
        app_commission_start(&m->commission, &in->command.bounds, in->raw->position_cnt);
        app_states_enter(m, APP_MODE_COMMISSION);
        return bridge_open();
    }
    if (alignment_starts(m, in)) {
        enter_align(m, in);
        return bridge_open();
    }
    if (!in->command.run || !reads_zero(m)) {
        m->armed = m->armed || !in->command.run;
        return bridge_open();
    }
    const bool start = m->armed && !app_modes_in_the_way(m);
    m->armed         = false; /* a refused start is not repeated later */
    if (start && (m->angle.reference != APP_ANGLE_NONE)) {
        enter_run(m);
    } else if (start) {
        enter_align(m, in);
    } else {
        /* stays in READY */
    }
    return bridge_open();
}

/* Lets the drive, which stays off, check samples and command. False: a limit is exceeded. */
static bool drive_watches(app_modes_t *m, const app_modes_input_t *in)
{
    (void)app_states_drive(m, &in->command, false);
    return m->drive.state != DRIVE_FAULT;
}

static bridge_t precharge(app_modes_t *m, const app_modes_input_t *in)
{
    if (!in->command.run) {
        app_states_enter(m, APP_MODE_READY);
        return bridge_open();
    }
    if (!drive_watches(m, in)) {
        return app_states_trip(m, in, APP_FAULT_DRIVE);
    }
    if (m->timer_ticks >= m->config->gate.precharge_ticks) {
        app_states_enter(m, APP_MODE_RUN);
        return app_states_run(m, in);
    }
    m->timer_ticks = (uint16_t)(m->timer_ticks + 1U);
    return bridge_shorted();
}

/* The angle is found. The bridge stays open until the sensors have read zero, as before any start.
 * Then an alignment without run returns to READY, otherwise run starts. */
static bridge_t aligned(app_modes_t *m, const app_modes_input_t *in)
{
    if (!zeros_hold(m)) {
        m->calibrated = false;
        return app_states_trip(m, in, APP_FAULT_OFFSET);
    }
    if ((m->timer_ticks < ZERO_TICKS) || !reads_zero(m)) {
        /* waits */
    } else if (in->command.run) {
        enter_run(m);
    } else {
        app_states_enter(m, APP_MODE_READY);
    }
    return bridge_open();
}

static bridge_t align(app_modes_t *m, const app_modes_input_t *in)
{
    if (!in->command.run && !in->command.align) {
        app_states_enter(m, APP_MODE_READY);
        return bridge_open();
    }
    if (!drive_watches(m, in)) {
        return app_states_trip(m, in, APP_FAULT_DRIVE);
    }
    if (m->align.stage == APP_ALIGN_DONE) {
        return app_brake_may_be_open(m->brake.state) ? app_states_hold_aligned(m, in)
                                                     : aligned(m, in);
    }
    if (m->angle.reference ==
        APP_ANGLE_INDEX) { /* the index was found while turning: better than alignment */
        m->align.stage = APP_ALIGN_DONE;
        app_position_forget(&m->position);
        return app_brake_may_be_open(m->brake.state) ? bridge_shorted() : bridge_open();
    }
    if (app_brake_may_hold(m->brake.state)) {
        app_align_wait(&m->align);
    }
    const bridge_t out = app_states_align_vector(m, in);
    if (m->align.stage == APP_ALIGN_FAILED) {
        return app_states_trip(m, in, APP_FAULT_ALIGN);
    }
    if (m->align.stage == APP_ALIGN_DONE) {
        app_angle_align(&m->angle, in->raw->position_cnt, m->align.config->theta_e_rad);
        app_position_forget(&m->position);
        return app_brake_may_be_open(m->brake.state) ? out : bridge_open();
    }
    return out;
}

/* A withdrawn command opens the bridge at once. At commissioning speeds the EMF is below the dc
 * link. The motor is shorted until the brake is released. */
static bridge_t commissioning(app_modes_t *m, const app_modes_input_t *in)
{
    const bool goes_on = in->command.commission && !in->command.run;
    const bool waits   = goes_on && (m->commission.module.stage > COMMISSION_WATCH) &&
                       app_brake_may_hold(m->brake.state);
    const bridge_t out = waits ? bridge_shorted()
                               : app_commission_tick(&m->commission, &m->sample, in->raw, goes_on);

    if (!goes_on || (m->commission.module.stage == COMMISSION_FINISHED)) {
        app_angle_drop(&m->angle);
        app_states_enter(m, APP_MODE_READY);
        return bridge_open();
    }
    if (m->commission.module.stage == COMMISSION_ABORTED) {
        return app_states_trip(m, in, APP_FAULT_COMMISSION);
    }
    return out;
}

static void leave_fault(app_modes_t *m)
{
    m->fault        = APP_FAULT_NONE;
    m->stop.shorted = false;
    drive_reset(&m->drive);
    app_states_enter(m, m->calibrated ? APP_MODE_READY : APP_MODE_BOOT);
}

/* If the speed of a shorted motor is unknown, only the operator's reset opens the bridge. */
static bridge_t in_fault(app_modes_t *m, const app_modes_input_t *in)
{
    const bridge_t out = app_states_fault(m, in);

    if (in->command.reset && !in->command.run && !(m->stop.shorted && app_states_know_speed(m))) {
        leave_fault(m);
        return bridge_open();
    }
    return out;
}

bridge_t app_states_rest(app_modes_t *m, const app_modes_input_t *in)
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
    case APP_MODE_COMMISSION:
        return commissioning(m, in);
    case APP_MODE_RUN:
    case APP_MODE_STOP:
    case APP_MODE_FAULT:
    default:
        break;
    }
    return in_fault(m, in);
}
