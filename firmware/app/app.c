/* SPDX-License-Identifier: MIT */
#include "app.h"

#include <stddef.h>

#include "app_believe.h"
#include "app_canopen_process.h"
#include "app_control.h"
#include "app_line.h"
#include "app_modes.h"
#include "app_record.h"
#include "app_scope.h"
#include "app_slow.h"
#include "app_watch_memory.h"
#include "app_watch_tick.h"

/* Reading takes below a twentieth of a period: the second attempt succeeds unless ticks overrun. */
#define STATUS_READS 3U

#define CYCLES_SHOWN_MAX 65535UL

/* Data shared by both sides. Each comment names the writer; app.h describes the protocol. */
static volatile struct {
    uint16_t      background_count; /* background */
    uint32_t      ticks;            /* tick, at its end */
    bool          command_full;     /* background sets, tick clears */
    bool          at_sync;          /* background: the command waits for SYNC */
    bool          tick_missing;     /* the same */
    bool          memory_changed;   /* background; stays */
    app_objects_t command;          /* background, while command_full is false */
    uint16_t      board_faults;     /* tick, as the rest: for the status */
    uint16_t      cycles;
    uint16_t      cycles_worst;
#if APP_BELIEVE
    const drive_config_t *constants; /* background; the tick takes them with the command */
#endif
} shared;

/* Written by the tick only; app_status_read() reads it. */
static struct {
    app_config_t          config;
    app_modes_t           modes;
    app_modes_input_t     in;
    app_control_t         control;
    app_objects_t         requested;
    app_mode_t            decided; /* mode of the last app_control_decide() */
    bool                  taken;   /* a command came after it */
    uint16_t              due;     /* pieces of work, APP_SLOW_ */
    uint16_t              slow_periods;
    uint16_t              slow_left; /* periods until the next turn, less one */
    const drive_config_t *drive;
    const drive_config_t *in_force; /* the drive's constants or the second set; NULL: refused */
    const float          *ntc_degC;
#if APP_DISC_MAP
    const uint16_t *disc;
#endif
    uint16_t background_count;
    uint16_t background_age_ticks;
} tick_side;

/* Scope and record. Their headers name the writer of each member. */
static struct {
    app_scope_t  scope;
    app_record_t record;
} traces;

/* Used by the background only, as app_line. */
static struct {
    app_status_t       read; /* may mix two ticks while it is read */
    app_watch_tick_t   watch;
    app_watch_memory_t memory;
    uint32_t           served_ticks;
#if APP_BELIEVE
    app_believe_t believe; /* the tick reads it while it is in force */
#endif
} background_side;

static ctl_status_t init_tick_side(const app_config_t *config, const drive_config_t *drive)
{
    const app_command_t none = {.omega_e_radps = 0.0f, .run = false, .reset = false};

    tick_side.in.command           = none;
    tick_side.requested            = app_control_default(drive);
    tick_side.decided              = APP_MODE_BOOT;
    tick_side.taken                = false;
    tick_side.due                  = (uint16_t)APP_SLOW_TURN;
    tick_side.slow_periods         = app_slow_periods(drive->ts_s);
    tick_side.slow_left            = (uint16_t)(tick_side.slow_periods - 1U);
    tick_side.background_count     = 0U;
    tick_side.background_age_ticks = 0U;
    app_config_for(&tick_side.config, config, drive->hardware.updates_per_period);
    tick_side.drive    = drive;
    tick_side.ntc_degC = tick_side.config.scale.ntc_degC;
#if APP_DISC_MAP
    tick_side.disc = NULL;
#endif
    const ctl_status_t control = app_control_init(&tick_side.control, &tick_side.config, drive);
    const ctl_status_t modes   = app_modes_init(&tick_side.modes, &tick_side.config, drive);

    tick_side.in_force = tick_side.modes.drive.config;
    return (control == CTL_OK) ? modes : control;
}

/* Registers the constants that the tick reads and nothing writes. */
static void watch_memory(app_watch_memory_t *w, const drive_config_t *drive, bool drive_ok)
{
    app_watch_memory_reset(w);
    if (!drive_ok) {
        return; /* the drive will not run */
    }
    app_watch_memory_add(w, drive, (uint32_t)sizeof *drive);
    app_watch_memory_add(w, drive->constants, drive->law->constants_chars);
    app_watch_memory_add(w, &tick_side.config, (uint32_t)sizeof tick_side.config);
    app_watch_memory_add(w, tick_side.config.scale.ntc_degC,
                         (uint32_t)(tick_side.config.scale.ntc_points * sizeof(float)));
#if APP_BELIEVE
    app_watch_memory_add(w, &background_side.believe, (uint32_t)sizeof background_side.believe);
#endif
}

