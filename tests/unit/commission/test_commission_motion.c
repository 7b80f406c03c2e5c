/* SPDX-License-Identifier: MIT */
#include "commission_motion.h"

#include "unit_support.h"
#include "unity.h"

#define PI          3.14159265358979324
#define TS_s        1.0e-4
#define FLUX_Wb     0.06
#define PAIRS       4
#define COUNTS      10000
#define INERTIA     8.3e-5
#define VISCOUS_Nms 1.1e-4
#define DRY_Nm      0.02

static commission_config_t config;
static commission_result_t known;
static commission_motion_t motion;
static double              omega;
static double              theta;

void setUp(void)
{
    const commission_config_t c = {.ts_s = (float)TS_s};
    const commission_result_t k = {.flux_Wb         = {(float)FLUX_Wb, 0.0f},
                                   .ld_H            = {0.003f, 0.0f},
                                   .lq_H            = {0.003f, 0.0f},
                                   .counts_per_turn = COUNTS,
                                   .pole_pairs      = PAIRS,
                                   .direction       = 1};
    config                      = c;
    known                       = k;
    omega                       = 0.0;
    theta                       = 0.0;
    commission_motion_start(&motion);
}

void tearDown(void) {}

/* A shaft with both kinds of friction, in double precision, and an encoder that counts whole. */
static void run(double iq_A, bool driven, int window, double until_radps, int most)
{
    commission_motion_begin(&motion, driven, window, 20);
    for (int k = 0; k < most; k++) {
        const dq_t i_A = {0.0f, (float)iq_A};
        commission_motion_tick(&motion, &config, &known,
                               (int32_t)floor(theta * COUNTS / (2.0 * PI)) * known.direction, i_A);
        const double torque = 1.5 * PAIRS * FLUX_Wb * iq_A;
        const double drag   = (VISCOUS_Nms * omega) + copysign(DRY_Nm, omega);
        omega += (torque - drag) / INERTIA * TS_s;
        theta += omega * TS_s;
        if ((iq_A > 0.0) ? (omega > until_radps) : (omega < until_radps)) {
            return;
        }
    }
}

static void run_all(void)
{
    omega = 1.0;
    run(0.9, true, 300, 300.0, 100000);
    run(0.0, false, 500, 100.0, 5000);
    run(-0.9, true, 300, -300.0, 100000);
    omega = 90.0;
    run(0.0, false, 500, 20.0, 5000);
}

static bool solve(void)
{
    commission_step_t step = COMMISSION_BUSY;
    for (int32_t part = COMMISSION_MOTION_ROUGH; step == COMMISSION_BUSY; part++) {
        step = commission_motion_solve(&motion, part, &known);
    }
    return step == COMMISSION_DONE;
}

static void test_inertia_and_both_frictions(void)
{
    run_all();

    TEST_ASSERT_TRUE(solve());
    TEST_ASSERT_DOUBLE_WITHIN(0.002 * INERTIA, INERTIA, (double)known.inertia_kgm2.value);
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * VISCOUS_Nms, VISCOUS_Nms, (double)known.friction_Nms.value);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * DRY_Nm, DRY_Nm, (double)known.coulomb_Nm.value);
}

static void test_an_encoder_that_counts_down_finds_the_same(void)
{
    known.direction = -1;
    run_all();

    TEST_ASSERT_TRUE(solve());
    TEST_ASSERT_DOUBLE_WITHIN(0.002 * INERTIA, INERTIA, (double)known.inertia_kgm2.value);
}

/* Reluctance torque: 1.5 n_p (Ld - Lq) id iq. */
static void test_torque_of_both_kinds(void)
{
    known.lq_H.value = 0.005f;
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, (1.5 * PAIRS * FLUX_Wb * 2.0) + (1.5 * PAIRS * -0.002 * -6.0),
                              (double)commission_motion_torque(&known, 2.0f, -6.0f));
}

static void test_nothing_seen_is_no_result(void)
{
    TEST_ASSERT_FALSE(solve());
}

/* Friction of a fifth of the torque: the shaft stands before a window is full. */
static void test_a_shaft_that_does_not_coast(void)
{
    omega = 1.0;
    run(0.9, true, 300, 300.0, 100000);
    run(-0.9, true, 300, -300.0, 100000);

    TEST_ASSERT_TRUE(solve());
    /* Viscous friction appears as dry friction and as inertia: 0.03 N m of 0.32. */
    TEST_ASSERT_DOUBLE_WITHIN(0.03 * INERTIA, INERTIA, (double)known.inertia_kgm2.value);
    const double drag_Nm = DRY_Nm + (VISCOUS_Nms * 150.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * drag_Nm, drag_Nm, (double)known.coulomb_Nm.value);
    TEST_ASSERT_TRUE(known.friction_Nms.error > (0.5f * (float)VISCOUS_Nms));
}

static void test_friction_is_never_negative(void)
{
    omega = 1.0;
    run(0.9, true, 300, 300.0, 100000);
    commission_motion_begin(&motion, false, 500, 20);
    for (int k = 0; k < 4000; k++) { /* a load that drives */
        const dq_t none = {0.0f, 0.0f};
        commission_motion_tick(&motion, &config, &known,
                               (int32_t)floor(theta * COUNTS / (2.0 * PI)), none);
        omega += 100.0 * TS_s;
        theta += omega * TS_s;
    }

    (void)solve();

    TEST_ASSERT_TRUE(known.friction_Nms.value >= 0.0f);
    TEST_ASSERT_TRUE(known.coulomb_Nm.value >= 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_inertia_and_both_frictions);
    RUN_TEST(test_an_encoder_that_counts_down_finds_the_same);
    RUN_TEST(test_torque_of_both_kinds);
    RUN_TEST(test_nothing_seen_is_no_result);
    RUN_TEST(test_a_shaft_that_does_not_coast);
    RUN_TEST(test_friction_is_never_negative);
    return UNITY_END();
}
