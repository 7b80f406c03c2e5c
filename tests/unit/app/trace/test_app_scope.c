/* SPDX-License-Identifier: MIT */
#include "app_scope.h"

#include <string.h>

#include "unit_support.h"
#include "unity.h"

static app_scope_t       scope;
static app_modes_t       modes;
static app_command_t     command;
static bridge_t          out;
static app_scope_view_t  view = {.modes = &modes, .command = &command, .out = &out};
static app_scope_setup_t setup;
static float (*wave)(uint32_t tick);

static float saw(uint32_t tick)
{
    return (float)(tick % 1000UL);
}

static float falling_saw(uint32_t tick)
{
    return -saw(tick);
}

void setUp(void)
{
    const app_scope_setup_t first = {
        .signal     = {APP_SCOPE_SPEED_WANTED, APP_SCOPE_IA, APP_SCOPE_DUTY_C, APP_SCOPE_NONE},
        .decimation = 1U};
    (void)memset(&scope, 0xFF, sizeof scope); /* init has to set everything but the samples */
    (void)memset(&modes, 0, sizeof modes);
    app_scope_init(&scope);
    setup = first;
    wave  = saw;
}

void tearDown(void) {}

static void tick(void)
{
    modes.ticks++;
    command.omega_e_radps = wave(modes.ticks);
    modes.sample.ia_A     = -(float)modes.ticks;
    out.duty.c            = 0.25f;
    app_scope_tick(&scope, &view);
}

/* Ticks until it is done; how many. */
static int until_done(int most)
{
    int n = 0;
    for (; (n < most) && (scope.state != APP_SCOPE_DONE); n++) {
        tick();
    }
    return n;
}

static void test_takes_nothing_before_it_is_armed(void)
{
    for (int n = 0; n < 2000; n++) {
        tick();
    }
    TEST_ASSERT_EQUAL_INT(APP_SCOPE_IDLE, scope.state);
    TEST_ASSERT_EQUAL_UINT(0U, scope.count);
}

static void test_takes_at_once_what_follows(void)
{
    app_scope_arm(&scope, &setup);
    TEST_ASSERT_EQUAL_INT(512, until_done(10000));
    for (uint16_t k = 0U; k < 512U; k++) {
        TEST_ASSERT_TRUE(app_scope_read(&scope, k, 0U) == saw(k + 1U));
        TEST_ASSERT_TRUE(app_scope_read(&scope, k, 1U) == -(float)(k + 1U));
        TEST_ASSERT_TRUE(app_scope_read(&scope, k, 2U) == 0.25f);
        TEST_ASSERT_TRUE(app_scope_read(&scope, k, 3U) == 0.0f);
    }
    TEST_ASSERT_EQUAL_UINT(1U, (unsigned)scope.trigger_ticks);
    for (int n = 0; n < 600; n++) { /* and stays */
        tick();
    }
    TEST_ASSERT_TRUE(app_scope_read(&scope, 0U, 1U) == -1.0f);
}

/* Every place of the trigger, both edges, decimated or not: the sample there has passed the level, the one before has not. */
static void test_the_trigger_stands_where_it_was_asked_for(void)
{
    static const int befores[]     = {0, 1, 2, 100, 255, 510, 511};
    static const int decimations[] = {1, 2, 7};
    for (int b = 0; b < SUPPORT_COUNT(befores); b++) {
        for (int d = 0; d < SUPPORT_COUNT(decimations); d++) {
            for (int edge = APP_SCOPE_RISING; edge <= APP_SCOPE_FALLING; edge++) {
                setUp();
                wave             = (edge == APP_SCOPE_RISING) ? saw : falling_saw;
                setup.before     = (uint16_t)befores[b];
                setup.decimation = (uint16_t)decimations[d];
                setup.trigger    = (uint16_t)edge;
                setup.level      = (edge == APP_SCOPE_RISING) ? 300.5f : -300.5f;
                app_scope_arm(&scope, &setup);
                TEST_ASSERT_TRUE(until_done(20000) < 20000);
                const uint16_t at  = setup.before;
                const float    now = app_scope_read(&scope, at, 0U);
                TEST_ASSERT_TRUE((edge == APP_SCOPE_RISING) ? (now >= 300.5f) : (now <= -300.5f));
                TEST_ASSERT_TRUE(fabsf(now) < 300.5f + (float)decimations[d]);
                TEST_ASSERT_TRUE(app_scope_read(&scope, at, 1U) == -(float)scope.trigger_ticks);
                for (uint16_t k = 1U; k < 512U; k++) { /* no gap, none twice */
                    TEST_ASSERT_TRUE(app_scope_read(&scope, (uint16_t)(k - 1U), 1U) -
                                         app_scope_read(&scope, k, 1U) ==
                                     (float)decimations[d]);
                }
            }
        }
    }
}

static void test_waits_for_a_level_that_does_not_come(void)
{
    setup.trigger = APP_SCOPE_RISING;
    setup.level   = 2000.0f;
    setup.before  = 10U;
    app_scope_arm(&scope, &setup);
    for (int n = 0; n < 10; n++) {
        tick();
        TEST_ASSERT_EQUAL_INT(APP_SCOPE_FILLS, scope.state);
    }
    TEST_ASSERT_EQUAL_INT(5000, until_done(5000));
    TEST_ASSERT_EQUAL_INT(APP_SCOPE_WAITS, scope.state);
    app_scope_stop(&scope);
    for (int n = 0; n < 1000; n++) {
        tick();
    }
    TEST_ASSERT_EQUAL_INT(APP_SCOPE_IDLE, scope.state);
}

