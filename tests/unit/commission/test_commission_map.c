/* SPDX-License-Identifier: MIT */
#include "commission_map.h"

#include "held_winding.h"
#include "unit_support.h"
#include "unity.h"

#define PI   3.14159265358979324
#define TS_s 2.0e-4

static commission_config_t     config;
static commission_result_t     found;
static commission_map_t        map;
static commission_inductance_t stage;
static held_winding_t          winding;
static double                  peak_A;
static double                  left_A;   /* current half way through a rest */
static double                  most_d_A; /* d current off its place beside a q wave */

void setUp(void)
{
    const commission_config_t c = {.ts_s = (float)TS_s, .current_max_A = 9.0f};
    const commission_result_t k = {.r_Ohm           = {3.6f, 0.0f},
                                   .ld_H            = {0.036f, 0.0f},
                                   .lq_H            = {0.051f, 0.0f},
                                   .counts_per_turn = 10000,
                                   .pole_pairs      = 3,
                                   .direction       = 1};
    const held_winding_t      w = {
             .ts_s = TS_s, .angle_rad = 0.7, .r_Ohm = 3.6, .ld_H = 0.036, .lq_H = 0.051};
    const commission_map_t none = {.step_A = 0.0f};
    config                      = c;
    found                       = k;
    winding                     = w;
    map                         = none;
    peak_A                      = 0.0;
    most_d_A                    = 0.0;
    left_A                      = 0.0;
    commission_inductance_start(&stage, 1.0e9f, 0.0f);
}

void tearDown(void) {}

static void set_angle(double angle_rad)
{
    winding.angle_rad = angle_rad;
    /* So that position 0 is there: EQ-COMMISSION-7 has the middle of a count. */
    found.offset_rad.value = (float)(angle_rad - (3.0 * PI / 10000.0));
}

static commission_step_t run(void)
{
    const double start_rad = winding.angle_rad;
    ab_t         asked_V   = {0.0f, 0.0f};
    for (long k = 0; k < 100000L; k++) {
        commission_signal_t s = winding_step(&winding, asked_V);
        s.position_cnt = (int32_t)lround((winding.angle_rad - start_rad) * 10000.0 / (6.0 * PI));
        const commission_answer_t a = commission_map_tick(&stage, &config, &s, &found, &map);
        const double              bias_A =
            0.68 * 9.0 / COMMISSION_BINS * (double)COMMISSION_MAP_BIAS * (stage.axis - 1);
        if ((stage.axis > 1) && (stage.wave.halves > 4) && (stage.wait_ticks == 200)) {
            most_d_A = fmax(most_d_A, fabs(winding.id_A + bias_A));
        }
        const double i_A = hypot(winding.id_A, winding.iq_A);
        peak_A           = (i_A > peak_A) ? i_A : peak_A;
        left_A           = (stage.wait_ticks == 100) ? fmax(left_A, i_A) : left_A;
        asked_V          = a.v_V;
        if (a.step != COMMISSION_BUSY) {
            return a.step;
        }
    }
    return COMMISSION_BUSY;
}

static double middle_A(int bin)
{
    return (bin + 0.5) * (double)map.step_A;
}

static double ld_H(int row, int bin)
{
    return (double)found.ld_H.value * map.ld[row][bin] / COMMISSION_MAP_ONE;
}

static double lq_H(int row, int bin)
{
    return (double)found.lq_H.value * map.lq[row][bin] / COMMISSION_MAP_ONE;
}

static void expect_inductances(double share)
{
    TEST_ASSERT_DOUBLE_WITHIN(share * winding.ld_H, winding.ld_H, (double)found.ld_H.value);
    TEST_ASSERT_DOUBLE_WITHIN(share * winding.lq_H, winding.lq_H, (double)found.lq_H.value);
}

static void test_a_constant_inductance_is_flat(void)
{
    set_angle(0.7);
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());

    expect_inductances(0.005);
    for (int k = 0; k < COMMISSION_BINS; k++) {
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.036, 0.036, ld_H(0, k));
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.036, 0.036, ld_H(1, k));
        for (int row = 0; row < 3; row++) {
            TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.051, 0.051, lq_H(row, k));
        }
    }
    TEST_ASSERT_TRUE(found.ld_H.error < (0.02f * found.ld_H.value));
    TEST_ASSERT_TRUE(peak_A < 1.0 * 9.0);
}

