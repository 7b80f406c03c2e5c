/* SPDX-License-Identifier: MIT */
#include "app_control.h"

#include <string.h>

#include "board_config.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

static app_control_t      control;
static app_objects_t      wanted;
static app_control_seen_t seen;
static app_command_t      out;

void setUp(void)
{
    (void)memset(&control, 0xFF, sizeof control); /* init has to set everything */
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_control_init(&control, &board_config, &gain_tables_drive));
    wanted                        = app_control_default(&gain_tables_drive);
    const app_control_seen_t boot = {.mode = APP_MODE_BOOT};
    seen                          = boot;
}

void tearDown(void) {}

/* A tick, and what the modes make of it: a run that is asked for in READY begins. */
static void tick(uint16_t controlword)
{
    wanted.controlword = controlword;
    app_control_tick(&control, &wanted, &seen, &out);
    const bool starts = (seen.mode == APP_MODE_READY) && !seen.in_the_way;
    if (out.run && starts) {
        seen.mode = APP_MODE_RUN;
    } else if (out.align && starts) {
        seen.mode = APP_MODE_ALIGN;
    } else if (out.commission && starts) {
        seen.mode = APP_MODE_COMMISSION;
    } else if (!out.run && !out.align && !out.commission &&
               ((seen.mode == APP_MODE_RUN) || (seen.mode == APP_MODE_ALIGN) ||
                (seen.mode == APP_MODE_COMMISSION))) {
        seen.mode = APP_MODE_READY;
    }
}

static void ticks(uint16_t controlword, int count)
{
    for (int n = 0; n < count; n++) {
        tick(controlword);
    }
}

/* Control words that lead to a state, each for three ticks. */
static void go(app_control_state_t to)
{
    static const uint16_t ways[APP_CONTROL_STATES][4] = {
        {0U, 0U, 0U, 0U},   {0U, 0U, 0U, 0U},  {0U, 6U, 6U, 6U}, {6U, 7U, 7U, 7U},
        {6U, 7U, 15U, 15U}, {6U, 7U, 15U, 2U}, {0U, 0U, 0U, 0U}, {0U, 0U, 0U, 0U}};
    if (to == APP_CONTROL_NOT_READY) {
        tick(0U);
    } else {
        seen.mode = APP_MODE_READY;
        for (int n = 0; n < 4; n++) {
            ticks(ways[to][n], 3);
        }
        if (to >= APP_CONTROL_FAULT_REACTION_ACTIVE) {
            seen.mode    = APP_MODE_FAULT;
            seen.shorted = to == APP_CONTROL_FAULT_REACTION_ACTIVE;
            ticks(0U, 3);
        }
    }
    TEST_ASSERT_EQUAL_INT(to, control.state);
}

/* Oracle: the transitions of the standard, table 28, by the pattern of the control word's bits 0 to
 * 3. The table here is written anew by state and word; -1: no transition. */
static int oracle(int state, int word)
{
    enum { NRTSO, SOD, RTSO, SO, OE, QSA, FRA, F };
    const bool so = (word & 1) != 0, ev = (word & 2) != 0, qs = (word & 4) != 0,
               eo    = (word & 8) != 0;
    const bool off   = !ev;
    const bool quick = ev && !qs;
    const bool shut  = ev && qs && !so;
    const bool on    = ev && qs && so && !eo;
    const bool run   = ev && qs && so && eo;
    switch (state) {
    case SOD:
        return shut ? RTSO : -1;
    case RTSO:
        return (off || quick) ? SOD : on ? SO : run ? OE : -1;
    case SO:
        return (off || quick) ? SOD : shut ? RTSO : run ? OE : -1;
    case OE:
        return off ? SOD : quick ? QSA : shut ? RTSO : on ? SO : -1;
    case QSA:
        return off ? SOD : run ? OE : -1;
    default:
        return -1;
    }
}

/* Every state with every pattern of the four bits: 128 cases. Quick stop stays (option 6), so that 16 is there too. */
static void test_every_transition_and_no_other(void)
{
    for (int state = 0; state < (int)APP_CONTROL_STATES; state++) {
        for (int word = 0; word < 16; word++) {
            setUp();
            wanted.quick_option = APP_CONTROL_QUICK_FAST_STAY;
            go((app_control_state_t)state);
            ticks((uint16_t)word, 4);
            const int want = oracle(state, word);
            /* Follows the automatic transitions with the same word. */
            int end = (want < 0) ? state : want;
            for (int n = 0; (n < 4) && (oracle(end, word) >= 0); n++) {
                end = oracle(end, word);
            }
            char text[40];
            (void)snprintf(text, sizeof text, "state %d word %d", state, word);
            TEST_ASSERT_EQUAL_INT_MESSAGE(end, control.state, text);
            TEST_ASSERT_EQUAL_INT_MESSAGE((end == APP_CONTROL_OPERATION_ENABLED) ||
                                              (end == APP_CONTROL_QUICK_STOP_ACTIVE),
                                          seen.mode == APP_MODE_RUN, text);
        }
    }
}

static void test_boot_leads_to_switch_on_disabled_whatever_is_asked(void)
{
    ticks(15U, 5);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_NOT_READY, control.state);
    seen.mode = APP_MODE_CALIBRATE;
    ticks(6U, 5);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_NOT_READY, control.state);
    seen.mode = APP_MODE_READY;
    ticks(15U, 5);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_SWITCH_ON_DISABLED, control.state);
    TEST_ASSERT_FALSE(out.run);
}

/* Bit 3 was there before: it has to rise. */
static void test_operation_is_enabled_by_a_rising_bit_only(void)
{
    seen.mode = APP_MODE_READY;
    ticks(14U, 3); /* shut down, with bit 3 */
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_READY_TO_SWITCH_ON, control.state);
    setUp();
    seen.mode       = APP_MODE_READY;
    seen.in_the_way = true;
    ticks(6U, 3);
    for (int n = 0; n < 3; n++) { /* not for a single tick */
        tick(15U);
        TEST_ASSERT_FALSE(out.run);
        TEST_ASSERT_EQUAL_INT(APP_CONTROL_SWITCHED, control.state);
    }
    seen.in_the_way = false;
    ticks(15U, 10); /* a refused start is not made up for */
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_SWITCHED, control.state);
    TEST_ASSERT_FALSE(out.run);
    ticks(7U, 1);
    ticks(15U, 2);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_OPERATION_ENABLED, control.state);
    TEST_ASSERT_TRUE(out.run);
}

