/* SPDX-License-Identifier: MIT */
#include "app_modes.h"
#include "app_slow.h"
#include "app_states.h"

#include <string.h>

#include "board_config.h"
#include "gain_tables.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

#define BOOT_TICKS      250
#define CALIBRATE_TICKS 1280
#define CODE_80_degC    1763 /* last code that is above the limit */
#define CODE_90_degC    1501 /* last code that is above the trip level */

static app_config_t      config;
static drive_config_t    drive_config;
static app_modes_t       modes;
static board_sample_t    raw;
static app_modes_input_t in;
static bridge_t          out;
static bool              motor_answers; /* currents are what the drive expects; else none */

static void init(void)
{
    const board_sample_t    rest  = {.ia_cnt          = 2048U,
                                     .ib_cnt          = 2048U,
                                     .dc_link_cnt     = 2685U,
                                     .temperature_cnt = 3357U,
                                     .valid           = true};
    const app_modes_input_t quiet = {.raw = &raw, .slow = APP_SLOW_TURN};
    raw                           = rest;
    in                            = quiet;
    (void)memset(&modes, 0xFF, sizeof modes); /* init has to set everything */
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_modes_init(&modes, &config, &drive_config));
}

void setUp(void)
{
    config        = board_config;
    drive_config  = speed_tables_drive;
    motor_answers = false;
    init();
}

void tearDown(void) {}

static void assert_open(void)
{
    TEST_ASSERT_FALSE(out.gate_enable);
    TEST_ASSERT_FALSE(modes.gate_on);
    TEST_ASSERT_TRUE((out.duty.a == 0.5f) && (out.duty.b == 0.5f) && (out.duty.c == 0.5f));
}

static app_status_t status_of(uint16_t board_faults)
{
    app_status_t s;
    (void)memset(&s, 0xFF, sizeof s); /* everything has to be set */
    app_modes_status(&modes, board_faults, &s);
    return s;
}

static void tick(void)
{
    out = app_modes_tick(&modes, &in);
    if ((modes.mode != APP_MODE_RUN) && (modes.mode != APP_MODE_ALIGN) &&
        (modes.mode != APP_MODE_COMMISSION)) {
        assert_open();
    }
}

static void ticks(int count)
{
    for (int n = 0; n < count; n++) {
        tick();
    }
}

static void go_ready(void)
{
    ticks(BOOT_TICKS + CALIBRATE_TICKS + 1);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

static void see_index(void)
{
    raw.index_seen = true;
    tick();
    raw.index_seen = false;
}

static void go_run(void)
{
    go_ready();
    see_index();
    in.command.run = true;
    ticks(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
    tick();
    TEST_ASSERT_TRUE(out.gate_enable);
}

/* Into ALIGN with the bridge closed. */
static void go_align(void)
{
    go_ready();
    in.command.run = true;
    ticks(1 + 500);
    TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
}

static void assert_fault(app_fault_t fault)
{
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
    TEST_ASSERT_EQUAL_INT(fault, modes.fault);
    TEST_ASSERT_EQUAL_INT(fault, modes.snapshot.fault);
    assert_open();
}

/* Healthy samples again: the fault stays until a reset without run. */
static void assert_latched_until_reset(app_fault_t fault, app_mode_t after)
{
    raw.valid           = true;
    raw.ia_cnt          = 2048U;
    raw.temperature_cnt = 3357U;
    in.board_faults     = 0U;
    in.background_lost  = false;
    in.command.run      = true;
    ticks(3);
    assert_fault(fault);
    in.command.reset = true;
    tick();
    assert_fault(fault);
    in.command.reset = false;
    in.command.run   = false;
    ticks(3);
    assert_fault(fault);
    in.command.reset = true;
    tick();
    in.command.reset = false;
    TEST_ASSERT_EQUAL_INT(after, modes.mode);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, modes.fault);
    TEST_ASSERT_EQUAL_INT(fault, modes.snapshot.fault); /* the record stays */
}

static void test_start_boots_calibrates_and_waits_with_the_bridge_open(void)
{
    TEST_ASSERT_EQUAL_INT(APP_MODE_BOOT, modes.mode);
    ticks(BOOT_TICKS - 1);
    TEST_ASSERT_EQUAL_INT(APP_MODE_BOOT, modes.mode);
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_CALIBRATE, modes.mode);
    ticks(CALIBRATE_TICKS - 1);
    TEST_ASSERT_EQUAL_INT(APP_MODE_CALIBRATE, modes.mode);
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    ticks(1000);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

static void test_calibration_takes_the_mean_of_each_phase(void)
{
    ticks(BOOT_TICKS);
    for (int n = 0; n < CALIBRATE_TICKS; n++) {
        raw.ia_cnt = (uint16_t)(2040 + (n % 5)); /* mean 2042 */
        raw.ib_cnt = (uint16_t)(2060 - (n % 2)); /* mean 2059.5 */
        tick();
    }
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    TEST_ASSERT_FLOAT_WITHIN(0.001f, 2042.0f, modes.scale.zero_a_cnt);
    TEST_ASSERT_FLOAT_WITHIN(0.001f, 2059.5f, modes.scale.zero_b_cnt);
}

static void test_zero_beyond_its_bound_faults_and_can_be_tried_again(void)
{
    raw.ib_cnt = 2149U;
    ticks(BOOT_TICKS + CALIBRATE_TICKS);
    assert_fault(APP_FAULT_OFFSET);
    raw.ib_cnt = 2048U;
    assert_latched_until_reset(APP_FAULT_OFFSET, APP_MODE_BOOT);
    go_ready();
}

static void test_run_given_too_early_does_not_start_by_itself(void)
{
    in.command.run = true;
    see_index();
    go_ready();
    ticks(100);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    in.command.run = false;
    tick();
    in.command.run = true;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
}

static void test_gates_are_asked_for_by_the_second_tick_of_a_run(void)
{
    go_ready();
    see_index();
    in.command.run = true;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_FALSE(out.gate_enable);
    tick();
    TEST_ASSERT_TRUE(out.gate_enable);
}

static void test_withdrawn_run_opens_the_bridge_in_the_same_tick(void)
{
    go_run();
    in.command.run = false;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    assert_open();
    init();
    go_align();
    in.command.run = false;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    assert_open();
}

static void test_run_gets_what_the_drive_gives(void)
{
    drive_t              drive;
    const drive_sample_t rest = {.dc_link_V   = 450.0f / 4096.0f * 2685.0f,
                                 .theta_e_rad = (float)(2.0 * 0.5 * 6.283185307179586 / 10000.0),
                                 .valid       = true};
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &drive_config));
    go_ready();
    see_index();
    in.command.run           = true;
    in.command.omega_e_radps = 50.0f;
    tick();
    for (int n = 0; n < 20; n++) {
        const drive_command_t command = {.omega_e_radps = 50.0f, .run = true};
        const bridge_t        want    = drive_tick(&drive, &rest, &command);
        tick();
        TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, want.duty.a, out.duty.a);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, want.duty.b, out.duty.b);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, want.duty.c, out.duty.c);
    }
    TEST_ASSERT_TRUE(out.duty.a != 0.5f);
}

typedef void (*way_t)(void);
static const way_t ways[] = {go_run, go_align};

