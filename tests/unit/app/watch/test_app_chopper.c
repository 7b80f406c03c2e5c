/* SPDX-License-Identifier: MIT */
#include "app_chopper.h"

#include <math.h>

#include "unity.h"

#define TS_s    200.0e-6f
#define TURN    5U    /* periods from a turn to the next */
#define ON_cnt  3504U /* 385 V */
#define OFF_cnt 3413U /* 375 V */
#define PER_cnt 0.1099f
#define TURN_s  1.0e-3f

/* 100 Ohm, 50 W, 2 s: at 385 V 29.6 times the rated power. */
static const app_chopper_config_t config = {
    .on_cnt = ON_cnt, .off_cnt = OFF_cnt, .per_V2 = 2.0e-4f, .tau_s = 2.0f};
static app_chopper_t  chopper;
static board_sample_t raw;
static uint32_t       ticks;

void setUp(void)
{
    const board_sample_t valid = {.valid = true};

    raw   = valid;
    ticks = 0UL;
    app_chopper_init(&chopper, &config, TS_s);
}

void tearDown(void) {}

static bool see(uint16_t dc_link_cnt)
{
    raw.dc_link_cnt = dc_link_cnt;
    ticks++;
    return app_chopper_tick(&chopper, &raw);
}

/* Periods with one voltage and a turn of the slow work in each fifth; the last answer. */
static bool hold(uint16_t dc_link_cnt, uint32_t periods)
{
    bool on = false;

    for (uint32_t n = 0UL; n < periods; n++) {
        on = see(dc_link_cnt);
        if ((ticks % TURN) == 0UL) {
            app_chopper_turn(&chopper, &raw, (float)dc_link_cnt * PER_cnt, ticks);
        }
    }
    return on;
}

static void test_each_code_switches_as_its_level_says(void)
{
    for (uint16_t cnt = 0U; cnt < BOARD_ADC_CODES; cnt++) { /* up */
        TEST_ASSERT_EQUAL_INT(cnt > ON_cnt, see(cnt));
    }
    for (uint16_t cnt = BOARD_ADC_CODES; cnt > 0U; cnt--) { /* down */
        TEST_ASSERT_EQUAL_INT((cnt - 1U) > OFF_cnt, see((uint16_t)(cnt - 1U)));
    }
    TEST_ASSERT_FALSE(see(ON_cnt));
    TEST_ASSERT_TRUE(see(ON_cnt + 1U));
    TEST_ASSERT_TRUE(see(OFF_cnt + 1U));
    TEST_ASSERT_FALSE(see(OFF_cnt));
    TEST_ASSERT_FALSE(see(ON_cnt));
}

static void test_a_lost_sample_switches_off_in_its_own_period(void)
{
    TEST_ASSERT_TRUE(see(4000U));
    raw.valid = false;
    TEST_ASSERT_FALSE(see(4000U));
    raw.valid = true;
    TEST_ASSERT_FALSE(see(ON_cnt)); /* the hysteresis has begun anew */
    TEST_ASSERT_TRUE(see(4000U));
}

static void test_heat_rises_and_falls_with_the_time_constant(void)
{
    app_chopper_config_t weak = config;

    weak.per_V2 = 2.0e-6f; /* a hundredth: never hot */
    app_chopper_init(&chopper, &weak, TS_s);
    const float v_V  = 3600.0f * PER_cnt;
    const float rest = 2.0e-6f * v_V * v_V;

    (void)hold(3600U, 4000UL); /* 0.8 s */
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, rest * (1.0f - expf(-0.4f)), chopper.heat);
    (void)hold(3000U, 10000UL); /* 2 s off */
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, rest * (1.0f - expf(-0.4f)) * expf(-1.0f), chopper.heat);
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_OFF, app_chopper_state(&chopper));
}

static void test_a_hot_resistor_stays_off_until_it_has_cooled(void)
{
    uint32_t on = 0UL;
    uint32_t n  = 0UL;

    while ((n < 5000UL) && (app_chopper_state(&chopper) != APP_CHOPPER_HOT)) {
        if (hold(3600U, 1UL)) {
            on++;
        }
        n++;
    }
    /* 31.3 of the rated power: 1 after 2 s ln(31.3 / 30.3) = 65 ms. */
    TEST_ASSERT_UINT32_WITHIN(10UL, 325UL, on);
    TEST_ASSERT_FLOAT_WITHIN(0.02f, 1.0f, chopper.heat);
    TEST_ASSERT_FALSE(hold(4095U, 100UL)); /* 20 ms: a hundredth cooler */
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_HOT, app_chopper_state(&chopper));

    n = 0UL;
    while ((n < 5000UL) && !hold(3600U, 1UL)) {
        n++;
    }
    /* 2 s ln(1 / 0.9) = 211 ms, less the 20. */
    TEST_ASSERT_UINT32_WITHIN(15UL, 955UL, n);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, 0.9f, chopper.heat);
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_ON, app_chopper_state(&chopper));
}

static void test_no_pattern_exceeds_the_rated_heat_by_more_than_a_turn(void)
{
    float most = 0.0f;

    for (uint32_t n = 0UL; n < 50000UL; n++) { /* 10 s */
        (void)hold(((n / 37UL) % 3UL) == 0UL ? 3000U : 4095U, 1UL);
        most = fmaxf(most, chopper.heat);
    }
    /* A turn at 450 V: 40.5 / 2000. */
    TEST_ASSERT_TRUE(most > 0.95f);
    TEST_ASSERT_TRUE(most < 1.03f);
}