/* The modes may refuse or end a run by themselves. */
static void test_a_run_that_does_not_begin_or_ends_leaves_the_state(void)
{
    go(APP_CONTROL_OPERATION_ENABLED);
    seen.mode       = APP_MODE_READY;
    seen.in_the_way = true;
    ticks(15U, 5);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_SWITCHED, control.state);
    TEST_ASSERT_FALSE(out.run);
}

static void test_a_fault_wins_over_every_control_word(void)
{
    for (int state = APP_CONTROL_SWITCH_ON_DISABLED; state <= APP_CONTROL_QUICK_STOP_ACTIVE;
         state++) {
        for (int word = 0; word < 16; word++) {
            setUp();
            wanted.quick_option = APP_CONTROL_QUICK_FAST_STAY;
            go((app_control_state_t)state);
            seen.mode    = APP_MODE_FAULT;
            seen.shorted = true;
            tick((uint16_t)word);
            TEST_ASSERT_EQUAL_INT(APP_CONTROL_FAULT_REACTION_ACTIVE, control.state);
            TEST_ASSERT_FALSE(out.run || out.align || out.commission || out.reset);
            seen.shorted = false;
            tick((uint16_t)word);
            TEST_ASSERT_EQUAL_INT(APP_CONTROL_FAULT, control.state);
            TEST_ASSERT_FALSE(out.run || out.align || out.commission || out.reset);
        }
    }
}

static void test_reset_acts_when_its_bit_rises(void)
{
    go(APP_CONTROL_FAULT);
    tick(128U);
    TEST_ASSERT_TRUE(out.reset);
    ticks(128U, 5);
    TEST_ASSERT_FALSE(out.reset);
    tick(0U);
    tick(143U); /* with all of a run */
    TEST_ASSERT_TRUE(out.reset && !out.run);
    seen.mode = APP_MODE_READY;
    ticks(143U, 5);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_SWITCH_ON_DISABLED, control.state);
    go(APP_CONTROL_SWITCHED);
    tick(0U);
    tick(128U);
    TEST_ASSERT_FALSE(out.reset); /* nothing to leave */
}

/* A bit that is set at the start has not risen: the fault stays until the master has seen it. */
static void test_a_reset_that_is_there_at_the_start_is_no_edge(void)
{
    seen.mode = APP_MODE_FAULT;
    for (int n = 0; n < 5; n++) {
        tick(128U);
        TEST_ASSERT_FALSE(out.reset);
    }
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_FAULT, control.state);
    tick(0U);
    tick(128U);
    TEST_ASSERT_TRUE(out.reset);
}

/* Bit 7 rises during a steady run, and a fault comes: the edge is over. */
static void test_a_reset_that_rose_in_a_run_does_not_end_a_later_fault(void)
{
    go(APP_CONTROL_OPERATION_ENABLED);
    ticks(15U, 3);
    ticks(143U, 3);
    TEST_ASSERT_FALSE(out.reset);
    seen.mode = APP_MODE_FAULT;
    for (int n = 0; n < 3; n++) {
        tick(143U);
        TEST_ASSERT_FALSE(out.reset);
    }
    tick(15U);
    tick(143U);
    TEST_ASSERT_TRUE(out.reset);
}

/* The command of the tick before is still in `out` when a run begins. */
static void test_a_steady_run_asks_for_nothing_else(void)
{
    go(APP_CONTROL_OPERATION_ENABLED);
    ticks(15U, 3);
    (void)memset(&out, 0xFF, sizeof out);
    out.run        = false;
    out.reset      = true;
    out.commission = true;
    out.align      = true;
    tick(15U);
    TEST_ASSERT_TRUE(out.run);
    TEST_ASSERT_FALSE(out.reset || out.commission || out.align);
}

static void test_quick_stop_options(void)
{
    static const struct {
        int                 option;
        bool                stays;
        bool                brakes;
        app_control_state_t end;
    } all[] = {{APP_CONTROL_QUICK_OFF, false, false, APP_CONTROL_SWITCH_ON_DISABLED},
               {APP_CONTROL_QUICK_RAMP, false, true, APP_CONTROL_SWITCH_ON_DISABLED},
               {APP_CONTROL_QUICK_FAST, false, true, APP_CONTROL_SWITCH_ON_DISABLED},
               {APP_CONTROL_QUICK_RAMP_STAY, true, true, APP_CONTROL_QUICK_STOP_ACTIVE},
               {APP_CONTROL_QUICK_FAST_STAY, true, true, APP_CONTROL_QUICK_STOP_ACTIVE}};
    for (int i = 0; i < SUPPORT_COUNT(all); i++) {
        setUp();
        go(APP_CONTROL_OPERATION_ENABLED);
        wanted.quick_option   = (int16_t)all[i].option;
        wanted.omega_e_radps  = 300.0f;
        wanted.decel_e_radps2 = 1000.0f;
        wanted.quick_e_radps2 = 5000.0f;
        seen.speed_e_radps    = 300.0f;
        ticks(15U, 3);
        TEST_ASSERT_TRUE(out.run && (out.omega_e_radps == 300.0f));
        tick(2U);
        TEST_ASSERT_TRUE(out.run == all[i].brakes);
        if (all[i].brakes) { /* 200 us of the deceleration that the option names */
            const bool fast = (all[i].option == APP_CONTROL_QUICK_FAST) ||
                              (all[i].option == APP_CONTROL_QUICK_FAST_STAY);
            TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, fast ? 299.0f : 299.8f, out.omega_e_radps);
            ticks(2U, 2000);
            TEST_ASSERT_TRUE(out.omega_e_radps == 0.0f);
            TEST_ASSERT_EQUAL_INT(APP_CONTROL_QUICK_STOP_ACTIVE, control.state);
        }
        seen.speed_e_radps = 1.0f;
        ticks(2U, 5);
        TEST_ASSERT_EQUAL_INT(all[i].end, control.state);
        TEST_ASSERT_TRUE(out.run == all[i].stays);
        ticks(15U, 3); /* 16: back, from a quick stop that stays */
        TEST_ASSERT_EQUAL_INT(all[i].stays ? APP_CONTROL_OPERATION_ENABLED
                                           : APP_CONTROL_SWITCH_ON_DISABLED,
                              control.state);
    }
}

