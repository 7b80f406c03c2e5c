/* SPDX-License-Identifier: MIT */
#include "commission_sensors.h"

#include "unit_support.h"
#include "unity.h"

#define TS_s    2.0e-4f
#define BOUND_A 3.0f
#define L_H     0.075f
#define R_Ohm   2.5f

static commission_config_t config = {
    .ts_s = TS_s, .current_max_A = BOUND_A, .dc_link_min_V = 400.0f, .dc_link_max_V = 700.0f};
static commission_t        module;
static commission_answer_t answer;

static void begin(commission_stage_t stage)
{
    const commission_t fresh = {.config     = &config,
                                .stage      = stage,
                                .checked    = true,
                                .admittance = {1.0f / L_H, 0.0f, 1.0f / L_H, 20.0f}};
    module                   = fresh;
    module.found.r_Ohm.value = R_Ohm;
    module.found.ld_H.value  = L_H;
    module.found.lq_H.value  = L_H;
    module.found.odd_V       = 10.0f;
    module.ticks             = 1000L;

    module.found.counts_per_turn = 10000;
    module.found.pole_pairs      = 2;
    module.found.direction       = 1;
}

void setUp(void)
{
    begin(COMMISSION_RESISTANCE);
    commission_resistance_start(&module.work.resistance, &config, &module.found);
}

void tearDown(void) {}

/* True when the next period has a pulse. */
static bool pulses(void)
{
    const commission_signal_t s = {.dc_link_V = 540.0f};
    answer                      = commission_rest(COMMISSION_BUSY);
    commission_sensors_probe(&module, &s, &answer);
    return !base_within(answer.v_V.alpha, 0.0f) || !base_within(answer.v_V.beta, 0.0f);
}

static void test_pulses_ask_at_the_start_of_a_stage(void)
{
    module.work.resistance.mean_ticks = 500L;
    module.ticks                      = 127L;
    TEST_ASSERT_TRUE(pulses());
    module.ticks = 128L;
    TEST_ASSERT_FALSE(pulses());
    begin(COMMISSION_DRAG);
    module.ticks = 127L;
    TEST_ASSERT_TRUE(pulses());
    module.ticks = 128L;
    TEST_ASSERT_FALSE(pulses());
}

/* The current settles: every ramp, not the means of R. */
static void test_pulses_ask_while_the_current_of_resistance_settles(void)
{
    module.work.resistance.mean_ticks = 0L;
    TEST_ASSERT_TRUE(pulses());
    module.work.resistance.mean_ticks = 500L;
    TEST_ASSERT_FALSE(pulses());
}

static void test_pulses_ask_while_the_current_is_off_its_reference(void)
{
    module.work.resistance.mean_ticks       = 500L;
    module.work.resistance.vector.quick_A.d = 0.1f; /* of 3 A; it strays from 0 */
    TEST_ASSERT_TRUE(pulses());
    begin(COMMISSION_DRAG);
    module.work.drag.vector.quick_A.d = 0.1f;
    TEST_ASSERT_TRUE(pulses());
}

static void test_the_other_stages_have_no_pulses(void)
{
    const commission_stage_t others[] = {COMMISSION_LOOK, COMMISSION_MAP, COMMISSION_SPIN,
                                         COMMISSION_RING};
    for (int k = 0; k < SUPPORT_COUNT(others); k++) {
        begin(others[k]);
        module.ticks = 0L;
        TEST_ASSERT_FALSE(pulses());
    }
}

/* Periods until 20 V without a current end the stage. */
static int periods_of(commission_stage_t stage)
{
    const commission_signal_t s = {.v_V = {20.0f, 0.0f}, .dc_link_V = 540.0f};
    int                       k = 0;
    begin(stage);
    while (commission_sensors_explain(&module, &s) && (k < 2000)) {
        k++;
    }
    return k;
}

/* 0.24 and 0.4 of the voltage of R at the bound, EQ-COMMISSION-16. */
static void test_map_and_spin_have_their_own_limits_of_the_mean(void)
{
    TEST_ASSERT_INT_WITHIN(2, 47, periods_of(COMMISSION_MAP));
    TEST_ASSERT_INT_WITHIN(2, 81, periods_of(COMMISSION_SPIN));
    TEST_ASSERT_INT_WITHIN(2, 81, periods_of(COMMISSION_RING));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_pulses_ask_at_the_start_of_a_stage);
    RUN_TEST(test_pulses_ask_while_the_current_of_resistance_settles);
    RUN_TEST(test_pulses_ask_while_the_current_is_off_its_reference);
    RUN_TEST(test_the_other_stages_have_no_pulses);
    RUN_TEST(test_map_and_spin_have_their_own_limits_of_the_mean);
    return UNITY_END();
}