static void test_invalid_sample_trips_in_the_same_tick_and_costs_the_angle(void)
{
    for (int i = 0; i < SUPPORT_COUNT(ways); i++) {
        init();
        ways[i]();
        raw.valid = false;
        tick();
        assert_fault(APP_FAULT_SAMPLE);
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, modes.angle.reference);
        assert_latched_until_reset(APP_FAULT_SAMPLE, APP_MODE_READY);
    }
    init();
    ticks(BOOT_TICKS + 10);
    raw.ia_cnt = 4096U;
    tick();
    assert_fault(APP_FAULT_SAMPLE);
}

static void test_invalid_sample_in_ready_costs_the_angle_only(void)
{
    go_ready();
    see_index();
    raw.valid = false;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, modes.angle.reference);
}

static void test_every_board_fault_trips_while_the_gates_are_on(void)
{
    static const int faults[] = {BOARD_FAULT_TRIP, BOARD_FAULT_OVERRUN, BOARD_FAULT_CLOCK,
                                 BOARD_FAULT_ENCODER};
    for (int i = 0; i < SUPPORT_COUNT(ways); i++) {
        for (int k = 0; k < SUPPORT_COUNT(faults); k++) {
            init();
            ways[i]();
            in.board_faults = (uint16_t)faults[k];
            tick();
            assert_fault(APP_FAULT_BOARD);
            TEST_ASSERT_EQUAL_UINT(faults[k], modes.snapshot.board_faults);
            TEST_ASSERT_TRUE((modes.angle.reference == APP_ANGLE_NONE) ==
                             ((faults[k] == BOARD_FAULT_ENCODER) || (ways[i] == go_align)));
            assert_latched_until_reset(APP_FAULT_BOARD, APP_MODE_READY);
        }
    }
}

/* Enabling clears them, so a latched one must not keep the drive from starting. */
static void test_board_faults_are_ignored_until_the_gates_were_enabled(void)
{
    in.board_faults = BOARD_FAULT_TRIP;
    go_ready();
    see_index();
    in.command.run = true;
    ticks(2);
    TEST_ASSERT_TRUE(out.gate_enable);
    tick();
    assert_fault(APP_FAULT_BOARD);
}

/* Not ready, instead of a fault that has to be reset; a start that was refused is not made up for. */
static void assert_refused_until(uint16_t *at, uint16_t healthy, uint16_t bad)
{
    *at            = bad;
    in.command.run = false;
    ticks(2);
    in.command.run = true;
    ticks(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    *at = healthy;
    ticks(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    in.command.run = false;
    ticks(2);
    in.command.run = true;
    ticks(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
    in.command.run = false;
    ticks(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

static void test_dc_link_out_of_range_is_not_ready(void)
{
    go_ready();
    see_index();
    TEST_ASSERT_FALSE(modes.dc_link_out);
    /* 88.5 V and 398 V at 0.11 V a code */
    assert_refused_until(&raw.dc_link_cnt, 2685U, 804U);
    assert_refused_until(&raw.dc_link_cnt, 2685U, 3626U);
    assert_refused_until(&raw.dc_link_cnt, 807U, 0U);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, modes.fault);
}

static void test_active_trip_input_is_not_ready(void)
{
    go_ready();
    see_index();
    assert_refused_until(&in.board_faults, 0U, BOARD_FAULT_INPUT);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, modes.fault);
    in.board_faults = BOARD_FAULT_INPUT;
    tick();
    TEST_ASSERT_TRUE(status_of(in.board_faults).tripped);
}

static void test_bootstrap_supplies_are_charged_before_a_run(void)
{
    config.gate.precharge_ticks         = 7U;
    config.gate.precharge_speed_e_radps = 50.0f;
    init();
    go_ready();
    see_index();
    in.command.run = true;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_PRECHARGE, modes.mode);
    for (int n = 0; n < 7; n++) {
        out = app_modes_tick(&modes, &in);
        TEST_ASSERT_EQUAL_INT(APP_MODE_PRECHARGE, modes.mode);
        TEST_ASSERT_TRUE(out.gate_enable);
        TEST_ASSERT_TRUE((out.duty.a == 0.0f) && (out.duty.b == 0.0f) && (out.duty.c == 0.0f));
    }
    out = app_modes_tick(&modes, &in);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable && (out.duty.a > 0.0f));
}

static void test_a_precharge_ends_at_once_when_something_is_wrong(void)
{
    config.gate.precharge_ticks         = 7U;
    config.gate.precharge_speed_e_radps = 50.0f;
    for (int way = 0; way < 3; way++) {
        init();
        go_ready();
        see_index();
        in.command.run = true;
        tick();
        out = app_modes_tick(&modes, &in);
        TEST_ASSERT_TRUE(out.gate_enable);
        if (way == 0) {
            raw.ia_cnt = 4000U; /* the shorted motor's current */
        } else if (way == 1) {
            in.board_faults = BOARD_FAULT_TRIP;
        } else {
            in.command.run = false;
        }
        tick();
        assert_open();
        TEST_ASSERT_EQUAL_INT((way == 2) ? APP_MODE_READY : APP_MODE_FAULT, modes.mode);
    }
}

static void test_no_precharge_at_speed(void)
{
    config.gate.precharge_ticks         = 7U;
    config.gate.precharge_speed_e_radps = 50.0f;
    init();
    go_ready();
    see_index();
    in.command.run   = true;
    raw.position_cnt = (uint16_t)(raw.position_cnt + 10U); /* 63 rad/s */
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

/* The shaft turns at so many counts per period, forward. */
static void turn_ticks(int count, uint16_t step_cnt)
{
    for (int n = 0; n < count; n++) {
        raw.position_cnt = (uint16_t)((raw.position_cnt + step_cnt) % 10000U);
        if (motor_answers) {
            const current_watch_phase_t *const phase   = modes.drive.current_watch.phase;
            const float                        per_cnt = config.scale.current_A_per_cnt;
            raw.ia_cnt = (uint16_t)(2048.0f + (phase[0].model_A / per_cnt));
            raw.ib_cnt = (uint16_t)(2048.0f + (phase[1].model_A / per_cnt));
        }
        out = app_modes_tick(&modes, &in);
    }
}

/* 398 V / (sqrt(3) 0.193 V s) = 1191 rad/s; a count per period is 6.283 rad/s. */
#define FAST_cnt 192U /* 1206 rad/s */
#define SLOW_cnt 150U /* 942 rad/s, below 0.8 of it */

static void run_fast(void)
{
    drive_config                    = gain_tables_drive;
    drive_config.trip_speed_e_radps = 1500.0f;
    init();
    go_ready();
    turn_ticks(3, FAST_cnt);
    raw.index_cnt =
        raw.position_cnt; /* of the sample before: a period late, which is no matter here */
    raw.index_seen = true;
    turn_ticks(1, FAST_cnt);
    raw.index_seen           = false;
    in.command.run           = true;
    in.command.omega_e_radps = 1190.0f;
    turn_ticks(3, FAST_cnt);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
}

static bool is_short(void)
{
    return out.gate_enable && (out.duty.a == 0.0f) && (out.duty.b == 0.0f) && (out.duty.c == 0.0f);
}

static void test_a_fault_at_speed_shorts_the_motor_until_it_is_slow(void)
{
    run_fast();
    raw.temperature_cnt = 0U; /* broken sensor */
    turn_ticks(1, FAST_cnt);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_TEMPERATURE_SENSOR, modes.fault);
    TEST_ASSERT_TRUE(is_short());
    TEST_ASSERT_TRUE(status_of(0U).shorted);
    in.command.run   = false;
    in.command.reset = true;
    turn_ticks(50, FAST_cnt);
    TEST_ASSERT_TRUE(is_short()); /* no reset before it is safe */
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
    in.command.reset = false;
    turn_ticks(2, SLOW_cnt);
    TEST_ASSERT_FALSE(out.gate_enable);
    turn_ticks(2, FAST_cnt); /* and does not come back */
    TEST_ASSERT_FALSE(out.gate_enable);
}

static void test_a_fault_at_low_speed_opens(void)
{
    run_fast();
    turn_ticks(3, SLOW_cnt);
    raw.temperature_cnt = 0U;
    turn_ticks(1, SLOW_cnt);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
    TEST_ASSERT_FALSE(out.gate_enable);
}

static void test_board_faults_and_over_current_open_at_any_speed(void)
{
    for (int way = 0; way < 4; way++) {
        run_fast();
        if (way == 0) {
            in.board_faults = BOARD_FAULT_TRIP;
        } else if (way == 1) {
            raw.ia_cnt = 4000U;
            turn_ticks(1, FAST_cnt); /* one alone is a spike */
            TEST_ASSERT_TRUE(out.gate_enable);
        } else {
            raw.temperature_cnt = 0U;
            turn_ticks(2, FAST_cnt);
            TEST_ASSERT_TRUE(is_short());
            if (way == 2) {
                in.board_faults = BOARD_FAULT_TRIP;
            } else {
                raw.ib_cnt = 200U;
            }
        }
        turn_ticks(1, FAST_cnt);
        TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
        TEST_ASSERT_FALSE(out.gate_enable);
    }
    setUp();
    config.stop.short_circuit = false; /* a dc link that takes all of it */
    run_fast();
    raw.temperature_cnt = 0U;
    turn_ticks(1, FAST_cnt);
    TEST_ASSERT_FALSE(out.gate_enable);
}

/* The speed is unknown: the short stays until the operator ends it. */
static void test_a_lost_encoder_at_speed_leaves_the_motor_shorted(void)
{
    run_fast();
    raw.valid = false;
    turn_ticks(100, 0U);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_SAMPLE, modes.fault);
    TEST_ASSERT_TRUE(is_short());
    in.command.run   = false;
    in.command.reset = true;
    turn_ticks(1, 0U);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    TEST_ASSERT_FALSE(out.gate_enable);
}