/* Shut down and disable operation: at once, or along the ramp and then. */
static void test_stop_options(void)
{
    for (int ramps = 0; ramps < 2; ramps++) {
        for (int word = 6; word < 8; word++) {
            setUp();
            go(APP_CONTROL_OPERATION_ENABLED);
            wanted.shutdown_option = (int16_t)((word == 6) ? ramps : 1 - ramps);
            wanted.disable_option  = (int16_t)((word == 7) ? ramps : 1 - ramps);
            wanted.omega_e_radps   = 300.0f;
            wanted.decel_e_radps2  = 1000.0f;
            seen.speed_e_radps     = 300.0f;
            ticks(15U, 3);
            tick((uint16_t)word);
            TEST_ASSERT_TRUE(out.run == (ramps == 1));
            if (ramps == 1) {
                TEST_ASSERT_EQUAL_INT(APP_CONTROL_OPERATION_ENABLED, control.state);
                TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 299.8f, out.omega_e_radps);
                tick(15U); /* changed one's mind */
                TEST_ASSERT_TRUE(out.run);
                seen.speed_e_radps = 0.0f;
                tick((uint16_t)word);
            }
            tick((uint16_t)word);
            TEST_ASSERT_FALSE(out.run);
            TEST_ASSERT_EQUAL_INT(
                (word == 6) ? APP_CONTROL_READY_TO_SWITCH_ON : APP_CONTROL_SWITCHED, control.state);
        }
    }
}

static void test_the_state_is_left_when_the_bridge_has_opened(void)
{
    go(APP_CONTROL_OPERATION_ENABLED);
    wanted.controlword = 0U;
    for (int n = 0; n < 10; n++) { /* the modes brake first: too fast for an open bridge */
        app_control_tick(&control, &wanted, &seen, &out);
        TEST_ASSERT_FALSE(out.run);
        TEST_ASSERT_EQUAL_INT(APP_CONTROL_OPERATION_ENABLED, control.state);
        seen.mode = APP_MODE_STOP;
    }
    seen.mode = APP_MODE_READY;
    tick(0U);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_SWITCH_ON_DISABLED, control.state);
}

static void test_ramps(void)
{
    wanted.accel_e_radps2 = 2000.0f;
    wanted.decel_e_radps2 = 1000.0f;
    wanted.omega_e_radps  = -300.0f;
    seen.speed_e_radps    = -100.0f; /* turns already: begins there */
    go(APP_CONTROL_OPERATION_ENABLED);
    TEST_ASSERT_TRUE(out.omega_e_radps < -100.0f && out.omega_e_radps > -104.0f);
    float before = out.omega_e_radps;
    tick(15U);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, before - 0.4f, out.omega_e_radps);
    ticks(15U, 1000);
    TEST_ASSERT_TRUE(out.omega_e_radps == -300.0f);
    tick(15U | 256U); /* halt */
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, -299.8f, out.omega_e_radps);
    ticks(15U | 256U, 2000);
    TEST_ASSERT_TRUE((out.omega_e_radps == 0.0f) && out.run);
    wanted.omega_e_radps = 300.0f;
    tick(15U);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 0.4f, out.omega_e_radps);
    wanted.accel_e_radps2 = 0.0f; /* as fast as the drive can */
    tick(15U);
    TEST_ASSERT_TRUE(out.omega_e_radps == 300.0f);
}

static void test_modes_of_operation_and_the_limit(void)
{
    wanted.mode_of_operation = APP_CONTROL_FIND_ANGLE;
    wanted.current_max_A     = 0.75f * gain_tables_drive.current_max_A;
    go(APP_CONTROL_OPERATION_ENABLED);
    TEST_ASSERT_TRUE(out.align && !out.run && !out.commission && !control.done);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.25f, out.derating);
    seen.mode = APP_MODE_READY; /* found */
    ticks(15U, 3);
    TEST_ASSERT_TRUE(control.done && !out.align);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_OPERATION_ENABLED, control.state);
    ticks(6U, 2);
    wanted.mode_of_operation = APP_CONTROL_COMMISSIONING;
    ticks(15U, 2);
    TEST_ASSERT_TRUE(out.commission && !out.run && !out.align && !control.done);
    tick(0U);
    TEST_ASSERT_FALSE(out.commission);
    setUp();
    wanted.mode_of_operation = APP_CONTROL_COMMISSIONING;
    seen.mode                = APP_MODE_READY;
    ticks(6U, 3);
    tick(15U);
    seen.mode = APP_MODE_READY; /* its bounds were refused */
    ticks(15U, 2);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_SWITCHED, control.state);
    TEST_ASSERT_FALSE(control.done);
}

