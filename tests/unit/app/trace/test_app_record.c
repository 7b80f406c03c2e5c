/* SPDX-License-Identifier: MIT */
#include "app_record.h"

#include <string.h>

#include "app_traces.h"
#include "unit_support.h"
#include "unity.h"

static app_record_t     record;
static app_scope_t      scope;
static app_modes_t      modes;
static app_command_t    command;
static bridge_t         out;
static app_scope_view_t view = {.modes = &modes, .command = &command, .out = &out};

void setUp(void)
{
    (void)memset(&record, 0xFF, sizeof record);
    (void)memset(&modes, 0, sizeof modes);
    app_record_init(&record);
    app_scope_init(&scope);
    modes.mode = APP_MODE_RUN;
}

void tearDown(void) {}

static void ticks(int count)
{
    for (int n = 0; n < count; n++) {
        modes.ticks++;
        modes.sample.ia_A = (float)modes.ticks;
        out.duty.c        = -(float)modes.ticks;
        app_record_tick(&record, &view);
    }
}

static void fault(int count)
{
    modes.mode = APP_MODE_FAULT;
    ticks(count);
    modes.mode = APP_MODE_READY;
}

/* The tick of the fault is the last. */
static void assert_kept(int count, uint32_t last)
{
    TEST_ASSERT_EQUAL_INT(count, record.kept_count);
    for (int k = 0; k < count; k++) {
        const float want = (float)(last - (uint32_t)(count - 1 - k));
        TEST_ASSERT_TRUE(app_record_read(&record, (uint16_t)k, 0U) == want);
        TEST_ASSERT_TRUE(app_record_read(&record, (uint16_t)k, 6U) == -want);
    }
}

static void test_there_is_none_before_a_fault(void)
{
    ticks(1000);
    TEST_ASSERT_EQUAL_INT(0, record.kept_count);
    TEST_ASSERT_EQUAL_INT(0, record.number);
}

static void test_the_last_ticks_are_kept_until_the_next_fault(void)
{
    ticks(999);
    fault(1);
    assert_kept(64, 1000UL);
    fault(500);
    ticks(700); /* reset, and on */
    assert_kept(64, 1000UL);
    TEST_ASSERT_EQUAL_INT(1, record.number);
}

static void test_a_fault_that_lasts_is_one(void)
{
    ticks(999);
    modes.mode = APP_MODE_FAULT;
    ticks(500);
    assert_kept(64, 1000UL);
    TEST_ASSERT_EQUAL_INT(1, record.number);
    modes.mode = APP_MODE_RUN;
    ticks(300);
    assert_kept(64, 1000UL);
    modes.mode = APP_MODE_FAULT;
    ticks(1);
    assert_kept(64, 1800UL);
    TEST_ASSERT_EQUAL_INT(2, record.number);
}

static void test_an_early_fault_keeps_what_there_is(void)
{
    for (int early = 1; early < 70; early++) {
        setUp();
        ticks(early);
        fault(1);
        assert_kept((early < 63) ? (early + 1) : 64, (uint32_t)early + 1UL);
    }
}

static void test_a_fault_of_the_start_keeps_nothing(void)
{
    modes.mode = APP_MODE_FAULT;
    ticks(100);
    TEST_ASSERT_EQUAL_INT(0, record.kept_count);
}

/* Oracle: the scope's signals of these names. */
static void test_each_place_is_a_signal_of_the_scope(void)
{
    static const uint16_t signals[APP_RECORD_SIGNALS] = {
        APP_SCOPE_IA,     APP_SCOPE_IB,     APP_SCOPE_DC_LINK, APP_SCOPE_SPEED,
        APP_SCOPE_DUTY_A, APP_SCOPE_DUTY_B, APP_SCOPE_DUTY_C};
    const drive_state_t states[] = {DRIVE_OFF, DRIVE_RUN, DRIVE_FAULT};

    modes.sample.ia_A                    = 1.0f;
    modes.sample.ib_A                    = 2.0f;
    modes.sample.dc_link_V               = 3.0f;
    modes.reading.omega_e_radps          = 4.0f;
    modes.drive.answer.now.omega_e_radps = 5.0f;
    out.duty.a                           = 6.0f;
    out.duty.b                           = 7.0f;
    out.duty.c                           = 8.0f;
    record.was_fault                     = false;
    for (uint16_t n = 0U; n < 3U; n++) {
        modes.drive.state = states[n];
        modes.mode        = APP_MODE_FAULT;
        app_record_tick(&record, &view);
        for (uint16_t k = 0U; k < APP_RECORD_SIGNALS; k++) {
            TEST_ASSERT_TRUE(app_record_read(&record, 0U, k) ==
                             app_scope_signals_value(&view, signals[k]));
        }
        record.was_fault = false; /* the next tick's fault is another one, of one sample */
    }
}