static float not_a_number(uint32_t tick)
{
    (void)tick;
    return NAN;
}

static void test_no_number_triggers_nothing(void)
{
    setup.trigger = APP_SCOPE_FALLING;
    wave          = not_a_number;
    app_scope_arm(&scope, &setup);
    TEST_ASSERT_EQUAL_INT(3000, until_done(3000));
}

static void test_can_be_armed_again_at_any_time(void)
{
    setup.trigger = APP_SCOPE_RISING;
    setup.level   = 500.5f;
    setup.before  = 200U;
    for (int n = 1; n < 900; n += 37) {
        app_scope_arm(&scope, &setup);
        for (int k = 0; k < n; k++) {
            tick();
        }
        app_scope_arm(&scope, &setup);
        (void)until_done(20000);
        TEST_ASSERT_EQUAL_INT(APP_SCOPE_DONE, scope.state);
        TEST_ASSERT_TRUE(app_scope_read(&scope, 200U, 0U) == 501.0f);
        TEST_ASSERT_TRUE(app_scope_read(&scope, 0U, 0U) == 301.0f);
    }
}

/* Samples from before the arming do not count for the level crossing. */
static void test_the_first_sample_has_none_before_it(void)
{
    setup.trigger = APP_SCOPE_RISING;
    setup.level   = 500.5f;
    app_scope_arm(&scope, &setup);
    while (modes.ticks < 400UL) {
        tick();
    }
    app_scope_stop(&scope);
    while (modes.ticks < 600UL) {
        tick();
    }
    app_scope_arm(&scope, &setup);
    tick();
    TEST_ASSERT_EQUAL_INT(APP_SCOPE_WAITS, scope.state);
}

static void test_settings_that_are_none_are_refused(void)
{
    TEST_ASSERT_TRUE(app_scope_knows(&setup));
    setup.decimation = 0U;
    TEST_ASSERT_FALSE(app_scope_knows(&setup));
    setup.decimation = 65535U;
    setup.trigger    = 3U;
    TEST_ASSERT_FALSE(app_scope_knows(&setup));
    setup.trigger = 2U;
    setup.channel = 4U;
    TEST_ASSERT_FALSE(app_scope_knows(&setup));
    setup.channel = 3U;
    setup.before  = 512U;
    TEST_ASSERT_FALSE(app_scope_knows(&setup));
    setup.before    = 511U;
    setup.signal[3] = APP_SCOPE_SIGNALS;
    TEST_ASSERT_FALSE(app_scope_knows(&setup));
    setup.signal[3] = APP_SCOPE_SIGNALS - 1;
    TEST_ASSERT_TRUE(app_scope_knows(&setup));
}

/* Each signal is what its name says: members that differ. */
static void test_signals_are_what_they_are_called(void)
{
    modes.drive.state                    = DRIVE_RUN;
    modes.drive.answer.now.omega_e_radps = 1.0f;
    modes.reading.omega_e_radps          = 2.0f;
    command.omega_e_radps                = 3.0f;
    modes.drive.answer.now.iq_A          = 4.0f;
    modes.drive.answer.now.id_A          = 5.0f;
    modes.drive.answer.i_ref_A.q         = 6.0f;
    modes.drive.answer.i_ref_A.d         = 7.0f;
    modes.drive.v_V.q                    = 8.0f;
    modes.drive.v_V.d                    = 9.0f;
    modes.sample.ia_A                    = 10.0f;
    modes.sample.ib_A                    = 11.0f;
    modes.sample.dc_link_V               = 12.0f;
    modes.reading.theta_e_rad            = 13.0f;
    out.duty.a                           = 14.0f;
    out.duty.b                           = 15.0f;
    out.duty.c                           = 16.0f;
    modes.drive.answer.d_omega           = 17.0f;
    modes.mode                           = APP_MODE_FAULT; /* 5 */
    for (uint16_t k = 0U; k < 18U; k++) {
        TEST_ASSERT_TRUE(app_scope_signals_value(&view, k) == (float)k);
    }
    TEST_ASSERT_TRUE(app_scope_signals_value(&view, APP_SCOPE_MODE) == 5.0f);
    TEST_ASSERT_TRUE(app_scope_signals_value(&view, APP_SCOPE_SIGNALS) == 0.0f);
    modes.drive.state = DRIVE_OFF;
    TEST_ASSERT_TRUE(app_scope_signals_value(&view, APP_SCOPE_SPEED) == 2.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_takes_nothing_before_it_is_armed);
    RUN_TEST(test_takes_at_once_what_follows);
    RUN_TEST(test_the_trigger_stands_where_it_was_asked_for);
    RUN_TEST(test_waits_for_a_level_that_does_not_come);
    RUN_TEST(test_no_number_triggers_nothing);
    RUN_TEST(test_can_be_armed_again_at_any_time);
    RUN_TEST(test_the_first_sample_has_none_before_it);
    RUN_TEST(test_settings_that_are_none_are_refused);
    RUN_TEST(test_signals_are_what_they_are_called);
    return UNITY_END();
}