static void read_once(app_status_t *status)
{
    app_modes_status(&tick_side.modes, shared.board_faults, status);
    status->state             = tick_side.control.state;
    status->mode_of_operation = tick_side.control.mode;
    status->done              = tick_side.control.done;
    status->demand_e_radps    = tick_side.control.ref_e_radps;
    status->target_cnt        = tick_side.control.setpoint.now.target_cnt;
    status->acknowledged      = tick_side.control.holds && tick_side.control.setpoint.acknowledged;
    status->beyond            = tick_side.control.path.beyond_s > 0.0f;
    status->unled             = tick_side.control.path.lost;
    status->held              = tick_side.control.limited ||
                   (tick_side.control.holds && tick_side.control.setpoint.now.limited);
    status->homing            = tick_side.control.homing.stage;
    status->inputs            = app_control_active(&tick_side.requested, board_inputs());
    status->reset_cause       = board_reset_cause();
    status->tick_cycles       = shared.cycles;
    status->tick_cycles_worst = shared.cycles_worst;
}

/* Reads in place: copies would take a third of the stack. */
static void read_status(void)
{
    for (uint16_t reads = 0U; reads < STATUS_READS; reads++) {
        const uint32_t before = shared.ticks;
        read_once(&background_side.read);
        if (before == shared.ticks) {
            app_line.registers.status = background_side.read;
            break;
        }
    }
}

ctl_status_t app_init(const app_config_t *config, const drive_config_t *drive)
{
    const ctl_status_t modes = init_tick_side(config, drive);
    const ctl_status_t modbus =
        app_modbus_init(&app_line.modbus, tick_side.config.modbus_gap_ticks);
    const ctl_status_t registers =
        app_registers_init(&app_line.registers, &tick_side.config, drive);

    app_canopen_init(&app_line.canopen, drive->ts_s);
    app_scope_init(&traces.scope);
    app_record_init(&traces.record);
    app_line.registers.scope     = &traces.scope;
    app_line.registers.record    = &traces.record;
    app_line.registers.map       = &tick_side.modes.commission.module.map;
    app_line.loader.restart      = false;
    background_side.served_ticks = 0UL;
    app_watch_tick_reset(&background_side.watch);
#if APP_BELIEVE
    app_believe_init(&background_side.believe, drive);
    shared.constants = drive;
#endif
    watch_memory(&background_side.memory, drive, modes == CTL_OK);

    shared.background_count = 0U;
    shared.ticks            = 0UL;
    shared.command_full     = false;
    shared.at_sync          = false;
    shared.tick_missing     = false;
    shared.memory_changed   = false;
    shared.command          = tick_side.requested;
    shared.board_faults     = 0U;
    shared.cycles           = 0U;
    shared.cycles_worst     = 0U;
    read_status();
    return ((modes == CTL_OK) && (modbus == CTL_OK) && (registers == CTL_OK)) ? CTL_OK
                                                                              : CTL_BAD_CONFIG;
}

/* The modes as the operator's side sees them. */
static app_control_seen_t seen_now(void)
{
    const app_modes_t *const m    = &tick_side.modes;
    const bool               runs = m->drive.state == DRIVE_RUN;
    const app_control_seen_t seen = {
        .mode          = m->mode,
        .shorted       = m->stop.shorted,
        .in_the_way    = (m->mode != APP_MODE_READY) || app_modes_in_the_way(m),
        .speed_e_radps = runs ? m->drive.answer.now.omega_e_radps : m->reading.omega_e_radps,
        .arrived       = runs && m->drive.answer.arrived,
        .position      = &m->position,
        .angle         = &m->angle,
        .inputs        = (tick_side.requested.inputs_used != 0U) ? board_inputs() : 0U,
        .ticks         = m->ticks};
    return seen;
}

#if APP_BELIEVE
static void take_constants(void)
{
    drive_t *const              d    = &tick_side.modes.drive;
    const drive_config_t *const next = shared.constants;

    if ((next != tick_side.in_force) &&
        ((next == tick_side.drive) || (next == &background_side.believe.drive))) {
        drive_adopt(d, next);
        if (d->config == next) {
            tick_side.in_force = next;
        }
    }
}
#endif

static void take_command(void)
{
#if APP_BELIEVE
    take_constants();
#endif
    tick_side.requested = shared.command;
    tick_side.taken     = true;
    shared.command_full = false;
}

static bool command_is_due(void)
{
    return shared.command_full && (!shared.at_sync || board_can_triggered());
}

