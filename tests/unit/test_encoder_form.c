/* SPDX-License-Identifier: MIT */
#include "encoder_form.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_RAD 3.3e-6 /* rad, angles up to 9.3 rad; worst 6.6e-7 */
#define TS_s    2.0e-4f

static encoder_form_limits_t limits;
static nodo_t                est;

void setUp(void)
{
    support_random_t random_state = {.state = 43u};

    limits.angle_rad = 0.45f;
    limits.d_omega   = 2.0e4f;
    est              = support_random_estimate(&random_state);
    est.d_omega      = -1.5e4f;
}

void tearDown(void) {}

static bool plausible(float angle_error_rad)
{
    return encoder_form_view(&limits, &est, 1.0f, angle_error_rad, TS_s).plausible;
}

static void test_angle_error_is_measured_minus_estimated(void)
{
    drive_sample_t sample = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, true};

    for (int measured = -62; measured <= 62; measured++) {
        for (int estimated = -31; estimated <= 31; estimated++) {
            const float hat    = 0.1f * (float)estimated;
            sample.theta_e_rad = 0.1f * (float)measured;
            const double want  = (double)sample.theta_e_rad - (double)hat;

            const float e = encoder_form_error_rad(&sample, hat);

            TEST_ASSERT_TRUE(base_within(e, BASE_PI));
            TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, 0.0,
                                      remainder((double)e - want, 2.0 * 3.141592653589793));
        }
    }
}

static void test_view_is_the_prediction(void)
{
    const near_optimal_view_t v = encoder_form_view(&limits, &est, 1.0f, 0.1f, TS_s);

    TEST_ASSERT_TRUE(v.est == &est);
    TEST_ASSERT_TRUE((v.now.omega_e_radps == est.omega_e_radps) && (v.now.iq_A == est.iq_A) &&
                     (v.now.id_A == est.id_A));
    TEST_ASSERT_TRUE(v.d_omega_dot == 0.0f);
    TEST_ASSERT_TRUE(v.plausible);
}

/* EQ-DRIVE-2: the prediction is of the instant at which the voltage takes effect, for one period. */
static void test_middle_angle_is_half_a_period_after_the_prediction(void)
{
    for (int speed = -1500; speed <= 1500; speed += 250) {
        est.omega_e_radps = (float)speed;

        const near_optimal_view_t v = encoder_form_view(&limits, &est, -2.5f, 0.1f, TS_s);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, -2.5 + (1.0e-4 * (double)speed), (double)v.theta_rad);
    }
}

static void test_angle_is_plausible_up_to_its_limit(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        TEST_ASSERT_TRUE(plausible((float)sign * 0.45f));
        TEST_ASSERT_FALSE(plausible((float)sign * nextafterf(0.45f, 1.0f)));
    }
    TEST_ASSERT_TRUE(plausible(0.0f));
}

static void test_disturbance_is_plausible_up_to_its_limit(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        est.d_omega = (float)sign * 2.0e4f;
        TEST_ASSERT_TRUE(plausible(0.1f));
        est.d_omega = (float)sign * nextafterf(2.0e4f, INFINITY);
        TEST_ASSERT_FALSE(plausible(0.1f));
    }
}

static void test_not_a_number_is_not_plausible(void)
{
    TEST_ASSERT_FALSE(plausible(NAN));
    est.d_omega = NAN;
    TEST_ASSERT_FALSE(plausible(0.0f));
}

static void test_check_of_the_limits(void)
{
    const float angles[]     = {1.0e-6f, 0.45f, BASE_PI};
    const float bad_angles[] = {0.0f, 0.99e-6f, -0.45f, 3.1416f, NAN, INFINITY};
    const float bad_others[] = {0.0f, -1.0f, 1.0e13f, NAN, INFINITY};

    for (int i = 0; i < SUPPORT_COUNT(angles); i++) {
        limits.angle_rad = angles[i];
        TEST_ASSERT_TRUE(encoder_form_check(&limits));
    }
    for (int i = 0; i < SUPPORT_COUNT(bad_angles); i++) {
        limits.angle_rad = bad_angles[i];
        TEST_ASSERT_FALSE(encoder_form_check(&limits));
    }
    limits.angle_rad = 0.45f;
    for (int i = 0; i < SUPPORT_COUNT(bad_others); i++) {
        limits.d_omega = bad_others[i];
        TEST_ASSERT_FALSE(encoder_form_check(&limits));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angle_error_is_measured_minus_estimated);
    RUN_TEST(test_view_is_the_prediction);
    RUN_TEST(test_middle_angle_is_half_a_period_after_the_prediction);
    RUN_TEST(test_angle_is_plausible_up_to_its_limit);
    RUN_TEST(test_disturbance_is_plausible_up_to_its_limit);
    RUN_TEST(test_not_a_number_is_not_plausible);
    RUN_TEST(test_check_of_the_limits);
    return UNITY_END();
}