/* It stands, so that it reads zero, which is slow; over-current ends the short all the same. */
static void test_a_dead_encoder_does_not_end_the_short(void)
{
    run_fast();
    raw.temperature_cnt              = 0U; /* a fault while the drive brakes without encoder */
    modes.drive.answer.without_angle = true;
    turn_ticks(100, 0U);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
    TEST_ASSERT_TRUE(is_short());
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, modes.angle.reference);
    raw.ia_cnt = 4000U;
    turn_ticks(1, 0U);
    TEST_ASSERT_FALSE(out.gate_enable);
}

static void test_fault_without_angle_is_the_encoder(void)
{
    static const drive_fault_t by_angle[] = {DRIVE_FAULT_OVER_SPEED, DRIVE_FAULT_CURRENT_SENSOR,
                                             DRIVE_FAULT_PHASE,      DRIVE_FAULT_MODEL,
                                             DRIVE_FAULT_STALL,      DRIVE_FAULT_AWAY};
    static const drive_fault_t others[]   = {DRIVE_FAULT_SAMPLE,  DRIVE_FAULT_OVER_CURRENT,
                                             DRIVE_FAULT_DC_LINK, DRIVE_FAULT_COMMAND,
                                             DRIVE_FAULT_NUMERIC, DRIVE_FAULT_MEMORY};

    for (int lost = 0; lost < 2; lost++) {
        for (int i = 0; i < SUPPORT_COUNT(by_angle); i++) {
            modes.drive.answer.without_angle = lost != 0;
            modes.drive.fault                = by_angle[i];
            (void)app_states_trip(&modes, &in, APP_FAULT_DRIVE);
            TEST_ASSERT_EQUAL_INT((lost != 0) ? DRIVE_FAULT_ENCODER : by_angle[i],
                                  modes.drive.fault);
            TEST_ASSERT_EQUAL_INT(modes.drive.fault, modes.snapshot.drive_fault);
        }
        for (int i = 0; i < SUPPORT_COUNT(others); i++) {
            modes.drive.fault = others[i];
            (void)app_states_trip(&modes, &in, APP_FAULT_DRIVE);
            TEST_ASSERT_EQUAL_INT(others[i], modes.drive.fault);
        }
    }
}

static void test_index_of_a_lost_encoder_does_not_end_the_braking(void)
{
    for (int lost = 0; lost < 2; lost++) {
        run_fast();
        raw.index_cnt                    = (uint16_t)((raw.position_cnt + 5000U) % 10000U);
        raw.index_seen                   = true;
        modes.drive.answer.without_angle = lost != 0;
        turn_ticks(1, FAST_cnt);
        TEST_ASSERT_EQUAL_INT((lost != 0) ? APP_FAULT_NONE : APP_FAULT_INDEX, modes.fault);
        raw.index_seen = false;
    }
}

static void test_a_stop_at_speed_brakes_before_it_opens(void)
{
    run_fast();
    motor_answers  = true;
    in.command.run = false;
    turn_ticks(5, FAST_cnt);
    TEST_ASSERT_EQUAL_INT(APP_MODE_STOP, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
    in.command.run = true; /* on again */
    turn_ticks(1, FAST_cnt);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    in.command.run = false;
    turn_ticks(5, FAST_cnt);
    turn_ticks(2, 189U); /* 1187.5 rad/s */
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    TEST_ASSERT_FALSE(out.gate_enable);
}

static void test_a_ramp_brakes_to_standstill(void)
{
    config.stop.reaction = APP_STOP_RAMP;
    init();
    go_run();
    turn_ticks(3, 4U); /* 25 rad/s */
    in.command.run = false;
    turn_ticks(3, 4U);
    TEST_ASSERT_EQUAL_INT(APP_MODE_STOP, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
    turn_ticks(2, 3U); /* 19 rad/s */
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    TEST_ASSERT_FALSE(out.gate_enable);
}

/* Counts lost: the position jumps. The next run aligns anew. */
static void test_a_jump_drops_the_reference_in_ready(void)
{
    go_ready();
    see_index();
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, modes.angle.reference);
    ticks(3);
    raw.position_cnt = 16U;
    ticks(1);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, modes.angle.reference);
    ticks(3);
    raw.position_cnt = 33U;
    ticks(1);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, modes.angle.reference);
    in.command.run = true;
    ticks(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
    TEST_ASSERT_EQUAL_UINT16(2U, status_of(0U).position_jumps); /* on, and off */
}

static void three_sensors(void)
{
    config.board.current_sensors = 3U;
    init();
    raw.ic_cnt = 2048U;
}

/* EQ-APP-SUM-1, wherever the bridge may be closed; the third sample in a row. */
static void test_currents_that_do_not_sum_to_zero_trip_a_driven_motor(void)
{
    void (*const starts[])(void) = {go_run, go_align};

    for (int way = 0; way < 2; way++) {
        setUp();
        three_sensors();
        starts[way]();
        raw.ic_cnt = 2248U;
        tick();
        tick();
        TEST_ASSERT_TRUE(out.gate_enable);
        tick();
        assert_fault(APP_FAULT_CURRENT_SUM);
        raw.ic_cnt = 2048U;
        assert_latched_until_reset(APP_FAULT_CURRENT_SUM, APP_MODE_READY);
    }
}

