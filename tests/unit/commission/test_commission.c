/* SPDX-License-Identifier: MIT */
#include "commission.h"

#include "unit_support.h"
#include "unity.h"

#define TS_s 2.0e-4f

static commission_config_t config;
static commission_t        module;
static commission_sample_t sample;

void setUp(void)
{
    const commission_config_t c = {.ts_s              = TS_s,
                                   .current_max_A     = 8.0f,
                                   .speed_max_m_radps = 150.0f,
                                   .dc_link_min_V     = 400.0f,
                                   .dc_link_max_V     = 700.0f,
                                   .counts_per_turn   = 10000};
    const commission_sample_t s = {.dc_link_V = 540.0f, .valid = true};
    config                      = c;
    sample                      = s;
    TEST_ASSERT_EQUAL_INT(CTL_OK, commission_init(&module, &config));
    commission_start(&module);
}

void tearDown(void) {}

static bridge_t step(void)
{
    return commission_tick(&module, &sample, true);
}

/* Past the watch, with the bridge closed. */
static void drive_on(void)
{
    bridge_t out = bridge_open();
    for (int k = 0; (k < 3000) && !out.gate_enable; k++) {
        out = step();
    }
    TEST_ASSERT_TRUE(out.gate_enable);
}

static void expect_abort(commission_reason_t reason)
{
    const bridge_t out = step();

    TEST_ASSERT_FALSE(out.gate_enable);
    TEST_ASSERT_EQUAL_INT(COMMISSION_ABORTED, module.stage);
    TEST_ASSERT_EQUAL_INT(reason, module.reason);
    TEST_ASSERT_FALSE(step().gate_enable); /* and stays */
    TEST_ASSERT_EQUAL_INT(reason, module.reason);
}

static void test_nothing_moves_before_the_start(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, commission_init(&module, &config));
    TEST_ASSERT_FALSE(step().gate_enable);
    TEST_ASSERT_EQUAL_INT(COMMISSION_IDLE, module.stage);
    TEST_ASSERT_EQUAL_INT(0, commission_percent(module.stage, module.last_stage));
}

static void test_bridge_stays_open_while_the_zeros_are_measured(void)
{
    for (int k = 0; k < 900; k++) {
        TEST_ASSERT_FALSE(step().gate_enable);
    }
    TEST_ASSERT_EQUAL_INT(COMMISSION_WATCH, module.stage);
    drive_on();
    TEST_ASSERT_EQUAL_INT(COMMISSION_LOOK, module.stage);
    TEST_ASSERT_TRUE(commission_percent(module.stage, module.last_stage) > 0);
}

static void test_a_shaft_that_turns_before_the_start_is_refused(void)
{
    for (int k = 0; (k < 30000) && (module.stage == COMMISSION_WATCH); k++) {
        sample.position_cnt += (k % 100 == 0) ? 1 : 0;
        TEST_ASSERT_FALSE(step().gate_enable);
    }
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_MOVING, module.reason);
}

static void test_a_shaft_that_comes_to_rest_is_waited_for(void)
{
    for (int k = 0; k < 3000; k++) {
        sample.position_cnt += (k % 100 == 0) ? 1 : 0;
        TEST_ASSERT_FALSE(step().gate_enable);
    }
    drive_on();
}

static void test_a_zero_that_is_far_off_is_refused(void)
{
    sample.ib_A = 0.5f;
    for (int k = 0; (k < 3000) && (module.stage == COMMISSION_WATCH); k++) {
        (void)step();
    }
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_MOVING, module.reason);
}

static void test_over_current_of_each_phase_opens_at_once(void)
{
    const float most         = 1.06f * 8.0f;
    const float phases[3][2] = {{most, 0.0f}, {0.0f, -most}, {0.6f * most, 0.6f * most}};
    for (int k = 0; k < 3; k++) {
        setUp();
        drive_on();
        sample.ia_A = phases[k][0];
        sample.ib_A = phases[k][1];
        expect_abort(COMMISSION_REASON_OVER_CURRENT);
    }
}

static void test_samples_that_are_no_numbers_open_at_once(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        setUp();
        drive_on();
        sample.ia_A = support_not_finite[k];
        expect_abort(COMMISSION_REASON_OVER_CURRENT);
        setUp();
        drive_on();
        sample.dc_link_V = support_not_finite[k];
        expect_abort(COMMISSION_REASON_DC_LINK);
    }
}

static void test_invalid_samples_and_a_withdrawn_command_open_at_once(void)
{
    drive_on();
    sample.valid = false;
    expect_abort(COMMISSION_REASON_SAMPLE);

    setUp();
    drive_on();
    TEST_ASSERT_FALSE(commission_tick(&module, &sample, false).gate_enable);
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_WITHDRAWN, module.reason);
}

