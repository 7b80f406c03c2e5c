/* SPDX-License-Identifier: MIT */
/* One period of the application, for the analyser (docs/assurance.md). The sample, the command and every number of the state
 * are any bits. The constants of the board are its own, those of the drive any finite numbers. The law answers anything. */
#include "any_law.h"
#include "app_control.h"
#include "app_modes.h"
#include "board_config.h"

volatile app_modes_t    any_modes;
volatile board_sample_t any_raw;
volatile app_command_t  any_command;
volatile app_objects_t  any_objects;
drive_config_t          config;
app_modes_t             modes;
board_sample_t          raw;
volatile app_path_t     any_path;
app_path_t              path;

/* Most counts that app_angle.c turns without an index. */
#define TURN_cnt ((int)board_config.board.positions + (int)board_config.angle.index_correct_max_cnt)

static void any_sample(void)
{
    raw            = any_raw;
    raw.index_seen = any_bool();
    raw.edge_seen  = any_bool();
    raw.valid      = any_bool();
}

/* With positions in their range, which the drive checks. */
static void let_be_any(app_path_t *p)
{
    *p                    = any_path;
    p->aim.fresh          = any_bool();
    p->aim.point.given    = any_bool();
    p->begun              = any_bool();
    p->due                = any_bool();
    p->leads              = any_bool();
    p->lost               = any_bool();
    p->deviates           = any_bool();
    p->track.taken        = (uint16_t)any_between(0, (int)APP_TRACK_KNOWN);
    p->track.at.turns     = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
    p->from.turns         = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
    p->aim.point.at.turns = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
}

/* Its ranges hold again. The aim is the operator's. */
static void is_path(const app_path_t *p)
{
    //@ check taken: p->track.taken <= APP_TRACK_KNOWN;
    //@ check track: -POSITION_TURNS_MAX <= p->track.at.turns <= POSITION_TURNS_MAX;
    //@ check from: -POSITION_TURNS_MAX <= p->from.turns <= POSITION_TURNS_MAX;
}

static void any_state(void)
{
    config.law            = &any_law;
    config.constants      = &config; /* the law reads none */
    config.overmodulation = any_bool();

    modes                            = any_modes;
    modes.config                     = &board_config;
    modes.mode                       = any_between(APP_MODE_BOOT, APP_MODE_STOP);
    modes.fault                      = any_between(APP_FAULT_NONE, APP_FAULT_FOLLOWING);
    modes.calibrated                 = any_bool();
    modes.armed                      = any_bool();
    modes.commission_armed           = any_bool();
    modes.align_armed                = any_bool();
    modes.hot                        = any_bool();
    modes.dc_link_out                = any_bool();
    modes.tripped                    = any_bool();
    modes.locked                     = any_bool();
    modes.gate_on                    = any_bool();
    modes.sink_fault                 = any_between(APP_FAULT_NONE, APP_FAULT_FOLLOWING);
    modes.too_hot                    = any_bool();
    modes.angle.have_turned          = any_bool();
    modes.angle.have_index           = any_bool();
    config.positions                 = any_bool();
    config.torques                   = any_bool();
    modes.drive.config               = &config;
    modes.drive.config_again         = &config;
    modes.drive.law_again            = config.law;
    modes.drive.constants_again      = config.constants;
    modes.drive.answer.predicted     = any_bool();
    modes.drive.current_watch.models = any_bool();
    modes.drive.motion_watch.look    = (motion_watch_look_t)any_between(0, 3);
    modes.drive.answer.arrived       = any_bool();
    modes.drive.answer.waits         = any_bool();
    modes.to_position.moves          = any_bool();
    modes.position.have              = any_bool();
    modes.position.known             = any_bool();
    modes.position.actual.turns      = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
    modes.position.pole_pairs        = (uint16_t)any_between(1, 64);
    modes.position.positions         = board_config.board.positions;
    modes.angle.pole_pairs           = modes.position.pole_pairs;
    modes.angle.turns_per_half_cnt   = 0.5f / (float)board_config.board.positions;
    modes.angle.half_cnt_per_turn    = 2.0f * (float)board_config.board.positions;
    modes.drive.state                = any_between(DRIVE_OFF, DRIVE_FAULT);
    modes.drive.fault                = any_between(DRIVE_FAULT_NONE, DRIVE_FAULT_MEMORY);
    modes.drive.v_limited            = any_bool();
    modes.drive.answer.plausible     = any_bool();
    modes.drive.answer.without_angle = any_bool();
    modes.drive.current_gate.jumped  = any_bool();
    modes.scale.config               = &board_config.scale;
    modes.scale.positions    = board_config.board.positions; /* by their inits, as the other two */
    modes.angle.positions    = board_config.board.positions;
    modes.align.positions    = board_config.board.positions;
    modes.scale.inv_ntc_step = 1.0f / (float)board_config.scale.ntc_step_cnt; /* by its init */
    modes.angle.config       = &board_config.angle;
    modes.angle.edge_times   = any_bool();
    modes.angle.have_before  = any_bool();
    modes.angle.have_edge    = any_bool();
    modes.angle.since_index_cnt    = any_between(-TURN_cnt, TURN_cnt);
    modes.angle.reference          = any_between(APP_ANGLE_NONE, APP_ANGLE_INDEX);
    modes.align.config             = &board_config.align;
    modes.align.stage              = any_between(APP_ALIGN_WATCH, APP_ALIGN_FAILED);
    modes.stop.config              = &board_config.stop;
    modes.stop.shorted             = any_bool();
    modes.sample.valid             = any_bool();
    modes.sample.temperature_valid = any_bool();
    modes.reading.speed_valid      = any_bool();
    modes.reading.index_fault      = any_bool();
    modes.sum.on                   = any_bool();
    modes.sum_differs              = any_bool();
    modes.chopper.present          = any_bool();
    modes.chopper.on               = any_bool();
    modes.chopper.hot              = any_bool();
    modes.chopper.stuck            = any_bool();
    modes.brake.state              = any_between(APP_BRAKE_NONE, APP_BRAKE_CLOSING);
}

