/* SPDX-License-Identifier: MIT */
#include "position_loop.h"

#include "unit_support.h"
#include "unity.h"

#define CASES 2000
#define TOL   2.0e-6 /* relative to the sum of the terms' sizes; worst 3e-7 */

static support_random_t random_state;
static position_gains_t gains;

void setUp(void)
{
    const position_gains_t some = {
        .nosc          = {.order             = 0,
                          .iq_error_max_A    = 4.0f,
                          .iq_speed_max_A    = 1.0f,
                          .speed_A_per_radps = 0.25f,
                          .speed_radps_per_A = 4.0f,
                          .lambda            = {{{30.0f, 120.0f, 0.0f}, {0.0f, 0.0f, 100.0f}}}},
        .theta         = {4000.0f},
        .speed_per_rad = 133.0f,
        .near_rad      = 0.1f,
        .most          = {.speed_e_radps  = 1000.0f,
                          .accel_e_radps2 = 5000.0f,
                          .decel_e_radps2 = 6000.0f,
                          .jerk_e_radps3  = 1.0e6f}};
    random_state.state = 5u;
    gains              = some;
}

void tearDown(void) {}

static void test_the_angle_acts_on_v_q_with_even_powers_and_on_v_d_with_odd_ones(void)
{
    for (int i = 0; i < CASES; i++) {
        const float  error = support_uniform(&random_state, -0.2f, 0.2f);
        const float  iq_A  = support_uniform(&random_state, -8.0f, 8.0f);
        const double held  = support_limit((double)iq_A, -4.0, 4.0);
        double       q = 0.0, d = 0.0, size = 1.0;

        gains.nosc.order = (int16_t)support_uniform(&random_state, 0.0f, 8.99f);
        for (int n = 0; n <= gains.nosc.order; n++) {
            gains.theta[n] = support_uniform(&random_state, -5.0e3f, 5.0e3f);
            const double v = (double)gains.theta[n] * pow(held, n) * (double)error;
            *(((n % 2) == 0) ? &q : &d) -= v;
            size += fabs(v);
        }
        const dq_t u_V = position_loop_V(&gains, error, iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL * size, q, (double)u_V.q);
        TEST_ASSERT_DOUBLE_WITHIN(TOL * size, d, (double)u_V.d);
    }
}

static void test_every_constant_has_its_range(void)
{
    float *const members[] = {
        &gains.theta[0],           &gains.speed_per_rad,       &gains.near_rad,
        &gains.most.speed_e_radps, &gains.most.accel_e_radps2, &gains.most.decel_e_radps2,
        &gains.most.jerk_e_radps3, &gains.nosc.iq_error_max_A, &gains.nosc.lambda[0][0][1]};

    TEST_ASSERT_TRUE(position_loop_check(&gains));
    for (int i = 0; i < SUPPORT_COUNT(members); i++) {
        const float good = *members[i];
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            *members[i] = support_not_finite[k];
            TEST_ASSERT_FALSE(position_loop_check(&gains));
        }
        *members[i] = (i == 0) ? good : 0.0f;
        TEST_ASSERT_TRUE(position_loop_check(&gains) == (i == 0));
        *members[i] = good;
    }
    gains.near_rad = 3.2f; /* beyond half a turn */
    TEST_ASSERT_FALSE(position_loop_check(&gains));
}

static void test_an_error_of_the_speed_has_to_ask_for_current(void)
{
    gains.nosc.speed_A_per_radps = 0.0f; /* a pair that nosc.h allows */
    gains.nosc.speed_radps_per_A = 0.0f;
    TEST_ASSERT_FALSE(position_loop_check(&gains));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_angle_acts_on_v_q_with_even_powers_and_on_v_d_with_odd_ones);
    RUN_TEST(test_every_constant_has_its_range);
    RUN_TEST(test_an_error_of_the_speed_has_to_ask_for_current);
    return UNITY_END();
}