static void test_dc_link_out_of_range_opens_at_once(void)
{
    drive_on();
    sample.dc_link_V = 399.0f;
    expect_abort(COMMISSION_REASON_DC_LINK);
    setUp();
    drive_on();
    sample.dc_link_V = 701.0f;
    expect_abort(COMMISSION_REASON_DC_LINK);
}

static void test_a_position_that_jumps_opens_at_once(void)
{
    drive_on();
    (void)step();
    sample.position_cnt += 200; /* 150 rad/s are 48 counts a period */
    expect_abort(COMMISSION_REASON_ENCODER);
}

/* 10 % too fast, seen within the millisecond over which it is counted. */
static void test_over_speed_opens(void)
{
    drive_on();
    int ticks = 0;
    for (; (ticks < 20) && (module.stage != COMMISSION_ABORTED); ticks++) {
        sample.position_cnt += 53;
        (void)step();
    }
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_OVER_SPEED, module.reason);
    TEST_ASSERT_TRUE(ticks <= 6);
}

/* Both phases open: no current ever answers. */
static void test_a_motor_that_is_not_there_ends_it(void)
{
    drive_on();
    for (long k = 0; (k < 2000000L) && (module.stage != COMMISSION_ABORTED); k++) {
        (void)step();
    }
    TEST_ASSERT_EQUAL_INT(COMMISSION_ABORTED, module.stage);
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_SENSOR, module.reason);
}

static void test_a_flipped_bit_of_the_stage_ends_it(void)
{
    drive_on();
    const int stage = (int)module.stage;

    for (int bit = 0; bit < 15; bit++) {
        const int flipped = stage ^ (1 << bit);
        if ((flipped >= COMMISSION_IDLE) && (flipped <= COMMISSION_ABORTED)) {
            continue;
        }
        module.stage         = (commission_stage_t)flipped;
        const int16_t behind = commission_percent(module.stage, COMMISSION_DRAG);
        TEST_ASSERT_EQUAL_INT16(100, behind);
        TEST_ASSERT_EQUAL_INT16(100, commission_percent(COMMISSION_ABORTED, module.stage));
        expect_abort(COMMISSION_REASON_NUMERIC);
    }
    module.stage = (commission_stage_t)-1;
    TEST_ASSERT_EQUAL_INT16(100, commission_percent(module.stage, COMMISSION_DRAG));
    expect_abort(COMMISSION_REASON_NUMERIC);
}

static void test_it_can_start_again(void)
{
    drive_on();
    sample.valid = false;
    (void)step();
    sample.valid = true;
    commission_start(&module);
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_NONE, module.reason);
    drive_on();
}

static void test_bounds_out_of_range_are_refused(void)
{
    const commission_config_t good = config;
    for (int k = 0; k < 7; k++) {
        config                = good;
        float *const fields[] = {&config.ts_s, &config.current_max_A, &config.speed_max_m_radps,
                                 &config.dc_link_min_V, &config.dc_link_max_V};
        if (k < 5) {
            *fields[k] = (k % 2 == 0) ? NAN : -1.0f;
        } else {
            config.counts_per_turn = (k == 5) ? -4 : 5000000;
        }
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, commission_init(&module, &config));
        commission_start(&module);
        TEST_ASSERT_EQUAL_INT(COMMISSION_ABORTED, module.stage);
        TEST_ASSERT_FALSE(step().gate_enable);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_moves_before_the_start);
    RUN_TEST(test_bridge_stays_open_while_the_zeros_are_measured);
    RUN_TEST(test_a_shaft_that_turns_before_the_start_is_refused);
    RUN_TEST(test_a_shaft_that_comes_to_rest_is_waited_for);
    RUN_TEST(test_a_zero_that_is_far_off_is_refused);
    RUN_TEST(test_over_current_of_each_phase_opens_at_once);
    RUN_TEST(test_samples_that_are_no_numbers_open_at_once);
    RUN_TEST(test_invalid_samples_and_a_withdrawn_command_open_at_once);
    RUN_TEST(test_dc_link_out_of_range_opens_at_once);
    RUN_TEST(test_a_position_that_jumps_opens_at_once);
    RUN_TEST(test_over_speed_opens);
    RUN_TEST(test_a_motor_that_is_not_there_ends_it);
    RUN_TEST(test_a_flipped_bit_of_the_stage_ends_it);
    RUN_TEST(test_it_can_start_again);
    RUN_TEST(test_bounds_out_of_range_are_refused);
    return UNITY_END();
}