static void test_unknown_objects_are_refused(void)
{
    static const int modes[] = {-3, 0, 2, 5, 7, 11};
    static const int quick[] = {3, 4};
    TEST_ASSERT_TRUE(app_control_knows(&wanted, &gain_tables_drive));
    for (int i = 0; i < SUPPORT_COUNT(modes); i++) {
        app_objects_t o     = wanted;
        o.mode_of_operation = (int16_t)modes[i];
        TEST_ASSERT_FALSE(app_control_knows(&o, &gain_tables_drive));
    }
    for (int i = 0; i < SUPPORT_COUNT(quick); i++) {
        app_objects_t o = wanted;
        o.quick_option  = (int16_t)quick[i];
        TEST_ASSERT_FALSE(app_control_knows(&o, &gain_tables_drive));
    }
    drive_config_t drive     = gain_tables_drive;
    wanted.mode_of_operation = APP_CONTROL_PROFILE_POSITION;
    TEST_ASSERT_TRUE(app_control_knows(&wanted, &drive));
    drive.positions = false;
    TEST_ASSERT_FALSE(app_control_knows(&wanted, &drive));
    wanted.mode_of_operation = APP_CONTROL_CYCLIC_POSITION;
    TEST_ASSERT_FALSE(app_control_knows(&wanted, &drive));
    drive.positions = true;
    TEST_ASSERT_TRUE(app_control_knows(&wanted, &drive));
    static const int16_t torques[] = {APP_CONTROL_PROFILE_TORQUE, APP_CONTROL_CYCLIC_TORQUE};
    for (int i = 0; i < SUPPORT_COUNT(torques); i++) {
        wanted.mode_of_operation = torques[i];
        drive.torques            = true;
        TEST_ASSERT_TRUE(app_control_knows(&wanted, &drive));
        drive.torques = false;
        TEST_ASSERT_FALSE(app_control_knows(&wanted, &drive));
    }
    drive.current_max_A = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_control_init(&control, &board_config, &drive));
}

static void test_a_state_that_cannot_be_is_left(void)
{
    control.state = (app_control_state_t)77;
    seen.mode     = APP_MODE_READY;
    tick(15U);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_NOT_READY, control.state);
    TEST_ASSERT_FALSE(out.run);
}

static app_position_t position;
static app_angle_t    angle;

/* Enabled in profile position, on a shaft that is `counts` from its zero and turns at this speed. */
static void hold_position(int32_t counts, float speed_e_radps)
{
    const app_angle_t encoder = {
        .pole_pairs = 2U, .positions = 10000U, .rad_per_cnt = 1.2566371e-3f};

    angle = encoder;
    app_position_init(&position, &angle);
    position.known           = true;
    position.actual          = app_position_at(&position, counts);
    wanted.mode_of_operation = APP_CONTROL_PROFILE_POSITION;
    seen.position            = &position;
    seen.angle               = &angle;
    seen.speed_e_radps       = speed_e_radps;
    go(APP_CONTROL_OPERATION_ENABLED);
    ticks(APP_CONTROL_ENABLE_OPERATION, 2);
}

static int32_t wanted_cnt(void)
{
    return app_position_cnt(&position, &out.target);
}

static void test_profile_position_holds_and_takes_set_points(void)
{
    hold_position(777, 0.0f);
    TEST_ASSERT_TRUE(out.run && (out.follows == APP_FOLLOWS_POSITION));
    TEST_ASSERT_EQUAL_INT32(777, wanted_cnt());
    wanted.target_cnt = 5000;
    seen.arrived      = true;
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 1);
    TEST_ASSERT_EQUAL_INT32(5000, wanted_cnt());
    TEST_ASSERT_TRUE(control.setpoint.acknowledged);
}

static void test_positions_wait_until_the_zero_is_known(void)
{
    hold_position(777, 0.0f);
    seen.mode = APP_MODE_READY;
    ticks(0U, 3);
    position.known = false;
    go(APP_CONTROL_OPERATION_ENABLED);
    TEST_ASSERT_TRUE(out.run);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
    position.known = true;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_POSITION, out.follows);
}

static void test_lost_counts_end_a_position_run_as_a_quick_stop(void)
{
    hold_position(777, 100.0f);
    position.known = false;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_QUICK_STOP_ACTIVE, control.state);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
    TEST_ASSERT_TRUE(out.run);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
}

static void test_halt_and_stop_of_a_position_run_begin_at_the_present_speed(void)
{
    wanted.decel_e_radps2  = 1000.0f;
    wanted.quick_e_radps2  = 2000.0f;
    wanted.shutdown_option = 1;
    static const struct {
        int   word;
        float per_tick;
    } stops[] = {{APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_HALT, 1000.0f},
                 {APP_CONTROL_SHUT_DOWN, 1000.0f},
                 {APP_CONTROL_QUICK_STOP, 2000.0f}};
    for (int i = 0; i < SUPPORT_COUNT(stops); i++) {
        hold_position(777, 100.0f);
        TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_POSITION, out.follows);
        ticks((uint16_t)stops[i].word, 1);
        TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
        TEST_ASSERT_TRUE(out.run);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f - (gain_tables_drive.ts_s * stops[i].per_tick),
                                 out.omega_e_radps);
        if (i == 0) { /* and on to the target */
            ticks(APP_CONTROL_ENABLE_OPERATION, 1);
            TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_POSITION, out.follows);
            TEST_ASSERT_EQUAL_INT32(777, wanted_cnt());
        }
        setUp();
        wanted.decel_e_radps2  = 1000.0f;
        wanted.quick_e_radps2  = 2000.0f;
        wanted.shutdown_option = 1;
    }
}

/* Enabled in this torque mode, on a shaft that turns at this speed. */
static void follow_torque(int16_t mode, float speed_e_radps)
{
    wanted.mode_of_operation = mode;
    seen.speed_e_radps       = speed_e_radps;
    go(APP_CONTROL_OPERATION_ENABLED);
    ticks(APP_CONTROL_ENABLE_OPERATION, 2);
}

static void test_profile_torque_has_a_slope_and_cyclic_torque_an_offset(void)
{
    wanted.torque_share     = 0.5f;
    wanted.torque_offset    = 0.25f;
    wanted.torque_slope_1ps = 2.0f;
    follow_torque(APP_CONTROL_PROFILE_TORQUE, 10.0f);
    TEST_ASSERT_TRUE(out.run);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_TORQUE, out.follows);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.5f, out.torque_share);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-9f, 2.0f * gain_tables_drive.ts_s, out.torque_step);
    wanted.torque_slope_1ps = 0.0f;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_TRUE(out.torque_step > (2.0f * TORQUE_SHARE_MAX));
    wanted.torque_slope_1ps  = 2.0f;
    wanted.mode_of_operation = APP_CONTROL_CYCLIC_TORQUE;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.75f, out.torque_share);
    TEST_ASSERT_TRUE(out.torque_step > (2.0f * TORQUE_SHARE_MAX));
}