static void test_a_resistor_on_for_too_long_stays_off_until_the_link_has_fallen(void)
{
    app_chopper_config_t weak = config;

    weak.per_V2 = 2.0e-6f;
    app_chopper_init(&chopper, &weak, TS_s);
    TEST_ASSERT_TRUE(hold(3600U, 4900UL)); /* 0.98 s */
    TEST_ASSERT_FALSE(hold(3600U, 200UL));
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_STUCK, app_chopper_state(&chopper));
    TEST_ASSERT_FALSE(hold(4095U, 20000UL));
    TEST_ASSERT_FALSE(hold(OFF_cnt + 1U, 2000UL));
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_STUCK, app_chopper_state(&chopper));
    TEST_ASSERT_FALSE(hold(OFF_cnt, TURN));
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_OFF, app_chopper_state(&chopper));
    TEST_ASSERT_TRUE(see(3600U));
}

static void test_a_pause_begins_the_time_anew(void)
{
    app_chopper_config_t weak = config;

    weak.per_V2 = 2.0e-6f;
    app_chopper_init(&chopper, &weak, TS_s);
    for (int n = 0; n < 5; n++) {
        TEST_ASSERT_TRUE(hold(3600U, 4000UL));
        (void)hold(3000U, 1UL);
    }
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_OFF, app_chopper_state(&chopper));
}

static void test_a_heat_that_is_no_number_keeps_off(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, -1.0f};

    for (int n = 0; n < 4; n++) {
        setUp();
        chopper.heat = bad[n];
        (void)hold(3600U, TURN);
        TEST_ASSERT_FALSE(see(4095U));
        TEST_ASSERT_EQUAL_INT(APP_CHOPPER_HOT, app_chopper_state(&chopper));
    }
    setUp();
    (void)see(3600U);
    app_chopper_turn(&chopper, &raw, NAN, ticks);
    TEST_ASSERT_FALSE(see(4095U));
}

/* A turn that came late, because samples were invalid. */
static void test_a_late_turn_counts_every_period(void)
{
    app_chopper_config_t weak = config;

    weak.per_V2 = 2.0e-6f;
    app_chopper_init(&chopper, &weak, TS_s);
    (void)hold(3600U, 4000UL);
    const float often = chopper.heat;

    app_chopper_init(&chopper, &weak, TS_s);
    ticks = 0UL;
    for (uint32_t n = 0UL; n < 4000UL; n++) {
        (void)see(3600U);
        if ((ticks % 50UL) == 0UL) {
            app_chopper_turn(&chopper, &raw, 3600.0f * PER_cnt, ticks);
        }
    }
    TEST_ASSERT_FLOAT_WITHIN(2.0e-3f, often, chopper.heat);
    ticks += 100000000UL;
    app_chopper_turn(&chopper, &raw, 300.0f, ticks);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.0f, chopper.heat);
}

static void test_without_a_chopper_nothing_switches(void)
{
    const app_chopper_config_t none = {.on_cnt = 0U};

    for (int n = 0; n < 2; n++) {
        app_chopper_init(&chopper, (n == 0) ? NULL : &none, TS_s);
        for (uint16_t cnt = 0U; cnt < BOARD_ADC_CODES; cnt++) {
            TEST_ASSERT_FALSE(see(cnt));
        }
        TEST_ASSERT_FALSE(see(65535U));
        (void)hold(4095U, 100UL);
        TEST_ASSERT_EQUAL_INT(APP_CHOPPER_NONE, app_chopper_state(&chopper));
    }
}

static ctl_status_t checked(app_chopper_config_t c)
{
    return app_chopper_check(&c, true, PER_cnt, 398.0f, TURN_s);
}

static void test_constants_out_of_range_are_refused(void)
{
    app_chopper_config_t       c    = config;
    const app_chopper_config_t none = {.on_cnt = 0U};

    TEST_ASSERT_EQUAL_INT(CTL_OK, checked(c));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_chopper_check(&c, false, PER_cnt, 398.0f, TURN_s));
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_chopper_check(&none, false, PER_cnt, 398.0f, TURN_s));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, checked(none));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_chopper_check(&c, true, PER_cnt, 385.0f, TURN_s));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_chopper_check(&c, true, NAN, 398.0f, TURN_s));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_chopper_check(&c, true, PER_cnt, 398.0f, 1.0f));
    c.off_cnt = ON_cnt;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, checked(c));
    c.off_cnt = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, checked(c));
    const float bad[] = {0.0f, -1.0f, NAN, INFINITY};
    for (int n = 0; n < 4; n++) {
        c        = config;
        c.per_V2 = bad[n];
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, checked(c));
        c       = config;
        c.tau_s = bad[n];
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, checked(c));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_code_switches_as_its_level_says);
    RUN_TEST(test_a_lost_sample_switches_off_in_its_own_period);
    RUN_TEST(test_heat_rises_and_falls_with_the_time_constant);
    RUN_TEST(test_a_hot_resistor_stays_off_until_it_has_cooled);
    RUN_TEST(test_no_pattern_exceeds_the_rated_heat_by_more_than_a_turn);
    RUN_TEST(test_a_resistor_on_for_too_long_stays_off_until_the_link_has_fallen);
    RUN_TEST(test_a_pause_begins_the_time_anew);
    RUN_TEST(test_a_heat_that_is_no_number_keeps_off);
    RUN_TEST(test_a_late_turn_counts_every_period);
    RUN_TEST(test_without_a_chopper_nothing_switches);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