static void test_a_sum_is_none_of_two_sensors_nor_of_an_open_bridge(void)
{
    go_run();
    raw.ic_cnt = 2248U;
    ticks(10);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);

    setUp();
    three_sensors();
    go_ready();
    raw.ic_cnt = 2248U;
    ticks(10);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

static void test_a_third_zero_beyond_its_bound_faults(void)
{
    three_sensors();
    raw.ic_cnt = 2048U + 301U;
    ticks(BOOT_TICKS + CALIBRATE_TICKS + 1);
    assert_fault(APP_FAULT_OFFSET);
    raw.ic_cnt       = 2048U + 299U;
    in.command.reset = true;
    tick();
    in.command.reset = false;
    ticks(BOOT_TICKS + CALIBRATE_TICKS + 1);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    TEST_ASSERT_EQUAL_FLOAT((3.0f * 2048.0f) + 299.0f, modes.sum.zero_cnt);
}

static void test_one_sensor_or_four_are_refused(void)
{
    for (uint16_t n = 0U; n < 6U; n++) {
        config.board.current_sensors = n;
        TEST_ASSERT_EQUAL_INT(((n == 2U) || (n == 3U)) ? CTL_OK : CTL_BAD_CONFIG,
                              app_modes_init(&modes, &config, &drive_config));
    }
}

static void test_a_zero_that_has_drifted_is_found_after_the_stop(void)
{
    go_run();
    in.command.run = false;
    ticks(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    raw.ib_cnt = 2048U + 78U; /* 0.38 A */
    ticks(400);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    raw.ib_cnt = 2048U + 90U; /* 0.44 A: after the mean has followed */
    ticks(150);
    assert_fault(APP_FAULT_OFFSET);
    in.command.reset = true;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_BOOT, modes.mode); /* measures it again */
}

static void test_currents_that_die_out_are_no_drift(void)
{
    go_run();
    in.command.run = false;
    ticks(2);
    raw.ia_cnt = 2048U + 600U;
    ticks(15);
    raw.ia_cnt = 2048U;
    ticks(500);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

static void test_heat_takes_from_the_limit_and_trips_when_nobody_follows(void)
{
    config.heat.motor_s = 0.05f; /* every tick here is the one in a millisecond */
    init();
    go_run();
    raw.ia_cnt = 2048U + 614U; /* a vector of 3 A along phase a: 1.33 times the square of 2.6 A */
    raw.ib_cnt = 2048U - 307U;
    ticks(70);
    TEST_ASSERT_TRUE(modes.heat.derating > 0.0f);
    TEST_ASSERT_TRUE(status_of(0U).motor_heat > 0.9f);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    ticks(50);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_HEAT, modes.fault);
}

/* Only a driven motor must not be too hot: it cools in READY, and a start is a fault. */
static void test_heat_trips_no_drive_at_rest(void)
{
    go_ready();
    see_index();
    modes.heat.motor.x = 2.0f;
    ticks(20);
    TEST_ASSERT_TRUE(modes.too_hot);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    in.command.run = true;
    ticks(2);
    assert_fault(APP_FAULT_HEAT);
}

/* As if the slow work never came. */
static void test_start_before_the_first_temperature_faults(void)
{
    in.slow = 0U;
    go_ready();
    see_index();
    modes.dc_link_out = false;
    in.command.run    = true;
    tick();
    assert_open();
    tick();
    assert_fault(APP_FAULT_TEMPERATURE_SENSOR);
}

static void test_changed_constants_are_a_fault_in_every_mode(void)
{
    in.memory_changed = true;
    tick();
    assert_fault(APP_FAULT_MEMORY);
    init();
    go_run();
    in.memory_changed = true;
    tick();
    assert_fault(APP_FAULT_MEMORY);
}

static void test_lost_background_trips_in_every_mode(void)
{
    for (int mode = 0; mode < 5; mode++) {
        init();
        if (mode == 1) {
            ticks(BOOT_TICKS + 5);
        } else if (mode == 2) {
            go_ready();
        } else if (mode > 2) {
            ways[mode - 3]();
        }
        in.background_lost = true;
        tick();
        assert_fault(APP_FAULT_BACKGROUND);
        assert_latched_until_reset(APP_FAULT_BACKGROUND,
                                   (mode < 2) ? APP_MODE_BOOT : APP_MODE_READY);
    }
}

static void test_temperature_beyond_the_trip_level_trips(void)
{
    for (int i = 0; i < SUPPORT_COUNT(ways); i++) {
        init();
        ways[i]();
        raw.temperature_cnt = CODE_90_degC + 1;
        tick();
        TEST_ASSERT_TRUE(out.gate_enable);
        TEST_ASSERT_TRUE(modes.hot);
        raw.temperature_cnt = CODE_90_degC;
        tick();
        assert_fault(APP_FAULT_TEMPERATURE);
        assert_latched_until_reset(APP_FAULT_TEMPERATURE, APP_MODE_READY);
    }
}

static void test_broken_temperature_sensor_trips(void)
{
    static const int broken[] = {0, 4095};
    for (int i = 0; i < SUPPORT_COUNT(ways); i++) {
        for (int k = 0; k < SUPPORT_COUNT(broken); k++) {
            init();
            ways[i]();
            raw.temperature_cnt = (uint16_t)broken[k];
            tick();
            assert_fault(APP_FAULT_TEMPERATURE_SENSOR);
            assert_latched_until_reset(APP_FAULT_TEMPERATURE_SENSOR, APP_MODE_READY);
        }
    }
}

static void test_hot_drive_refuses_to_start_until_asked_again(void)
{
    go_ready();
    see_index();
    raw.temperature_cnt = CODE_80_degC;
    tick();
    TEST_ASSERT_TRUE(modes.hot);
    in.command.run = true;
    ticks(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    raw.temperature_cnt = CODE_80_degC + 1;
    ticks(5);
    TEST_ASSERT_FALSE(modes.hot);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    in.command.run = false;
    tick();
    in.command.run = true;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
}

/* Starting shows the operator that the sensor is broken; waiting for it to cool would not. */
static void test_start_with_a_broken_sensor_faults_before_the_gates(void)
{
    go_ready();
    see_index();
    raw.temperature_cnt = 0U;
    in.command.run      = true;
    tick();
    assert_open();
    tick();
    assert_fault(APP_FAULT_TEMPERATURE_SENSOR);
}

static void test_index_far_off_trips_and_costs_the_angle(void)
{
    go_run();
    raw.index_cnt = 101U;
    see_index();
    assert_fault(APP_FAULT_INDEX);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, modes.angle.reference);
    assert_latched_until_reset(APP_FAULT_INDEX, APP_MODE_READY);
}