static void decide(app_mode_t mode)
{
    const app_control_seen_t seen = seen_now();

    app_control_decide(&tick_side.control, &tick_side.requested, &seen, &tick_side.in.command);
    tick_side.taken   = false;
    tick_side.decided = mode;
    tick_side.due     = (uint16_t)(tick_side.due | (uint16_t)APP_SLOW_AIM);
}

static void aim(void)
{
    const app_control_seen_t seen = seen_now();

    app_control_aim(&tick_side.control, &tick_side.requested, &seen, &tick_side.in.command);
    if (tick_side.control.homing.fresh) {
        app_position_set_zero(&tick_side.modes.position, &tick_side.control.homing.zero);
        tick_side.control.homing.fresh = false;
    }
}

/* One piece of the work of app_slow.h. */
static void work_slowly(app_mode_t mode)
{
    uint16_t piece = 0U;

    if ((tick_side.due & (uint16_t)APP_SLOW_AIM) != 0U) {
        piece = (uint16_t)APP_SLOW_AIM; /* what was decided acts before anything else is */
    } else if (tick_side.taken || (mode != tick_side.decided)) {
        piece = (uint16_t)APP_SLOW_DECIDE;
    } else if (command_is_due()) {
        take_command();
    } else {
        piece = (uint16_t)(tick_side.due & (0U - tick_side.due));
    }
    tick_side.due     = (uint16_t)(tick_side.due & ~(uint32_t)piece);
    tick_side.in.slow = piece;
    if (piece == (uint16_t)APP_SLOW_DECIDE) {
        decide(mode);
    } else if (piece == (uint16_t)APP_SLOW_AIM) {
        aim();
    } else {
        /* app_modes does it */
    }
    app_control_follow(&tick_side.control, &tick_side.in.command);
}

/* Without the law a period has time for all at once. */
static void work_at_rest(app_mode_t mode)
{
    if (command_is_due()) {
        take_command();
    }
    tick_side.in.slow = tick_side.due;
    decide(mode);
    aim();
    tick_side.due = 0U;
    app_control_follow(&tick_side.control, &tick_side.in.command);
}

static void drive_brake(bool turn)
{
    app_modes_brake(&tick_side.modes, &tick_side.requested, turn, tick_side.drive->ts_s);
    const app_brake_state_t state = tick_side.modes.brake.state;

    tick_side.control.braked = app_brake_may_hold(state);
    board_brake_write(app_brake_output(state));
}

static void work(void)
{
    const app_mode_t mode = tick_side.modes.mode;
    const uint16_t   left = tick_side.slow_left;
    const bool       turn = left == 0U;

    if (!turn) {
        tick_side.slow_left = (uint16_t)(left - 1U);
    } else {
        tick_side.slow_left = (uint16_t)(tick_side.slow_periods - 1U);
        tick_side.due       = (uint16_t)(tick_side.due | (uint16_t)APP_SLOW_TURN);
    }
    if ((mode == APP_MODE_RUN) || (mode == APP_MODE_STOP)) {
        work_slowly(mode);
        if (turn && (tick_side.modes.brake.state != APP_BRAKE_NONE)) {
            drive_brake(true);
        }
    } else {
        work_at_rest(mode);
        drive_brake(turn);
    }
}

static bool background_lost(void)
{
    const uint16_t count = shared.background_count;
    bool           lost  = false;

    if (count != tick_side.background_count) {
        tick_side.background_count     = count;
        tick_side.background_age_ticks = 0U;
    } else if (tick_side.background_age_ticks < tick_side.modes.config->background_ticks) {
        tick_side.background_age_ticks = (uint16_t)(tick_side.background_age_ticks + 1U);
    } else {
        lost = true;
    }
    return lost;
}

/* Opens the bridge first, or enables it last. */
static void drive_bridge(const bridge_t *out, bool was_on)
{
    const board_duty_t duty =
        app_gate_duty(&tick_side.config.gate, tick_side.config.board.duty_full_cnt, out->duty);

    if (!out->gate_enable) {
        board_gate_trip();
    }
    board_duty_write(&duty);
    if (out->gate_enable && !was_on) {
        board_gate_enable();
    }
}

#if BOARD_CHOPPER
/* A resistor that stays off needs no command. */
static void drive_chopper(const board_sample_t *raw)
{
    app_chopper_t *const c      = &tick_side.modes.chopper;
    const bool           was_on = c->on;

    if (app_chopper_tick(c, raw) || was_on) {
        board_chopper_write(c->on);
    }
}
#endif