static void test_limits_of_a_torque(void)
{
    const float most_e_radps = gain_tables_drive.speed_max_e_radps;

    wanted.torque_share  = -20.0f;
    wanted.torque_offset = -30.0f;
    follow_torque(APP_CONTROL_CYCLIC_TORQUE, 0.0f);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, -TORQUE_SHARE_MAX, out.torque_share);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, most_e_radps, out.torque_speed_max_e_radps);
    wanted.torque_most              = 0.75f;
    wanted.torque_speed_max_e_radps = 50.0f;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, -0.75f, out.torque_share);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 50.0f, out.torque_speed_max_e_radps);
    wanted.torque_speed_max_e_radps = 1.0e6f; /* beyond the drive's; 0 and below are the drive's */
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, most_e_radps, out.torque_speed_max_e_radps);
}

static void test_halt_and_stop_of_a_torque_run_begin_at_the_present_speed(void)
{
    static const int stops[] = {APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_HALT,
                                APP_CONTROL_SHUT_DOWN, APP_CONTROL_QUICK_STOP};

    for (int i = 0; i < SUPPORT_COUNT(stops); i++) {
        setUp();
        wanted.decel_e_radps2  = 1000.0f;
        wanted.quick_e_radps2  = 1000.0f;
        wanted.shutdown_option = 1;
        wanted.omega_e_radps   = 300.0f; /* of another mode: it is not the goal */
        follow_torque(APP_CONTROL_PROFILE_TORQUE, 100.0f);
        TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_TORQUE, out.follows);
        ticks((uint16_t)stops[i], 1);
        TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
        TEST_ASSERT_TRUE(out.run);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f - (gain_tables_drive.ts_s * 1000.0f),
                                 out.omega_e_radps);
        ticks((uint16_t)stops[i], 600);
        TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
    }
}

static void test_a_shaft_beyond_the_largest_speed_leaves_the_reference_within_it(void)
{
    follow_torque(APP_CONTROL_CYCLIC_TORQUE, 1.1f * gain_tables_drive.speed_max_e_radps);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, gain_tables_drive.speed_max_e_radps, out.omega_e_radps);
}

/* Each of the seven, from each, without a tick in which the bridge would open. */
static void test_runs_change_into_each_other_while_enabled(void)
{
    static const struct {
        int16_t       mode;
        app_follows_t follows;
    } runs[] = {{APP_CONTROL_PROFILE_POSITION, APP_FOLLOWS_POSITION},
                {APP_CONTROL_PROFILE_VELOCITY, APP_FOLLOWS_SPEED},
                {APP_CONTROL_CYCLIC_POSITION, APP_FOLLOWS_PATH},
                {APP_CONTROL_CYCLIC_VELOCITY, APP_FOLLOWS_SPEED},
                {APP_CONTROL_PROFILE_TORQUE, APP_FOLLOWS_TORQUE},
                {APP_CONTROL_CYCLIC_TORQUE, APP_FOLLOWS_TORQUE},
                {APP_CONTROL_HOMING, APP_FOLLOWS_SPEED}};

    for (int from = 0; from < SUPPORT_COUNT(runs); from++) {
        for (int to = 0; to < SUPPORT_COUNT(runs); to++) {
            setUp();
            hold_position(777, 0.0f);
            wanted.mode_of_operation = runs[from].mode;
            ticks(APP_CONTROL_ENABLE_OPERATION, 2);
            TEST_ASSERT_EQUAL_INT(runs[from].follows, out.follows);
            wanted.mode_of_operation = runs[to].mode;
            wanted.omega_e_radps     = 200.0f;
            wanted.interpolation_s   = 1.0e-4f; /* below a period: a step */
            for (int n = 0; n < 3; n++) {
                ticks(APP_CONTROL_ENABLE_OPERATION, 1);
                TEST_ASSERT_TRUE(out.run);
                TEST_ASSERT_EQUAL_INT(runs[to].follows, out.follows);
                TEST_ASSERT_EQUAL_INT(runs[to].mode, control.mode);
            }
            const bool goes =
                (runs[to].follows == APP_FOLLOWS_SPEED) && (runs[to].mode != APP_CONTROL_HOMING);
            TEST_ASSERT_FLOAT_WITHIN(0.0f, goes ? 200.0f : 0.0f, out.omega_e_radps);
        }
    }
}

/* Every write of the target is a set-point, and one that was written before is none. */
static void test_cyclic_position_takes_what_is_written_while_it_runs(void)
{
    wanted.target_cnt    = 5000;
    wanted.target_number = 3U;
    hold_position(777, 0.0f);
    wanted.mode_of_operation = APP_CONTROL_CYCLIC_POSITION;
    ticks(APP_CONTROL_ENABLE_OPERATION, 2);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_PATH, out.follows);
    TEST_ASSERT_TRUE(out.path == &control.path);
    TEST_ASSERT_FALSE(control.path.aim.fresh);
    wanted.target_number        = 4U;
    wanted.offset_cnt           = -40;
    wanted.following_window_cnt = 100U;
    wanted.following_s          = 0.25f;
    wanted.interpolation_s      = 0.02f;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_TRUE(control.path.aim.fresh);
    TEST_ASSERT_EQUAL_INT32(4960, app_position_cnt(seen.position, &control.path.aim.point.at));
    TEST_ASSERT_FALSE(control.path.aim.point.given);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-4f, 100.0f * seen.position->rad_per_cnt,
                             control.path.aim.window_rad);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.25f, control.path.aim.time_out_s);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.02f, control.path.aim.track.period_s);
    control.path.aim.fresh = false; /* as a tick of the path does */
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_FALSE(control.path.aim.fresh);
    for (int n = 0; n < 2; n++) { /* a speed, and the zero after it */
        wanted.omega_offset_e_radps = (n == 0) ? 12.0f : 0.0f;
        wanted.target_number        = (uint16_t)(wanted.target_number + 1U);
        ticks(APP_CONTROL_ENABLE_OPERATION, 1);
        TEST_ASSERT_TRUE(control.path.aim.point.given);
        TEST_ASSERT_FLOAT_WITHIN(0.0f, wanted.omega_offset_e_radps,
                                 control.path.aim.point.omega_e_radps);
    }
    control.path.begun = true;
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_HALT, 1);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
    TEST_ASSERT_FALSE(control.path.begun);
}