static void test_index_fault_is_not_seen_again_in_invalid_samples(void)
{
    go_run();
    raw.index_cnt = 101U;
    see_index();
    assert_fault(APP_FAULT_INDEX);
    raw.valid        = false;
    in.command.run   = false;
    in.command.reset = true;
    tick();
    in.command.reset = false;
    ticks(3);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

static void test_index_a_little_off_is_corrected_on_the_run(void)
{
    go_run();
    raw.index_cnt = 20U;
    see_index();
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_EQUAL_UINT(1U, modes.angle.corrections);
}

static void test_faults_of_the_drive_trip_and_are_named(void)
{
    for (int i = 0; i < SUPPORT_COUNT(ways); i++) {
        init();
        ways[i]();
        raw.ia_cnt = (uint16_t)(2048 + 1640); /* 8.008 A */
        if (ways[i] == go_run) {
            tick(); /* one alone is a spike */
            TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, modes.fault);
        }
        tick();
        assert_fault(APP_FAULT_DRIVE);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_OVER_CURRENT, modes.snapshot.drive_fault);
        TEST_ASSERT_EQUAL_UINT(2048 + 1640, modes.snapshot.raw.ia_cnt);
        assert_latched_until_reset(APP_FAULT_DRIVE, APP_MODE_READY);
        tick();
        in.command.run = true;
        ticks(510);
        TEST_ASSERT_TRUE(out.gate_enable); /* and runs or aligns again */

        init();
        ways[i]();
        raw.dc_link_cnt = 0U;
        tick();
        assert_fault(APP_FAULT_DRIVE);
        TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_DC_LINK, modes.snapshot.drive_fault);
    }
}

static void test_command_out_of_range_trips_in_the_same_tick(void)
{
    static const float bad[] = {1191.4f, -1191.4f, NAN, INFINITY, -INFINITY};
    for (int i = 0; i < SUPPORT_COUNT(ways); i++) {
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            init();
            ways[i]();
            in.command.omega_e_radps = bad[k];
            tick();
            assert_fault(APP_FAULT_DRIVE);
            TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_COMMAND, modes.snapshot.drive_fault);
        }
    }
}

/* Encoder form: 240 counts are 0.30 rad electrical, and just below the trip speed. */
static void test_encoder_fault_of_the_drive_costs_the_angle(void)
{
    drive_config = gain_tables_drive;
    init();
    go_run();
    for (uint16_t n = 1U; n <= 4U; n++) { /* not a glitch, not lost counts, and no motor does it */
        TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, modes.fault);
        raw.position_cnt = (uint16_t)(100U * n);
        tick();
    }
    assert_fault(APP_FAULT_DRIVE);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_ENCODER, modes.snapshot.drive_fault);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, modes.angle.reference);
}

static void test_align_without_a_motor_fails(void)
{
    go_align();
    ticks(14000);
    assert_fault(APP_FAULT_ALIGN);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_NONE, modes.angle.reference);
}

/* A rotor that follows the vector exactly. The currents matter at the end: 2 A along phase a. */
static void go_aligned(void)
{
    go_ready();
    raw.position_cnt = 9000U;
    tick();
    in.command.run = true;
    tick();
    for (int n = 1; n < 14000; n++) {
        const int swept  = (n > 2000) ? ((n < 8000) ? n - 2000 : 6000) : 0;
        raw.position_cnt = (uint16_t)((9000 + ((2500 * swept) / 6000)) % 10000);
        raw.ia_cnt       = (n > 13000) ? (2048U + 410U) : 2048U;
        raw.ib_cnt       = (n > 13000) ? (2048U - 205U) : 2048U;
        tick();
        TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
    }
    tick();
    raw.ia_cnt = 2048U;
    raw.ib_cnt = 2048U;
}

static void go_align_with_an_index(void)
{
    go_align();
    see_index();
}

/* The two ways to find the angle. */
static void (*const found[])(void) = {go_aligned, go_align_with_an_index};

#define ZERO_TICKS 100U

static void test_align_ends_in_run_with_the_angle_zero_here(void)
{
    go_aligned();
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_ALIGNED, modes.angle.reference);
    ticks(ZERO_TICKS + 1U);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
    tick();
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 0.0f, modes.reading.theta_e_rad);
    TEST_ASSERT_TRUE(out.gate_enable);
}

static void test_index_during_align_ends_it(void)
{
    go_align_with_an_index();
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, modes.angle.reference);
    ticks(ZERO_TICKS + 1U);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
    TEST_ASSERT_EQUAL_INT(DRIVE_RUN, modes.drive.state);
}

static void test_sensors_read_zero_between_alignment_and_run(void)
{
    for (int i = 0; i < SUPPORT_COUNT(found); i++) {
        init();
        found[i]();
        for (uint16_t n = 1U; n < ZERO_TICKS; n++) {
            TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
            assert_open();
            tick();
        }
        tick();
        TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    }
}

static void test_a_sensor_off_after_alignment_trips(void)
{
    for (int i = 0; i < SUPPORT_COUNT(found); i++) {
        init();
        found[i]();
        raw.ib_cnt = 2048U - 90U; /* 0.44 A */
        ticks(ZERO_TICKS + 1U);
        assert_fault(APP_FAULT_OFFSET);
    }
}

/* Both ways to a run: from READY, and from an alignment. */
static void test_a_sensor_that_moves_at_the_start_delays_and_trips(void)
{
    for (int i = 0; i < SUPPORT_COUNT(found); i++) {
        init();
        found[i]();
        ticks(ZERO_TICKS - 1U);
        raw.ib_cnt = 2048U - 200U; /* 0.98 A: the mean needs some ticks */
        ticks(5);
        TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
        ticks(50);
        assert_fault(APP_FAULT_OFFSET);
    }
    init();
    go_ready();
    see_index();
    ticks(2U * ZERO_TICKS);
    raw.ia_cnt     = 2048U + 200U;
    in.command.run = true;
    ticks(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    ticks(50);
    assert_fault(APP_FAULT_OFFSET);
}

static void test_one_wrong_sample_at_the_start_delays_it_only(void)
{
    for (int i = 0; i < SUPPORT_COUNT(found); i++) {
        init();
        found[i]();
        ticks(ZERO_TICKS - 1U);
        raw.ib_cnt = 2048U - 900U;
        tick();
        raw.ib_cnt = 2048U;
        TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
        tick();
        TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
    }
    init();
    go_ready();
    see_index();
    ticks(2U * ZERO_TICKS);
    raw.ia_cnt     = 2048U + 900U;
    in.command.run = true;
    tick();
    raw.ia_cnt = 2048U;
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    ticks(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
}

static void test_second_alignment_starts_over(void)
{
    go_align();
    in.command.run = false;
    ticks(2);
    in.command.run = true;
    ticks(500);
    TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
    TEST_ASSERT_FALSE(out.gate_enable);
    tick();
    TEST_ASSERT_TRUE(out.gate_enable);
}

static void test_snapshot_keeps_the_first_fault(void)
{
    go_run();
    in.command.omega_e_radps = 12.5f;
    raw.valid                = false;
    raw.ib_cnt               = 77U;
    tick();
    const uint32_t at = modes.ticks;
    raw.ib_cnt        = 88U;
    in.board_faults   = BOARD_FAULT_CLOCK;
    ticks(10);

    const app_snapshot_t *s = &modes.snapshot;
    TEST_ASSERT_EQUAL_INT(APP_FAULT_SAMPLE, s->fault);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, s->mode);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, s->drive_fault);
    TEST_ASSERT_EQUAL_UINT(0U, s->board_faults);
    TEST_ASSERT_EQUAL_UINT(77U, s->raw.ib_cnt);
    TEST_ASSERT_TRUE(s->wanted_e_radps == 12.5f);
    TEST_ASSERT_TRUE(s->ticks == at);
    TEST_ASSERT_TRUE(modes.ticks == (at + 10U));
}