static void is_count(uint16_t cnt)
{
    //@ check full: cnt <= board_config.board.duty_full_cnt;
}

/* Entry: a tick of the application in any state. */
void prove_app_tick(void)
{
    any_sample();
    any_state();
    app_modes_input_t in = {.raw = &raw, .board_faults = (uint16_t)any_int, .command = any_command};
    in.background_lost   = any_bool();
    in.tick_missing      = any_bool();
    in.memory_changed    = any_bool();
    in.slow              = (uint16_t)any_int;
    in.command.run       = any_bool();
    in.command.reset     = any_bool();
    in.command.align     = any_bool();
    in.command.follows   = any_between(APP_FOLLOWS_SPEED, APP_FOLLOWS_PATH);
    in.command.path      = &path;
    let_be_any(&path);
    in.command.target.turns = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
    in.command.commission   = false; /* not proved: its own bounds and tests */

    const app_objects_t objects = any_objects;

    app_modes_brake(&modes, &objects, any_bool(), config.ts_s);
    //@ check brake: APP_BRAKE_NONE <= modes.brake.state <= APP_BRAKE_CLOSING;
    const bridge_t     out = app_modes_tick(&modes, &in);
    const board_duty_t duty =
        app_gate_duty(&board_config.gate, board_config.board.duty_full_cnt, out.duty);

    is_count(duty.a_cnt);
    is_count(duty.b_cnt);
    is_count(duty.c_cnt);
    is_path(&path);
    //@ check mode: APP_MODE_BOOT <= modes.mode <= APP_MODE_STOP;
    //@ check fault: APP_FAULT_NONE <= modes.fault <= APP_FAULT_FOLLOWING;
    //@ check stage: APP_ALIGN_WATCH <= modes.align.stage <= APP_ALIGN_FAILED;
    //@ check since_index: -12500 <= modes.angle.since_index_cnt <= 12500;
    //@ check reference: APP_ANGLE_NONE <= modes.angle.reference <= APP_ANGLE_INDEX;
}

volatile app_control_t      any_control;
volatile app_control_seen_t any_seen;
volatile app_position_t     any_position;
volatile app_angle_t        any_angle;