/* Oracle: the differential inductance in the middle of each bin. */
static void test_saturation_is_shown(void)
{
    set_angle(-2.0);
    winding.fall_1pA = 0.06;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());

    for (int k = 0; k < COMMISSION_BINS; k++) {
        const double left = 1.0 - (0.06 * middle_A(k));
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.051 * left, 0.051 * left, lq_H(0, k));
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.036 * left, 0.036 * left, ld_H(0, k));
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.036 * left, 0.036 * left, ld_H(1, k));
    }
    TEST_ASSERT_TRUE(map.lq[0][3] < (0.75 * map.lq[0][0]));
}

/* Oracle: the same with the d current of each row. */
static void test_cross_saturation_is_shown(void)
{
    set_angle(1.1);
    winding.cross_1pA = 0.05;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());

    const double bias_A = (double)(COMMISSION_MAP_BIAS * map.step_A);
    const double id_A[] = {0.0, -bias_A, -2.0 * bias_A};
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.4 * 0.68 * 9.0, bias_A);
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < COMMISSION_BINS; k++) {
            const double want = 0.051 * (1.0 - (0.05 * id_A[row]));
            TEST_ASSERT_DOUBLE_WITHIN(0.03 * want, want, lq_H(row, k));
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.051, 0.051, (double)found.lq_H.value);
}

static void set_reluctance(void)
{
    winding.ld_H      = 0.0062;
    winding.lq_H      = 0.0415;
    winding.r_Ohm     = 0.54;
    found.r_Ohm.value = 0.54f;
    found.ld_H.value  = 0.0062f;
    found.lq_H.value  = 0.0415f;
    set_angle(0.3);
}

/* L_q i_q induces a voltage in the d axis. That of L_d i_d in the q axis has no mean over whole
 * waves. */
static void test_a_turning_rotor_moves_neither_d_current_nor_lq(void)
{
    set_reluctance();
    winding.flux_Wb       = 0.05;
    found.flux_Wb.value   = 0.05f;
    winding.omega_e_radps = 40.0;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());

    TEST_ASSERT_DOUBLE_WITHIN(0.04 * 9.0, 0.0, most_d_A);
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < COMMISSION_BINS; k++) {
            TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.0415, 0.0415, lq_H(row, k));
        }
    }
}

/* R = 18 mOhm and 1.2 mH: by itself the current of a wave would last for 67 ms. */
static void test_no_current_is_left_after_a_wave(void)
{
    winding.ld_H      = 0.00037;
    winding.lq_H      = 0.0012;
    winding.r_Ohm     = 0.018;
    found.r_Ohm.value = 0.018f;
    found.ld_H.value  = 0.00037f;
    found.lq_H.value  = 0.0012f;
    set_angle(0.3);
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
    TEST_ASSERT_DOUBLE_WITHIN(0.005 * 9.0, 0.0, left_A);
}

static void set_crossed(void)
{
    set_reluctance();
    found.flux_Wb.value    = 0.1f;
    found.offset_rad.value = frames_wrap(found.offset_rad.value + (0.5f * BASE_PI));
}

/* The axis that was taken for d is q. */
static void test_crossed_axes_are_put_right(void)
{
    set_crossed();
    winding.cross_1pA = 0.05;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());

    expect_inductances(0.01);
    TEST_ASSERT_TRUE(found.reluctance);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.3, (double)found.offset_rad.value);
    TEST_ASSERT_TRUE(found.flux_Wb.value == 0.0f);
    TEST_ASSERT_TRUE(map.lq[2][0] > (1.1 * map.lq[0][0])); /* of the right axis */
}

/* An axis that is the larger one, whichever it is called: nothing that a motor can have. */
static void test_axes_that_stay_crossed_end_it(void)
{
    set_crossed();
    stage.turned = true;
    TEST_ASSERT_EQUAL_INT(COMMISSION_FAILED, run());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_constant_inductance_is_flat);
    RUN_TEST(test_saturation_is_shown);
    RUN_TEST(test_cross_saturation_is_shown);
    RUN_TEST(test_a_turning_rotor_moves_neither_d_current_nor_lq);
    RUN_TEST(test_no_current_is_left_after_a_wave);
    RUN_TEST(test_crossed_axes_are_put_right);
    RUN_TEST(test_axes_that_stay_crossed_end_it);
    return UNITY_END();
}