static void test_status_before_the_first_tick_promises_nothing(void)
{
    const app_status_t s = status_of(0U);

    TEST_ASSERT_EQUAL_INT(APP_MODE_BOOT, s.mode);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, s.fault);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, s.snapshot.fault);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_NONE, s.snapshot.drive_fault);
    TEST_ASSERT_TRUE((s.snapshot.ticks == 0U) && (s.snapshot.raw.ia_cnt == 0U));
    TEST_ASSERT_TRUE(s.hot && !s.gate_enable);
    TEST_ASSERT_TRUE((s.ticks == 0U) && (s.dc_link_V == 0.0f) && (s.theta_e_rad == 0.0f));
    TEST_ASSERT_TRUE((s.tick_cycles == 0U) && (s.tick_cycles_worst == 0U));
}

static void test_status_repeats_what_is_inside(void)
{
    raw.ia_cnt = 2050U;
    raw.ib_cnt = 2041U;
    go_run();
    raw.ia_cnt       = 2100U;
    raw.position_cnt = 3U;
    tick();
    const app_status_t s = status_of(5U);

    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, s.mode);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, s.reference);
    TEST_ASSERT_EQUAL_UINT(5U, s.board_faults);
    TEST_ASSERT_EQUAL_UINT(3U, s.position_cnt);
    TEST_ASSERT_TRUE(s.gate_enable && !s.hot);
    TEST_ASSERT_TRUE(s.speed_e_radps == modes.drive.answer.now.omega_e_radps);
    TEST_ASSERT_TRUE((s.i_A.q == modes.drive.answer.now.iq_A) &&
                     (s.i_A.d == modes.drive.answer.now.id_A));
    TEST_ASSERT_TRUE((s.i_A.q != 0.0f) && (s.i_A.d > 0.1f));
    TEST_ASSERT_TRUE((s.zero_a_cnt == 2050.0f) && (s.zero_b_cnt == 2041.0f));
    TEST_ASSERT_TRUE((s.v_V.q == modes.drive.v_V.q) && (s.v_V.q != 0.0f));
    TEST_ASSERT_TRUE((s.d_omega == modes.drive.answer.d_omega) && (s.d_omega != 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(0.1f, 25.0f, s.temperature_degC);
    TEST_ASSERT_FLOAT_WITHIN(0.1f, 295.0f, s.dc_link_V);
    TEST_ASSERT_TRUE(s.ticks == modes.ticks);

    in.command.run   = false;
    raw.position_cnt = 4U;
    tick();
    const app_status_t off = status_of(0U);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, 6.283f, off.speed_e_radps);
    TEST_ASSERT_TRUE((off.v_V.q == 0.0f) && (off.i_A.q == 0.0f) && !off.gate_enable);
}

/* At nine tenths of what heat leaves of the limit, in RUN only. */
static void test_status_tells_a_current_at_its_limit(void)
{
    go_run();
    const float limit_A         = drive_config.current_max_A;
    modes.heat.derating         = 0.5f;
    modes.drive.answer.now.id_A = 0.0f;
    modes.drive.answer.now.iq_A = -0.46f * limit_A;
    TEST_ASSERT_TRUE(status_of(0U).current_limited);
    modes.drive.answer.now.iq_A = -0.44f * limit_A;
    TEST_ASSERT_FALSE(status_of(0U).current_limited);
    modes.drive.answer.now.iq_A = -limit_A;
    modes.drive.v_limited       = true;
    modes.mode                  = APP_MODE_STOP;
    TEST_ASSERT_TRUE(status_of(0U).current_limited && status_of(0U).voltage_limited);
    modes.mode = APP_MODE_READY;
    TEST_ASSERT_FALSE(status_of(0U).current_limited || status_of(0U).voltage_limited);
}

static void assert_config_refused(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_modes_init(&modes, &config, &drive_config));
    in.command.run = false;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_CONFIG, modes.fault);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_CONFIG, modes.snapshot.fault);
    in.command.reset = true;
    ticks(3);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_CONFIG, modes.fault);
    in.command.reset = false;
    setUp();
}

static void test_bad_constants_end_in_fault_for_good(void)
{
    drive_config.motor.l5 = NAN;
    assert_config_refused();
    drive_config.ts_s = 1.0e-4f; /* of another board */
    assert_config_refused();
    drive_config.hardware.pole_pairs = 0U;
    assert_config_refused();
    drive_config.hardware.pole_pairs = 65U;
    assert_config_refused();
    drive_config.hardware.updates_per_period = 2U; /* but not its control period */
    assert_config_refused();
    drive_config.hardware.updates_per_period = 0U;
    assert_config_refused();
    drive_config.hardware.encoder_positions = 4096UL;
    assert_config_refused();
    drive_config.hardware.dead_time_s = 2.0e-6f;
    assert_config_refused();
    drive_config.dc_link_max_V = 451.0f; /* beyond what the converter can show */
    assert_config_refused();
    drive_config.trip_current_A = 9.6f;
    assert_config_refused();
    config.angle.index_theta_e_rad = -1.0f;
    assert_config_refused();
    config.scale.offset_max_cnt = 1000.0f;
    assert_config_refused();
    config.align.current_A = 3.0f;
    assert_config_refused();
    config.temperature_limit_degC = config.temperature_trip_degC + 1.0f;
    assert_config_refused();
    config.temperature_trip_degC = NAN;
    assert_config_refused();
    config.calibrate_ticks = 0U;
    assert_config_refused();
    config.background_ticks = 0U;
    assert_config_refused();
    config.calibrate_ticks  = 1U;
    config.background_ticks = 1U;
    init();
    drive_config.hardware.updates_per_period = 2U;
    config.pwm_period_s                      = 400.0e-6f;
    init();
}

static void test_both_forms_of_the_shipped_drive_fit_the_board(void)
{
    drive_config = gain_tables_drive;
    init();
    go_run();
}

/* Into COMMISSION with the bridge closed. */
static void go_commission(void)
{
    go_ready();
    in.command.bounds.current_A     = 3.0f;
    in.command.bounds.speed_m_radps = 150.0f;
    tick();
    in.command.commission = true;
    ticks(1 + 1100);
    TEST_ASSERT_EQUAL_INT(APP_MODE_COMMISSION, modes.mode);
    TEST_ASSERT_TRUE(out.gate_enable);
}

static void test_commissioning_starts_when_it_rises_in_ready(void)
{
    in.command.commission           = true; /* there before: waits for a 0 first */
    in.command.bounds.current_A     = 3.0f;
    in.command.bounds.speed_m_radps = 150.0f;
    go_ready();
    ticks(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    init();
    in.command.commission = false;
    go_commission();
    TEST_ASSERT_EQUAL_INT(COMMISSION_LOOK, status_of(0U).commission.stage);
}

static void test_commissioning_is_refused_without_bounds_and_with_run(void)
{
    static const float bad[][2] = {{0.0f, 150.0f}, {3.0f, 0.0f}, {1000.0f, 150.0f}, {NAN, 150.0f}};
    for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
        init();
        go_ready();
        in.command.bounds.current_A     = bad[k][0];
        in.command.bounds.speed_m_radps = bad[k][1];
        tick();
        in.command.commission = true;
        ticks(3);
        TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
        in.command.commission = false;
    }
    init();
    go_ready();
    see_index();
    in.command.bounds.current_A     = 3.0f;
    in.command.bounds.speed_m_radps = 150.0f;
    in.command.commission           = true;
    in.command.run                  = true;
    ticks(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
}

static void test_commissioning_that_is_withdrawn_opens_the_bridge(void)
{
    go_commission();
    in.command.commission = false;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    assert_open();
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_WITHDRAWN, modes.commission.module.reason);

    init();
    go_commission();
    in.command.run = true;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    assert_open();
}