static void test_set_points_of_a_path_keep_within_the_limits(void)
{
    static const int32_t asked[3] = {5000, 900, -5000};
    static const int32_t kept[3]  = {1000, 900, -200};

    hold_position(777, 0.0f);
    wanted.mode_of_operation = APP_CONTROL_CYCLIC_POSITION;
    wanted.limits            = true;
    wanted.least_cnt         = -200;
    wanted.most_cnt          = 1000;
    ticks(APP_CONTROL_ENABLE_OPERATION, 2);
    for (int n = 0; n < 3; n++) {
        wanted.target_cnt    = asked[n] - 7;
        wanted.offset_cnt    = 7; /* the sum is limited */
        wanted.target_number = (uint16_t)(wanted.target_number + 1U);
        ticks(APP_CONTROL_ENABLE_OPERATION, 1);
        TEST_ASSERT_EQUAL_INT32(kept[n],
                                app_position_cnt(seen.position, &control.path.aim.point.at));
        TEST_ASSERT_EQUAL_INT(asked[n] != kept[n], control.limited);
    }
}

static void test_an_operator_may_lower_the_jerk_of_a_path(void)
{
    hold_position(777, 0.0f);
    wanted.mode_of_operation = APP_CONTROL_CYCLIC_POSITION;
    ticks(APP_CONTROL_ENABLE_OPERATION, 2);
    const float most = control.path.aim.jerk_e_radps3;
    TEST_ASSERT_TRUE(most > 0.0f);
    wanted.jerk_e_radps3 = 0.5f * most;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_FLOAT_WITHIN(1.0f, 0.5f * most, control.path.aim.jerk_e_radps3);
    wanted.jerk_e_radps3 = 2.0f * most;
    ticks(APP_CONTROL_ENABLE_OPERATION, 1);
    TEST_ASSERT_FLOAT_WITHIN(1.0f, most, control.path.aim.jerk_e_radps3);
}

/* Lines from set-point to set-point, each a share of the way in every period. */
static void test_cyclic_velocity_reaches_a_set_point_after_the_interpolation_period(void)
{
    const int periods = 50;

    wanted.mode_of_operation    = APP_CONTROL_CYCLIC_VELOCITY;
    wanted.interpolation_s      = (float)periods * gain_tables_drive.ts_s;
    wanted.accel_e_radps2       = 1.0f; /* of profile velocity */
    wanted.omega_e_radps        = 60.0f;
    wanted.omega_offset_e_radps = 40.0f;
    seen.speed_e_radps          = 20.0f;
    seen.mode                   = APP_MODE_READY;
    ticks(APP_CONTROL_SHUT_DOWN, 3);
    ticks(APP_CONTROL_ENABLE_OPERATION, 1); /* begins at the speed that there is */
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 20.0f, out.omega_e_radps);
    for (int n = 1; n <= periods; n++) {
        ticks(APP_CONTROL_ENABLE_OPERATION, 1);
        TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 20.0f + (80.0f * (float)n / (float)periods),
                                 out.omega_e_radps);
    }
    ticks(APP_CONTROL_ENABLE_OPERATION, 10); /* none comes: it stays */
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f, out.omega_e_radps);
    wanted.omega_e_radps = -60.0f;
    ticks(APP_CONTROL_ENABLE_OPERATION, periods / 2);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 40.0f, out.omega_e_radps);
    wanted.omega_e_radps = 0.0f; /* early: from where it is */
    ticks(APP_CONTROL_ENABLE_OPERATION, periods / 2);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 40.0f, out.omega_e_radps);
    wanted.omega_e_radps = 1.0e6f; /* the sum is limited */
    ticks(APP_CONTROL_ENABLE_OPERATION, periods);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-2f, gain_tables_drive.speed_max_e_radps, out.omega_e_radps);
}

static void test_halt_of_a_cyclic_velocity_has_the_ramp_and_ends_on_a_line(void)
{
    const float ts_s = gain_tables_drive.ts_s;

    wanted.mode_of_operation = APP_CONTROL_CYCLIC_VELOCITY;
    wanted.interpolation_s   = 10.0f * ts_s;
    wanted.decel_e_radps2    = 1000.0f;
    wanted.omega_e_radps     = 100.0f;
    go(APP_CONTROL_OPERATION_ENABLED);
    ticks(APP_CONTROL_ENABLE_OPERATION, 12);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f, out.omega_e_radps);
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_HALT, 5);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f - (5.0f * ts_s * 1000.0f), out.omega_e_radps);
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_HALT, 600);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
    ticks(APP_CONTROL_ENABLE_OPERATION, 5);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 50.0f, out.omega_e_radps);
}

static void test_a_mode_that_is_no_run_waits_for_the_next_start(void)
{
    static const int16_t modes[] = {APP_CONTROL_FIND_ANGLE, APP_CONTROL_COMMISSIONING};

    for (int i = 0; i < SUPPORT_COUNT(modes); i++) {
        setUp();
        go(APP_CONTROL_OPERATION_ENABLED);
        wanted.mode_of_operation = modes[i];
        ticks(APP_CONTROL_ENABLE_OPERATION, 5);
        TEST_ASSERT_TRUE(out.run && !out.align && !out.commission);
        TEST_ASSERT_EQUAL_INT(APP_CONTROL_PROFILE_VELOCITY, control.mode);
        ticks(APP_CONTROL_SHUT_DOWN, 5);
        ticks(APP_CONTROL_ENABLE_OPERATION, 2);
        TEST_ASSERT_EQUAL_INT(modes[i], control.mode);
        TEST_ASSERT_FALSE(out.run);
        wanted.mode_of_operation = APP_CONTROL_CYCLIC_TORQUE; /* nor does it become a run */
        ticks(APP_CONTROL_ENABLE_OPERATION, 2);
        TEST_ASSERT_EQUAL_INT(modes[i], control.mode);
        TEST_ASSERT_FALSE(out.run);
    }
}

