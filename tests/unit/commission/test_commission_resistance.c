/* SPDX-License-Identifier: MIT */
#include "commission_resistance.h"

#include "standing_winding.h"
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

static double run(standing_winding_t *w)
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
        standing_winding_t w = {.ts_s      = TS_s,
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
    standing_winding_t w = {
        .ts_s = TS_s, .angle_rad = 0.0, .r_Ohm = 3.6, .ld_H = 0.036, .lq_H = 0.051};
    (void)run(&w);

    TEST_ASSERT_DOUBLE_WITHIN(0.003 * 3.6, 3.6, (double)found.r_Ohm.value);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.0, (double)found.v_loss_V.value);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_resistance_and_loss_over_two_decades);
    RUN_TEST(test_an_inverter_without_losses);
    return UNITY_END();
}