/* Ends a tick. The new count tells the background that values it read before are old. */
static void finish(uint16_t board_faults, uint32_t start_cycles)
{
    const uint32_t cycles = (uint32_t)(board_cycles() - start_cycles);
    const uint16_t shown  = (uint16_t)((cycles < CYCLES_SHOWN_MAX) ? cycles : CYCLES_SHOWN_MAX);

    shared.board_faults = board_faults;
    shared.cycles       = shown;
    if (shown > shared.cycles_worst) {
        shared.cycles_worst = shown;
    }
    shared.ticks = shared.ticks + 1UL;
}

/* True if the pointers that the tick follows are intact: to constants of this file and of the
 * drive. */
static bool pointers_hold(void)
{
    const app_config_t *const c = &tick_side.config;
    const app_modes_t *const  m = &tick_side.modes;

#if APP_DISC_MAP
    const bool disc = m->angle.disc.octets == tick_side.disc;
#else
    const bool disc = true;
#endif
    return disc && (m->config == c) && (m->scale.config == &c->scale) &&
           (m->angle.config == &c->angle) && (m->align.config == &c->align) &&
           (m->stop.config == &c->stop) && (tick_side.control.config == c) &&
           (m->drive.config == tick_side.in_force) && (c->scale.ntc_degC == tick_side.ntc_degC);
}

/* Ends a tick with damaged pointers: opens the bridge without further reads. The background
 * reports. */
static void give_up(uint32_t start_cycles)
{
    board_gate_trip();
    tick_side.modes.mode  = APP_MODE_FAULT;
    tick_side.modes.fault = APP_FAULT_MEMORY;
    finish(shared.board_faults, start_cycles);
}

void app_tick(void)
{
    const uint32_t           start_cycles = board_cycles();
    app_modes_input_t *const in           = &tick_side.in;

    if (!pointers_hold()) {
        give_up(start_cycles);
        return;
    }
    work();
    in->raw             = board_sample();
    in->board_faults    = board_fault_read();
    in->background_lost = background_lost();
    in->memory_changed  = shared.memory_changed;
    in->tick_missing    = shared.tick_missing;
    shared.tick_missing = false;
#if BOARD_CHOPPER
    drive_chopper(in->raw);
#endif
    const bool     was_on = tick_side.modes.gate_on;
    const bridge_t out    = app_modes_tick(&tick_side.modes, in);
    drive_bridge(&out, was_on);
    const app_scope_view_t view = {.modes = &tick_side.modes, .command = &in->command, .out = &out};
    app_record_tick(&traces.record, &view);
    app_scope_tick(&traces.scope, &view);
    finish(in->board_faults, start_cycles);
}

/* Writes the command that the tick takes in the period after SYNC. */
static void write_at_sync(const app_objects_t *command)
{
    board_can_arm();
    shared.command      = *command;
    shared.at_sync      = true;
    shared.command_full = true;
}

/* True while such a command stays: SYNC has not come yet, or the registers do not know of it. Once
 * they do, it is a command like others. Any other change withdraws the command. If the tick has
 * taken it by then, the registers are told. */
static bool keeps_for_sync(app_registers_t *r)
{
    const bool came  = board_can_triggered();
    const bool holds = app_canopen_process_is_prepared(&app_line.canopen);
    const bool full  = shared.command_full;
    bool       stays = shared.at_sync;

    if (stays && app_line.canopen.acted) {
        app_line.canopen.acted = false;
        shared.at_sync         = false;
        stays                  = false;
    } else if (stays && !(holds && (came || (full && !r->changed)))) {
        shared.command_full = false;
        stays               = !came && board_can_triggered(); /* in between */
        shared.at_sync      = stays;
        r->changed          = r->changed || !full;
        if (!stays) {
            app_line.canopen.waiting = APP_CANOPEN_SYNC_NEW;
        }
    } else {
        /* it stays, or there is none */
    }
    return stays;
}

static void pass_command(app_registers_t *r)
{
    app_objects_t command;

    if (r->changed) {
        app_registers_command(&r->requested, &command);
        r->changed = !app_command_write(&command);
    } else if (!shared.command_full && app_canopen_process_prepare(&app_line.canopen, r)) {
        app_registers_command(&r->trial, &command);
        write_at_sync(&command);
    } else {
        /* nothing new */
    }
}

/* Restarts for the loader or to store parameters, after the Modbus answer is sent. If the bridge is
 * on by then, the restart is cancelled. */