static float value(const uint16_t *words)
{
    const uint32_t bits = ((uint32_t)words[0] << 16) | words[1];
    float          x;
    (void)memcpy(&x, &bits, sizeof x);
    return x;
}

static app_traces_result_t read(uint32_t first, uint16_t count, uint16_t *words)
{
    return app_traces_read(&scope, &record, (uint16_t)first, count, words);
}

static void test_registers_of_the_record(void)
{
    uint16_t words[125];
    TEST_ASSERT_EQUAL_INT(APP_TRACES_NOT_NOW, read(24576UL, 2U, words));
    ticks(9);
    fault(1); /* ten samples, 140 words */
    TEST_ASSERT_EQUAL_INT(APP_TRACES_OK, read(24576UL, 2U, words));
    TEST_ASSERT_TRUE(value(words) == 1.0f);
    TEST_ASSERT_EQUAL_INT(APP_TRACES_OK, read(24576UL + 138UL, 2U, words));
    TEST_ASSERT_TRUE(value(words) == -10.0f);
    TEST_ASSERT_EQUAL_INT(APP_TRACES_NOT_NOW, read(24576UL + 139UL, 2U, words));
    TEST_ASSERT_EQUAL_INT(APP_TRACES_BAD_ADDRESS, read(24576UL + 895UL, 2U, words));
    TEST_ASSERT_EQUAL_INT(APP_TRACES_BAD_ADDRESS, read(65535UL, 1U, words));
}

static void test_registers_of_the_scope(void)
{
    const app_scope_setup_t setup = {.signal     = {APP_SCOPE_IA, 0U, 0U, APP_SCOPE_DUTY_C},
                                     .decimation = 1U};
    uint16_t                words[125];
    TEST_ASSERT_EQUAL_INT(APP_TRACES_NOT_NOW, read(16384UL, 2U, words));
    app_scope_arm(&scope, &setup);
    for (int n = 0; n < 512; n++) {
        TEST_ASSERT_EQUAL_INT(APP_TRACES_NOT_NOW, read(16384UL, 2U, words));
        modes.ticks++;
        modes.sample.ia_A = (float)modes.ticks;
        out.duty.c        = -(float)modes.ticks;
        app_scope_tick(&scope, &view);
    }
    for (uint32_t at = 0UL; at < 4096UL; at += 64UL) {
        TEST_ASSERT_EQUAL_INT(APP_TRACES_OK, read(16384UL + at, 64U, words));
        for (uint32_t k = 0UL; k < 8UL; k++) {
            const float want = (float)((at / 8UL) + k + 1UL);
            TEST_ASSERT_TRUE(value(&words[8UL * k]) == want);
            TEST_ASSERT_TRUE(value(&words[(8UL * k) + 2UL]) == 0.0f);
            TEST_ASSERT_TRUE(value(&words[(8UL * k) + 6UL]) == -want);
        }
    }
    TEST_ASSERT_EQUAL_INT(APP_TRACES_OK, read(20479UL, 1U, words));
    TEST_ASSERT_EQUAL_INT(APP_TRACES_BAD_ADDRESS, read(20480UL, 1U, words));
    TEST_ASSERT_EQUAL_INT(APP_TRACES_BAD_ADDRESS, read(20479UL, 2U, words));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_there_is_none_before_a_fault);
    RUN_TEST(test_the_last_ticks_are_kept_until_the_next_fault);
    RUN_TEST(test_a_fault_that_lasts_is_one);
    RUN_TEST(test_an_early_fault_keeps_what_there_is);
    RUN_TEST(test_a_fault_of_the_start_keeps_nothing);
    RUN_TEST(test_each_place_is_a_signal_of_the_scope);
    RUN_TEST(test_registers_of_the_record);
    RUN_TEST(test_registers_of_the_scope);
    return UNITY_END();
}
