/* SPDX-License-Identifier: MIT */
#include "app_commission.h"

#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

static app_commission_t   commission;
static board_sample_t     raw;
static app_scale_sample_t sample;

void setUp(void)
{
    const board_sample_t          r      = {.valid = true};
    const app_scale_sample_t      s      = {.dc_link_V = 295.0f, .valid = true};
    const app_commission_bounds_t bounds = {3.0f, 150.0f};
    raw                                  = r;
    sample                               = s;
    app_commission_init(&commission, &gain_tables_drive);
    app_commission_start(&commission, &bounds, 9990U);
    raw.position_cnt = 9990U;
}

void tearDown(void) {}

static bridge_t step(void)
{
    return app_commission_tick(&commission, &sample, &raw, true);
}

static void test_bounds_are_those_of_the_command(void)
{
    TEST_ASSERT_TRUE(commission.module.config->current_max_A == 3.0f);
    TEST_ASSERT_TRUE(commission.module.config->speed_max_m_radps == 150.0f);
    TEST_ASSERT_EQUAL_INT(10000, commission.module.config->counts_per_turn);
    TEST_ASSERT_EQUAL_INT(COMMISSION_WATCH, commission.module.stage);
}

static void test_allowed_are_currents_up_to_the_drives(void)
{
    const float             most   = gain_tables_drive.current_max_A;
    app_commission_bounds_t bounds = {most, 150.0f};
    TEST_ASSERT_TRUE(app_commission_allows(&commission, &bounds));
    bounds.current_A = 1.001f * most;
    TEST_ASSERT_FALSE(app_commission_allows(&commission, &bounds));
    bounds.current_A = 0.0f;
    TEST_ASSERT_FALSE(app_commission_allows(&commission, &bounds));
    bounds.current_A     = most;
    bounds.speed_m_radps = 0.0f;
    TEST_ASSERT_FALSE(app_commission_allows(&commission, &bounds));
}

/* From 9990 forward over the end of the turn, and back. */
static void test_position_goes_on_at_the_end_of_a_turn(void)
{
    for (int k = 0; k < 100; k++) {
        raw.position_cnt = (uint16_t)((9990 + k) % 10000);
        (void)step();
        TEST_ASSERT_EQUAL_INT(k, commission.position_cnt);
    }
    raw.position_cnt = 9980U;
    (void)step();
    TEST_ASSERT_EQUAL_INT(-10, commission.position_cnt);
}

static void test_a_sample_that_is_not_valid_ends_it_and_moves_nothing(void)
{
    raw.position_cnt = 123U;
    sample.valid     = false;
    TEST_ASSERT_FALSE(step().gate_enable);
    TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_SAMPLE, app_commission_status(&commission).reason);
    TEST_ASSERT_EQUAL_INT(0, commission.position_cnt);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bounds_are_those_of_the_command);
    RUN_TEST(test_allowed_are_currents_up_to_the_drives);
    RUN_TEST(test_position_goes_on_at_the_end_of_a_turn);
    RUN_TEST(test_a_sample_that_is_not_valid_ends_it_and_moves_nothing);
    return UNITY_END();
}