static void restart_when_asked(uint32_t now_ticks)
{
    app_loader_t    *l    = &app_line.loader;
    app_registers_t *r    = &app_line.registers;
    const bool       on   = r->status.gate_enable;
    const bool       idle = app_modbus_is_quiet(&app_line.modbus, now_ticks) &&
                      app_canopen_is_quiet(&app_line.canopen, now_ticks);
    const bool store = !on && (r->requested.store_command != (uint16_t)APP_PARAMETERS_NO_COMMAND);

    l->restart = l->restart && !on;
    if (store && idle) {
        app_parameters_ask(r, (app_parameters_command_t)r->requested.store_command);
    }
    if ((store || l->restart) && idle) {
        board_restart(store || l->enter);
    }
    if (app_line.canopen.restart && !on) {
        board_restart(false);
    }
    if (on) {
        r->requested.store_command = (uint16_t)APP_PARAMETERS_NO_COMMAND;
    }
}

static void serve_watchdog(uint32_t now_ticks)
{
    if (now_ticks != background_side.served_ticks) {
        background_side.served_ticks = now_ticks;
        board_watchdog_serve();
    }
}

#if APP_BELIEVE
static float believed(void)
{
    const bool own = tick_side.in_force != &background_side.believe.drive;

    return own ? 1.0f : background_side.believe.ratio;
}

/* The next command takes its constants along, so that one for a position finds the drive's own. */
static void choose_constants(app_registers_t *r)
{
    app_believe_t              *b        = &background_side.believe;
    const drive_config_t *const in_force = tick_side.in_force;
    bool                        made     = false;

    if (shared.command_full || (in_force == NULL)) {
        return;
    }
    const drive_config_t *const next =
        app_believe_choose(b, tick_side.drive, in_force, app_registers_inertia_wanted(r), &made);
    if (made) {
        app_watch_memory_renew(&background_side.memory, b);
    }
    if (next != in_force) {
        shared.constants = next;
        r->changed       = true;
    }
}
#else
static float believed(void)
{
    return 1.0f;
}

static void choose_constants(const app_registers_t *r)
{
    (void)r;
}
#endif

void app_background(void)
{
    app_registers_t *r         = &app_line.registers;
    const uint32_t   now_ticks = shared.ticks;

    if (!app_watch_memory_pass(&background_side.memory) || !board_memory_is_whole()) {
        board_gate_trip();
        shared.memory_changed = true;
    }
    if (app_watch_tick_is_missing(&background_side.watch, tick_side.config.board.pwm_cycles,
                                  now_ticks, board_cycles())) {
        board_gate_trip();
        shared.tick_missing = true;
    }
    shared.background_count = (uint16_t)(shared.background_count + 1U);
    serve_watchdog(now_ticks);

    read_status();
    app_registers_see_inertia(r, believed());
    app_registers_see_path(r);
    app_registers_see_ring(r);
    app_registers_see_trim(r, &tick_side.modes.scale);
    app_parameters_rest(&app_line.parameters, (float)now_ticks * tick_side.drive->ts_s);
    app_modbus_poll(&app_line.modbus, r, now_ticks);
    app_canopen_poll(&app_line.canopen, r, now_ticks);
    if (!keeps_for_sync(r)) {
        choose_constants(r);
        pass_command(r);
    }
    restart_when_asked(now_ticks);
}

void app_tell_image(const app_image_t *image)
{
    app_loader_init(&app_line.loader, image);
    app_line.registers.loader = &app_line.loader;
    tick_side.modes.locked    = tick_side.modes.locked || image->fallback;
#if APP_DISC_MAP
    app_disc_take(&tick_side.modes.angle.disc, image->disc);
    tick_side.disc = tick_side.modes.angle.disc.octets;
#endif
    if (image->other_board) {
        tick_side.modes.mode  = APP_MODE_FAULT;
        tick_side.modes.fault = APP_FAULT_CONFIG;
#if BOARD_CHOPPER
        app_chopper_init(&tick_side.modes.chopper, NULL, tick_side.drive->ts_s);
#endif
    }
}

void app_take_parameters(app_parameters_done_t done)
{
    app_registers_t *r = &app_line.registers;

    app_parameters_take(&app_line.parameters, r, done);
    tick_side.modes.locked =
        tick_side.modes.locked || (app_line.parameters.state == APP_PARAMETERS_LOST);
    board_line_set(&r->requested.line);
    app_canopen_start(&app_line.canopen, r);
    app_modbus_follow(&app_line.modbus, &r->requested.line, tick_side.drive->ts_s,
                      tick_side.config.modbus_gap_ticks);
}

bool app_command_write(const app_objects_t *command)
{
    if (shared.command_full) {
        return false;
    }
    shared.command      = *command;
    shared.command_full = true;
    return true;
}

app_status_t app_status_read(void)
{
    read_status();
    return app_line.registers.status;
}

const drive_t *app_drive(void)
{
    return &tick_side.modes.drive;
}
