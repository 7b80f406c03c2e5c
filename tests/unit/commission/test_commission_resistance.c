/* SPDX-License-Identifier: MIT */
#include "commission_resistance.h"

#include "held_winding.h"
#include "unit_support.h"
#include "unity.h"

#define TS_s 2.0e-4

static commission_config_t     config;
static commission_result_t     found;
static commission_resistance_t stage;

void setUp(void)
{
    const commission_config_t c = {.ts_s = (float)TS_s, .current_max_A = 9.0f};
    const commission_result_t k = {.ld_H = {0.036f, 0.0f}, .lq_H = {0.051f, 0.0f}};
    config                      = c;
    found                       = k;
    commission_resistance_start(&stage, &config, &found);
}

void tearDown(void) {}

static double run(held_winding_t *w)
{
    ab_t   asked_V = {0.0f, 0.0f};
    double peak_A  = 0.0;
    for (long k = 0; k < 200000L; k++) {
        const commission_signal_t s = winding_step(w, asked_V);
        const commission_answer_t a = commission_resistance_tick(&stage, &config, &s, &found);
        asked_V                     = a.v_V;
        peak_A                      = fmax(peak_A, hypot(w->id_A, w->iq_A));
        if (a.step != COMMISSION_BUSY) {
            TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, a.step);
            return peak_A;
        }
    }
    TEST_FAIL_MESSAGE("it does not end");
    return 0.0;
}

/* Over two decades of resistance with the same inductance; measured within 0.05 %. */
static void test_resistance_and_loss_over_two_decades(void)
{
    for (double r_Ohm = 0.3; r_Ohm < 30.0; r_Ohm *= 2.1) {
        held_winding_t w = {.ts_s      = TS_s,
                            .angle_rad = 1.1,
                            .r_Ohm     = r_Ohm,
                            .ld_H      = 0.036,
                            .lq_H      = 0.051,
                            .loss_V    = 8.1};
        setUp();
        const double peak_A = run(&w);

        TEST_ASSERT_DOUBLE_WITHIN(0.003 * r_Ohm, r_Ohm, (double)found.r_Ohm.value);
        TEST_ASSERT_DOUBLE_WITHIN(0.1, 8.1, (double)found.v_loss_V.value);
        TEST_ASSERT_TRUE(peak_A <= (0.65 * 9.0));
    }
}

static void test_an_inverter_without_losses(void)
{
    held_winding_t w = {.ts_s = TS_s, .angle_rad = 0.0, .r_Ohm = 3.6, .ld_H = 0.036, .lq_H = 0.051};
    (void)run(&w);

    TEST_ASSERT_DOUBLE_WITHIN(0.003 * 3.6, 3.6, (double)found.r_Ohm.value);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.0, (double)found.v_loss_V.value);
}

/* LOOK's wave takes this voltage of the winding and its inverter. */
#define ODD_V 12.0f

/* A healthy winding of 3.6 Ohm with 8.1 V of loss up to the means of a level. It follows in every period. */
static void reach(int angle, int level)
{
    held_winding_t w = {
        .ts_s = TS_s, .angle_rad = 0.0, .r_Ohm = 3.6, .ld_H = 0.036, .lq_H = 0.051, .loss_V = 8.1};
    ab_t asked_V = {0.0f, 0.0f};
    bool there   = false;
    setUp();
    found.odd_V = ODD_V;
    commission_resistance_start(&stage, &config, &found);
    for (long k = 0; (k < 200000L) && !there; k++) {
        const commission_signal_t s = winding_step(&w, asked_V);
        const commission_answer_t a = commission_resistance_tick(&stage, &config, &s, &found);
        asked_V                     = a.v_V;
        there = (stage.angle == angle) && (stage.level == level) && (stage.mean_ticks > 0L);
        TEST_ASSERT_EQUAL_INT(COMMISSION_BUSY, a.step);
        TEST_ASSERT_TRUE(commission_resistance_follows(&stage, &config, &found));
    }
    TEST_ASSERT_TRUE(there);
}

/* The loop forgets the pulses for 80 ms. */
static void test_a_mean_begins_when_the_pulses_are_forgotten(void)
{
    const commission_signal_t s = {.dc_link_V = 540.0f};
    reach(0, 0);
    for (int k = 0; k <= 400; k++) {
        TEST_ASSERT_EQUAL_INT(0, stage.sums);
        (void)commission_resistance_tick(&stage, &config, &s, &found);
    }
    TEST_ASSERT_EQUAL_INT(1, stage.sums);
}

/* `at` is one of the means that are judged: it passes up to a limit, and not a hundredth above it. */
static void expect_limit(float *at, float limit)
{
    const float kept = *at;
    *at              = 0.99f * limit;
    TEST_ASSERT_TRUE(commission_resistance_follows(&stage, &config, &found));
    *at = 1.01f * limit;
    TEST_ASSERT_FALSE(commission_resistance_follows(&stage, &config, &found));
    *at = kept;
}