static void tick_control(app_mode_t mode, app_control_state_t state)
{
    app_control_t      control      = any_control;
    app_control_seen_t seen         = any_seen;
    app_objects_t      wanted       = any_objects;
    control.config                  = &board_config;
    control.state                   = state;
    control.armed                   = any_bool();
    control.reset_high              = any_bool();
    control.asked                   = any_bool();
    control.moved                   = any_bool();
    control.done                    = any_bool();
    control.holds                   = any_bool();
    control.setpoint.waits          = any_bool();
    control.setpoint.acknowledged   = any_bool();
    control.setpoint.new_high       = any_bool();
    control.setpoint.now.target_cnt = any_long_between(-APP_POSITION_CNT_MAX, APP_POSITION_CNT_MAX);
    control.setpoint.next.target_cnt =
        any_long_between(-APP_POSITION_CNT_MAX, APP_POSITION_CNT_MAX);
    control.velocity          = any_bool();
    control.limited           = any_bool();
    control.blocked           = any_bool();
    control.braked            = any_bool();
    control.homing.stage      = any_between(APP_HOMING_IDLE, APP_HOMING_FAILED);
    control.homing.start_high = any_bool();
    control.homing.reversed   = any_bool();
    control.homing.fresh      = any_bool();
    control.homing.known      = any_bool();
    control.homing.looked     = any_bool();
    control.homing.zero.turns = any_long_between(-APP_POSITION_ZERO_TURNS, APP_POSITION_ZERO_TURNS);
    control.setpoint.now.limited  = any_bool();
    control.setpoint.next.limited = any_bool();
    wanted.limits                 = any_bool();
    wanted.reversed               = any_bool();
    let_be_any(&control.path);
    seen.mode       = mode;
    seen.shorted    = any_bool();
    seen.in_the_way = any_bool();
    seen.arrived    = any_bool();

    app_position_t position = any_position;
    position.known          = any_bool();
    position.have           = any_bool();
    position.actual.turns   = any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
    position.homed          = any_bool();
    position.zero.turns     = any_long_between(-APP_POSITION_ZERO_TURNS, APP_POSITION_ZERO_TURNS);
    position.pole_pairs     = (uint16_t)any_between(1, 64);
    position.positions      = board_config.board.positions;
    seen.position           = &position;

    app_angle_t angle = any_angle;
    angle.positions   = board_config.board.positions;
    angle.reference   = any_between(APP_ANGLE_NONE, APP_ANGLE_INDEX);
    angle.zero_cnt    = (uint16_t)any_between(0, (int)angle.positions - 1);
    angle.before_cnt  = (uint16_t)any_between(0, (int)angle.positions - 1);
    seen.angle        = &angle;

    app_command_t out;

    app_control_decide(&control, &wanted, &seen, &out);

    //@ check state: APP_CONTROL_NOT_READY <= control.state < APP_CONTROL_STATES;
    if (mode == APP_MODE_FAULT) {
        //@ check fault: out.run == 0 && out.commission == 0 && out.align == 0;
    }
    if ((control.state != APP_CONTROL_OPERATION_ENABLED) &&
        (control.state != APP_CONTROL_QUICK_STOP_ACTIVE)) {
        //@ check off: out.run == 0 && out.commission == 0 && out.align == 0;
    }
    app_control_aim(&control, &wanted, &seen, &out); /* neither changes what was decided */
    app_control_follow(&control, &out);
    //@ check aim: -POSITION_TURNS_MAX <= control.path.aim.point.at.turns <= POSITION_TURNS_MAX;
    is_path(&control.path);
    //@ check homing: APP_HOMING_IDLE <= control.homing.stage <= APP_HOMING_FAILED;
    //@ check zero: -APP_POSITION_ZERO_TURNS <= control.homing.zero.turns <= APP_POSITION_ZERO_TURNS;
}

/* Entry: a tick of the operator's side in any state, with any objects, whatever the modes do. */
void prove_control(void)
{
    for (int mode = APP_MODE_BOOT; mode <= APP_MODE_COMMISSION; mode++) {
        for (int state = APP_CONTROL_NOT_READY; state <= APP_CONTROL_STATES; state++) {
            tick_control(mode, state);
        }
    }
}