/* Homing holds zero speed, moves along its own ramp, and waits while it is halted. */
static void test_homing_is_a_run_of_its_own(void)
{
    hold_position(777, 0.0f);
    wanted.mode_of_operation     = APP_CONTROL_HOMING;
    wanted.homing_method         = 34;
    wanted.homing_zero_e_radps   = 10.0f;
    wanted.homing_accel_e_radps2 = 1000.0f;
    wanted.accel_e_radps2        = 7.0f; /* of other modes */
    ticks(APP_CONTROL_ENABLE_OPERATION, 3);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
    TEST_ASSERT_TRUE(out.run && !out.align);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
    tick(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT);
    TEST_ASSERT_EQUAL_INT(APP_HOMING_INDEX, control.homing.stage);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 1000.0f * gain_tables_drive.ts_s, out.omega_e_radps);
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 200);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 10.0f, out.omega_e_radps);
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT | APP_CONTROL_HALT, 2000);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
    TEST_ASSERT_EQUAL_INT(APP_HOMING_INDEX, control.homing.stage);
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 200);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 10.0f, out.omega_e_radps);
    wanted.mode_of_operation =
        APP_CONTROL_PROFILE_VELOCITY; /* and back: it has to be asked again */
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 2);
    wanted.mode_of_operation = APP_CONTROL_HOMING;
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 2);
    TEST_ASSERT_EQUAL_INT(APP_HOMING_IDLE, control.homing.stage);
}

static void test_a_switch_that_is_no_longer_used_lets_a_speed_go_on(void)
{
    hold_position(777, 0.0f);
    wanted.mode_of_operation = APP_CONTROL_PROFILE_VELOCITY;
    wanted.inputs_used       = BOARD_INPUT_POSITIVE;
    wanted.omega_e_radps     = 100.0f;
    seen.inputs              = BOARD_INPUT_POSITIVE;
    ticks(APP_CONTROL_ENABLE_OPERATION, 100);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
    wanted.inputs_used = 0U;
    ticks(APP_CONTROL_ENABLE_OPERATION, 100);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f, out.omega_e_radps);
}

/* The reference is zero and the run goes on, whatever the mode; then the mode has it. */
static void test_no_mode_moves_a_shaft_that_the_brake_may_hold(void)
{
    static const int16_t modes[] = {APP_CONTROL_PROFILE_POSITION, APP_CONTROL_PROFILE_VELOCITY,
                                    APP_CONTROL_PROFILE_TORQUE,   APP_CONTROL_HOMING,
                                    APP_CONTROL_CYCLIC_POSITION,  APP_CONTROL_CYCLIC_VELOCITY,
                                    APP_CONTROL_CYCLIC_TORQUE};

    for (int i = 0; i < SUPPORT_COUNT(modes); i++) {
        hold_position(777, 0.0f);
        wanted.homing_method       = 34;
        wanted.homing_zero_e_radps = 10.0f;
        wanted.omega_e_radps       = 100.0f;
        wanted.torque_share        = 0.5f;
        wanted.mode_of_operation   = modes[i];
        control.braked             = true;
        ticks(APP_CONTROL_ENABLE_OPERATION, 3);
        wanted.target_cnt = 10000L;
        wanted.target_number++;
        for (int n = 0; n < 100; n++) {
            tick(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT);
            TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
            TEST_ASSERT_FLOAT_WITHIN(0.0f, 0.0f, out.omega_e_radps);
            TEST_ASSERT_TRUE(out.run);
        }
        TEST_ASSERT_FALSE(app_homing_moves(control.homing.stage));
        control.braked = false;
        ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 100);
        const bool speed = (modes[i] == APP_CONTROL_HOMING) || app_control_is_speed(modes[i]);
        TEST_ASSERT_EQUAL_INT(speed, out.follows == APP_FOLLOWS_SPEED);
        TEST_ASSERT_EQUAL_INT(speed, out.omega_e_radps > 1.0f);
        setUp();
    }
}

/* Motor's sense of what a run is asked for, by mode of operation. */
static void ask_for(int16_t mode, int way)
{
    wanted.mode_of_operation = mode;
    wanted.omega_e_radps     = 100.0f * (float)way;
    wanted.torque_share      = 0.2f * (float)way;
    wanted.target_cnt        = 777 + (5000 * way);
    wanted.target_number     = (uint16_t)(wanted.target_number + 1U);
}

static void test_an_active_limit_switch_stops_the_motion_towards_it(void)
{
    static const int16_t modes[]   = {APP_CONTROL_PROFILE_VELOCITY, APP_CONTROL_CYCLIC_VELOCITY,
                                      APP_CONTROL_PROFILE_POSITION, APP_CONTROL_CYCLIC_POSITION,
                                      APP_CONTROL_PROFILE_TORQUE,   APP_CONTROL_CYCLIC_TORQUE};
    static const int     inputs[2] = {BOARD_INPUT_NEGATIVE, BOARD_INPUT_POSITIVE};

    for (int i = 0; i < SUPPORT_COUNT(modes); i++) {
        for (int n = 0; n < 16; n++) {
            const int  way      = ((n & 1) != 0) ? 1 : -1;
            const bool reversed = (n & 2) != 0;
            const int  input    = inputs[((n & 4) != 0) ? 1 : 0];
            const bool used     = (n & 8) != 0;
            const int  user     = reversed ? -way : way;
            const bool ahead    = used && (input == inputs[(user > 0) ? 1 : 0]);

            setUp();
            hold_position(777, 0.0f);
            wanted.reversed        = reversed;
            wanted.torque_most     = 1.0f;
            wanted.interpolation_s = 1.0e-4f;
            ask_for(modes[i], way);
            ticks(APP_CONTROL_ENABLE_OPERATION, 3);
            wanted.target_number++;
            ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT | APP_CONTROL_AT_ONCE, 2);
            const app_follows_t follows = out.follows;
            wanted.inputs_used          = used ? 3U : 0U;
            seen.inputs                 = (uint16_t)input;
            ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 3);
            TEST_ASSERT_EQUAL_INT(ahead, control.blocked);
            TEST_ASSERT_EQUAL_INT(ahead ? APP_FOLLOWS_SPEED : follows, out.follows);
            if (ahead || app_control_is_speed(modes[i])) {
                TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, ahead ? 0.0f : (100.0f * (float)way),
                                         out.omega_e_radps);
            }
            TEST_ASSERT_TRUE(out.run);
            TEST_ASSERT_EQUAL_INT(APP_CONTROL_OPERATION_ENABLED, control.state);
        }
    }
}