/* 3.4 A where 3 A are allowed: no trip of the drive. */
static void test_commissioning_that_is_aborted_is_a_fault_with_its_reason(void)
{
    go_commission();
    raw.ia_cnt = (uint16_t)(2048U + (uint16_t)(3.4f / config.scale.current_A_per_cnt));
    tick();
    assert_fault(APP_FAULT_COMMISSION);
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_OVER_CURRENT, status_of(0U).commission.reason);
    raw.ia_cnt            = 2048U;
    in.command.commission = false;
    in.command.reset      = true;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

static void test_what_watches_a_run_watches_a_commissioning(void)
{
    go_commission();
    raw.valid = false;
    tick();
    assert_fault(APP_FAULT_SAMPLE);
    init();
    go_commission();
    in.board_faults = (uint16_t)BOARD_FAULT_TRIP;
    tick();
    assert_fault(APP_FAULT_BOARD);
    init();
    go_commission();
    in.background_lost = true;
    tick();
    assert_fault(APP_FAULT_BACKGROUND);
    init();
    go_commission();
    raw.temperature_cnt = CODE_90_degC;
    tick();
    assert_fault(APP_FAULT_TEMPERATURE);
    init();
    go_commission();
    in.tick_missing = true;
    tick();
    assert_fault(APP_FAULT_TICK);
    init();
    go_commission();
    in.memory_changed = true;
    tick();
    assert_fault(APP_FAULT_MEMORY);
}

/* The lines of the encoder are unknown there: an index out of place says nothing. */
static void test_an_index_out_of_place_does_not_end_a_commissioning(void)
{
    go_ready();
    see_index();
    in.command.bounds.current_A     = 3.0f;
    in.command.bounds.speed_m_radps = 150.0f;
    tick();
    in.command.commission = true;
    tick();
    raw.index_cnt = 700U;
    see_index();
    ticks(20);
    TEST_ASSERT_EQUAL_INT(APP_MODE_COMMISSION, modes.mode);
}

/* Requests that start without run: alignment alone, and commissioning. */
typedef struct {
    bool      *request;
    app_mode_t mode;
} request_t;

static const request_t requests[] = {{&in.command.align, APP_MODE_ALIGN},
                                     {&in.command.commission, APP_MODE_COMMISSION}};

static void allow_commissioning(void)
{
    in.command.bounds.current_A     = 3.0f;
    in.command.bounds.speed_m_radps = 150.0f;
}

/* It stays in READY with the request, and starts when the request rises again. */
static void assert_waits_for_an_edge(const request_t *r)
{
    for (int n = 0; n < 5; n++) {
        tick();
        TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    }
    *r->request = false;
    tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    *r->request = true;
    tick();
    TEST_ASSERT_EQUAL_INT(r->mode, modes.mode);
}

static void test_a_request_that_was_there_before_ready_needs_an_edge(void)
{
    for (int i = 0; i < SUPPORT_COUNT(requests); i++) {
        init();
        allow_commissioning();
        *requests[i].request = true;
        go_ready();
        assert_waits_for_an_edge(&requests[i]);
    }
}

static void test_a_request_that_stays_after_the_fault_it_led_to_needs_an_edge(void)
{
    for (int i = 0; i < SUPPORT_COUNT(requests); i++) {
        init();
        allow_commissioning();
        go_ready();
        tick();
        *requests[i].request = true;
        ticks(3);
        in.memory_changed = true;
        tick();
        assert_fault(APP_FAULT_MEMORY);
        in.memory_changed = false;
        in.command.reset  = true;
        tick();
        in.command.reset = false;
        TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
        assert_waits_for_an_edge(&requests[i]);
    }
}

static void test_a_refused_request_is_not_repeated_later(void)
{
    for (int i = 0; i < SUPPORT_COUNT(requests); i++) {
        init();
        allow_commissioning();
        go_ready();
        tick();
        raw.dc_link_cnt      = 0U;
        in.slow              = APP_SLOW_TURN;
        *requests[i].request = false;
        ticks(3);
        *requests[i].request = true;
        ticks(3);
        TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
        raw.dc_link_cnt = 2685U;
        assert_waits_for_an_edge(&requests[i]);
    }
}

/* A run has priority. */
static void test_a_request_together_with_a_run_is_a_run(void)
{
    for (int i = 0; i < SUPPORT_COUNT(requests); i++) {
        init();
        allow_commissioning();
        go_ready();
        see_index();
        tick();
        *requests[i].request = true;
        in.command.run       = true;
        tick();
        TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, modes.mode);
        in.command.run = false; /* the request is still there: it rose before */
        tick();
        assert_waits_for_an_edge(&requests[i]);
    }
}

static void test_a_request_that_rises_in_a_run_needs_an_edge_after_it(void)
{
    for (int i = 0; i < SUPPORT_COUNT(requests); i++) {
        init();
        allow_commissioning();
        go_run();
        *requests[i].request = true;
        in.command.run       = false;
        tick();
        assert_waits_for_an_edge(&requests[i]);
    }
}