/* 0.13 of 9 A. The rotor may snap at the larger currents of the first angle: 0.22. */
static void test_a_current_across_the_vector_ends_it(void)
{
    const struct {
        int   angle;
        int   level;
        float most_A;
    } cases[] = {{0, 0, 1.17f}, {0, 1, 1.98f}, {0, 3, 1.98f}, {1, 0, 1.17f}, {2, 3, 1.17f}};
    for (int k = 0; k < SUPPORT_COUNT(cases); k++) {
        reach(cases[k].angle, cases[k].level);
        expect_limit(&stage.vector.cross_A, cases[k].most_A);
        expect_limit(&stage.vector.cross_A, -cases[k].most_A);
    }
}

/* 0.3 of the voltage of LOOK. */
static void test_a_voltage_against_the_current_ends_it(void)
{
    reach(0, 0);
    expect_limit(&stage.vector.mean_V, -0.3f * ODD_V);
    reach(1, 2);
    expect_limit(&stage.vector.mean_V, -0.3f * ODD_V);
}

/* The line of the two levels before, and 0.9 of 9 A times its slope; without a slope twice the voltage per ampere. */
static void test_a_voltage_above_the_line_of_two_levels_ends_it(void)
{
    for (int level = 1; level < 4; level++) {
        reach(0, level);
        const float per = (float)(level + 1) / (float)level; /* level + 1 times 1.125 A */

        TEST_ASSERT_FLOAT_WITHIN(0.1f, 3.6f, stage.slope_Ohm);
        TEST_ASSERT_FLOAT_WITHIN(0.05f, (4.05f * (float)level) + 10.8f, stage.before_V);
        expect_limit(&stage.vector.mean_V, stage.before_V + (stage.slope_Ohm * (1.125f + 8.1f)));
        stage.slope_Ohm = 0.0f;
        expect_limit(&stage.vector.mean_V, 2.0f * stage.before_V * per);
    }
}

/* R and loss of the first angle are known, and half of 9 A more may be induced. */
static void test_a_voltage_above_the_first_line_ends_it(void)
{
    for (int angle = 1; angle < 3; angle++) {
        reach(angle, 1);
        expect_limit(&stage.vector.mean_V,
                     (stage.lines[0].x0 * (2.25f + 4.5f)) + stage.lines[0].x1);
    }
}

static void stand_for(double time_s)
{
    stage.vector.still_ticks = (int32_t)(time_s / TS_s);
}

/* Within a count for more than 50 ms: nothing is induced. */
static void test_a_voltage_of_a_shaft_that_stands_ends_it(void)
{
    reach(0, 0);
    stand_for(0.06);
    expect_limit(&stage.vector.brisk_V, 1.2f * stage.before_V * 1.125f / 0.45f);
    for (int level = 1; level < 4; level++) {
        reach(0, level);
        stand_for(0.06);
        expect_limit(&stage.vector.brisk_V, stage.before_V + (stage.slope_Ohm * (1.125f + 3.15f)));
    }
    reach(1, 1);
    stand_for(0.06);
    expect_limit(&stage.vector.brisk_V, 10.8f + (3.6f * (2.25f + 3.15f)));
    reach(0, 0);
    stage.level = -1;
    stand_for(0.06);
    expect_limit(&stage.vector.brisk_V, 1.65f * ODD_V);
}

static void test_a_voltage_of_a_shaft_that_moves_may_be_induced(void)
{
    reach(0, 1);
    stand_for(0.04);
    stage.vector.brisk_V = 1000.0f;
    TEST_ASSERT_TRUE(commission_resistance_follows(&stage, &config, &found));
}

static void test_a_mean_that_is_no_number_ends_it(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        for (int which = 0; which < 4; which++) {
            reach(0, 1);
            stand_for(0.06);
            float *const means[] = {&stage.vector.cross_A, &stage.vector.mean_V,
                                    &stage.vector.brisk_V, &stage.vector.behind_A};
            *means[which]        = support_not_finite[k];
            TEST_ASSERT_FALSE(commission_resistance_follows(&stage, &config, &found));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_resistance_and_loss_over_two_decades);
    RUN_TEST(test_an_inverter_without_losses);
    RUN_TEST(test_a_mean_begins_when_the_pulses_are_forgotten);
    RUN_TEST(test_a_current_across_the_vector_ends_it);
    RUN_TEST(test_a_voltage_against_the_current_ends_it);
    RUN_TEST(test_a_voltage_above_the_line_of_two_levels_ends_it);
    RUN_TEST(test_a_voltage_above_the_first_line_ends_it);
    RUN_TEST(test_a_voltage_of_a_shaft_that_stands_ends_it);
    RUN_TEST(test_a_voltage_of_a_shaft_that_moves_may_be_induced);
    RUN_TEST(test_a_mean_that_is_no_number_ends_it);
    return UNITY_END();
}