/* A set-point beyond the switch is given up, and the next one leads away. */
static void test_a_set_point_leads_away_from_a_limit_switch(void)
{
    hold_position(777, 0.0f);
    wanted.target_cnt = 5777;
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT | APP_CONTROL_AT_ONCE, 2);
    wanted.inputs_used = 3U;
    seen.inputs        = BOARD_INPUT_POSITIVE;
    ticks(APP_CONTROL_ENABLE_OPERATION, 3);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_SPEED, out.follows);
    wanted.target_cnt = 500;
    ticks(APP_CONTROL_ENABLE_OPERATION | APP_CONTROL_NEW_SETPOINT, 3);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_POSITION, out.follows);
    TEST_ASSERT_EQUAL_INT32(500, wanted_cnt());
    position.actual = app_position_at(&position, 500 - 3); /* it holds the shaft there */
    ticks(APP_CONTROL_ENABLE_OPERATION, 3);
    TEST_ASSERT_EQUAL_INT(APP_FOLLOWS_POSITION, out.follows);
}

static void test_a_limit_switch_stops_with_the_quick_deceleration(void)
{
    hold_position(777, 0.0f);
    wanted.mode_of_operation = APP_CONTROL_PROFILE_VELOCITY;
    wanted.omega_e_radps     = 100.0f;
    ticks(APP_CONTROL_ENABLE_OPERATION, 3);
    wanted.inputs_used     = 3U;
    wanted.inputs_inverted = 2U; /* low is active */
    wanted.decel_e_radps2  = 1.0f;
    wanted.quick_e_radps2  = 5000.0f;
    seen.inputs            = 2U;
    ticks(APP_CONTROL_ENABLE_OPERATION, 5);
    TEST_ASSERT_FLOAT_WITHIN(0.0f, 100.0f, out.omega_e_radps);
    seen.inputs = 0U;
    ticks(APP_CONTROL_ENABLE_OPERATION, 5);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f - (5.0f * 5000.0f * gain_tables_drive.ts_s),
                             out.omega_e_radps);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_profile_position_holds_and_takes_set_points);
    RUN_TEST(test_positions_wait_until_the_zero_is_known);
    RUN_TEST(test_lost_counts_end_a_position_run_as_a_quick_stop);
    RUN_TEST(test_halt_and_stop_of_a_position_run_begin_at_the_present_speed);
    RUN_TEST(test_profile_torque_has_a_slope_and_cyclic_torque_an_offset);
    RUN_TEST(test_limits_of_a_torque);
    RUN_TEST(test_halt_and_stop_of_a_torque_run_begin_at_the_present_speed);
    RUN_TEST(test_a_shaft_beyond_the_largest_speed_leaves_the_reference_within_it);
    RUN_TEST(test_runs_change_into_each_other_while_enabled);
    RUN_TEST(test_homing_is_a_run_of_its_own);
    RUN_TEST(test_an_active_limit_switch_stops_the_motion_towards_it);
    RUN_TEST(test_a_limit_switch_stops_with_the_quick_deceleration);
    RUN_TEST(test_a_switch_that_is_no_longer_used_lets_a_speed_go_on);
    RUN_TEST(test_no_mode_moves_a_shaft_that_the_brake_may_hold);
    RUN_TEST(test_a_set_point_leads_away_from_a_limit_switch);
    RUN_TEST(test_cyclic_position_takes_what_is_written_while_it_runs);
    RUN_TEST(test_set_points_of_a_path_keep_within_the_limits);
    RUN_TEST(test_an_operator_may_lower_the_jerk_of_a_path);
    RUN_TEST(test_cyclic_velocity_reaches_a_set_point_after_the_interpolation_period);
    RUN_TEST(test_halt_of_a_cyclic_velocity_has_the_ramp_and_ends_on_a_line);
    RUN_TEST(test_a_mode_that_is_no_run_waits_for_the_next_start);
    RUN_TEST(test_every_transition_and_no_other);
    RUN_TEST(test_boot_leads_to_switch_on_disabled_whatever_is_asked);
    RUN_TEST(test_operation_is_enabled_by_a_rising_bit_only);
    RUN_TEST(test_a_run_that_does_not_begin_or_ends_leaves_the_state);
    RUN_TEST(test_a_fault_wins_over_every_control_word);
    RUN_TEST(test_reset_acts_when_its_bit_rises);
    RUN_TEST(test_a_reset_that_is_there_at_the_start_is_no_edge);
    RUN_TEST(test_a_reset_that_rose_in_a_run_does_not_end_a_later_fault);
    RUN_TEST(test_a_steady_run_asks_for_nothing_else);
    RUN_TEST(test_quick_stop_options);
    RUN_TEST(test_stop_options);
    RUN_TEST(test_the_state_is_left_when_the_bridge_has_opened);
    RUN_TEST(test_ramps);
    RUN_TEST(test_modes_of_operation_and_the_limit);
    RUN_TEST(test_unknown_objects_are_refused);
    RUN_TEST(test_a_state_that_cannot_be_is_left);
    return UNITY_END();
}