static void test_a_run_that_ends_a_commissioning_needs_an_edge(void)
{
    go_commission();
    in.command.run = true;
    ticks(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    in.command.commission = false;
    ticks(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
}

/* The state that a mode with the bridge on or off makes of a brake after the shortest times. */
static app_brake_state_t brake_after(app_brake_state_t before, float omega_e_radps)
{
    const app_objects_t o = {.brake_used = 1U};

    modes.brake.state                    = before;
    modes.brake.left                     = 50U;
    modes.drive.answer.now.omega_e_radps = omega_e_radps;
    for (int n = 0; n < 200; n++) {
        app_modes_brake(&modes, &o, true, drive_config.ts_s);
    }
    return modes.brake.state;
}

static void test_each_mode_asks_for_its_state_of_the_brake(void)
{
    const float turns = 1.1f * config.stop.still_e_radps;

    for (int mode = APP_MODE_BOOT; mode <= (int)APP_MODE_COMMISSION; mode++) {
        for (int stage = APP_ALIGN_WATCH; stage <= (int)APP_ALIGN_FAILED; stage++) {
            const bool vector = (stage == (int)APP_ALIGN_SWEEP) || (stage == (int)APP_ALIGN_SETTLE);
            const bool frees  = (mode == (int)APP_MODE_RUN) || (mode == (int)APP_MODE_COMMISSION) ||
                               ((mode == (int)APP_MODE_ALIGN) && vector);
            const bool closes = (mode == (int)APP_MODE_FAULT) ||
                                ((mode == (int)APP_MODE_ALIGN) && (stage == (int)APP_ALIGN_DONE));

            modes.mode        = (app_mode_t)mode;
            modes.align.stage = (app_align_stage_t)stage;
            modes.gate_on     = true;
            TEST_ASSERT_EQUAL_INT(frees ? APP_BRAKE_RELEASED : APP_BRAKE_CLOSED,
                                  brake_after(APP_BRAKE_CLOSED, turns));
            TEST_ASSERT_EQUAL_INT(closes ? APP_BRAKE_CLOSED : APP_BRAKE_RELEASED,
                                  brake_after(APP_BRAKE_RELEASED, turns));
            TEST_ASSERT_EQUAL_INT(
                (closes || (mode == (int)APP_MODE_STOP)) ? APP_BRAKE_CLOSED : APP_BRAKE_RELEASED,
                brake_after(APP_BRAKE_RELEASED, 0.9f * config.stop.still_e_radps));
            modes.gate_on = false;
            TEST_ASSERT_EQUAL_INT(APP_BRAKE_CLOSED, brake_after(APP_BRAKE_RELEASED, 0.0f));
        }
    }
}

/* Whatever the drive file says of the end of a run, and without a brake as it says. */
static void test_a_withdrawn_run_waits_until_the_brake_has_closed(void)
{
    for (int state = APP_BRAKE_NONE; state <= (int)APP_BRAKE_CLOSING; state++) {
        init();
        go_run();
        modes.brake.state = (app_brake_state_t)state;
        in.command.run    = false;
        for (int n = 0; n < 50; n++) {
            out = app_modes_tick(&modes, &in);
            TEST_ASSERT_EQUAL_INT((state > (int)APP_BRAKE_CLOSED), out.gate_enable);
        }
        TEST_ASSERT_EQUAL_INT((state > (int)APP_BRAKE_CLOSED) ? APP_MODE_STOP : APP_MODE_READY,
                              modes.mode);
        modes.brake.state = APP_BRAKE_CLOSED;
        tick();
        TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
        assert_open();
    }
}

static void test_a_fault_does_not_wait_for_the_brake(void)
{
    go_run();
    modes.brake.state = APP_BRAKE_RELEASED;
    raw.valid         = false;
    tick();
    assert_fault(APP_FAULT_SAMPLE);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_start_boots_calibrates_and_waits_with_the_bridge_open);
    RUN_TEST(test_calibration_takes_the_mean_of_each_phase);
    RUN_TEST(test_zero_beyond_its_bound_faults_and_can_be_tried_again);
    RUN_TEST(test_run_given_too_early_does_not_start_by_itself);
    RUN_TEST(test_gates_are_asked_for_by_the_second_tick_of_a_run);
    RUN_TEST(test_withdrawn_run_opens_the_bridge_in_the_same_tick);
    RUN_TEST(test_run_gets_what_the_drive_gives);
    RUN_TEST(test_invalid_sample_trips_in_the_same_tick_and_costs_the_angle);
    RUN_TEST(test_invalid_sample_in_ready_costs_the_angle_only);
    RUN_TEST(test_every_board_fault_trips_while_the_gates_are_on);
    RUN_TEST(test_board_faults_are_ignored_until_the_gates_were_enabled);
    RUN_TEST(test_dc_link_out_of_range_is_not_ready);
    RUN_TEST(test_active_trip_input_is_not_ready);
    RUN_TEST(test_bootstrap_supplies_are_charged_before_a_run);
    RUN_TEST(test_a_precharge_ends_at_once_when_something_is_wrong);
    RUN_TEST(test_no_precharge_at_speed);
    RUN_TEST(test_a_fault_at_speed_shorts_the_motor_until_it_is_slow);
    RUN_TEST(test_a_fault_at_low_speed_opens);
    RUN_TEST(test_board_faults_and_over_current_open_at_any_speed);
    RUN_TEST(test_a_lost_encoder_at_speed_leaves_the_motor_shorted);
    RUN_TEST(test_a_dead_encoder_does_not_end_the_short);
    RUN_TEST(test_fault_without_angle_is_the_encoder);
    RUN_TEST(test_index_of_a_lost_encoder_does_not_end_the_braking);
    RUN_TEST(test_a_stop_at_speed_brakes_before_it_opens);
    RUN_TEST(test_a_ramp_brakes_to_standstill);
    RUN_TEST(test_lost_background_trips_in_every_mode);
    RUN_TEST(test_a_jump_drops_the_reference_in_ready);
    RUN_TEST(test_currents_that_do_not_sum_to_zero_trip_a_driven_motor);
    RUN_TEST(test_a_sum_is_none_of_two_sensors_nor_of_an_open_bridge);
    RUN_TEST(test_a_third_zero_beyond_its_bound_faults);
    RUN_TEST(test_one_sensor_or_four_are_refused);
    RUN_TEST(test_a_zero_that_has_drifted_is_found_after_the_stop);
    RUN_TEST(test_currents_that_die_out_are_no_drift);
    RUN_TEST(test_heat_takes_from_the_limit_and_trips_when_nobody_follows);
    RUN_TEST(test_heat_trips_no_drive_at_rest);
    RUN_TEST(test_start_before_the_first_temperature_faults);
    RUN_TEST(test_changed_constants_are_a_fault_in_every_mode);
    RUN_TEST(test_temperature_beyond_the_trip_level_trips);
    RUN_TEST(test_broken_temperature_sensor_trips);
    RUN_TEST(test_hot_drive_refuses_to_start_until_asked_again);
    RUN_TEST(test_start_with_a_broken_sensor_faults_before_the_gates);
    RUN_TEST(test_index_far_off_trips_and_costs_the_angle);
    RUN_TEST(test_index_fault_is_not_seen_again_in_invalid_samples);
    RUN_TEST(test_index_a_little_off_is_corrected_on_the_run);
    RUN_TEST(test_faults_of_the_drive_trip_and_are_named);
    RUN_TEST(test_command_out_of_range_trips_in_the_same_tick);
    RUN_TEST(test_encoder_fault_of_the_drive_costs_the_angle);
    RUN_TEST(test_align_without_a_motor_fails);
    RUN_TEST(test_align_ends_in_run_with_the_angle_zero_here);
    RUN_TEST(test_index_during_align_ends_it);
    RUN_TEST(test_sensors_read_zero_between_alignment_and_run);
    RUN_TEST(test_a_sensor_off_after_alignment_trips);
    RUN_TEST(test_a_sensor_that_moves_at_the_start_delays_and_trips);
    RUN_TEST(test_one_wrong_sample_at_the_start_delays_it_only);
    RUN_TEST(test_second_alignment_starts_over);
    RUN_TEST(test_snapshot_keeps_the_first_fault);
    RUN_TEST(test_status_before_the_first_tick_promises_nothing);
    RUN_TEST(test_status_tells_a_current_at_its_limit);
    RUN_TEST(test_status_repeats_what_is_inside);
    RUN_TEST(test_bad_constants_end_in_fault_for_good);
    RUN_TEST(test_both_forms_of_the_shipped_drive_fit_the_board);
    RUN_TEST(test_commissioning_starts_when_it_rises_in_ready);
    RUN_TEST(test_commissioning_is_refused_without_bounds_and_with_run);
    RUN_TEST(test_commissioning_that_is_withdrawn_opens_the_bridge);
    RUN_TEST(test_commissioning_that_is_aborted_is_a_fault_with_its_reason);
    RUN_TEST(test_what_watches_a_run_watches_a_commissioning);
    RUN_TEST(test_an_index_out_of_place_does_not_end_a_commissioning);
    RUN_TEST(test_a_request_that_was_there_before_ready_needs_an_edge);
    RUN_TEST(test_a_request_that_stays_after_the_fault_it_led_to_needs_an_edge);
    RUN_TEST(test_a_refused_request_is_not_repeated_later);
    RUN_TEST(test_a_request_together_with_a_run_is_a_run);
    RUN_TEST(test_a_request_that_rises_in_a_run_needs_an_edge_after_it);
    RUN_TEST(test_a_run_that_ends_a_commissioning_needs_an_edge);
    RUN_TEST(test_each_mode_asks_for_its_state_of_the_brake);
    RUN_TEST(test_a_withdrawn_run_waits_until_the_brake_has_closed);
    RUN_TEST(test_a_fault_does_not_wait_for_the_brake);
    return UNITY_END();
}
