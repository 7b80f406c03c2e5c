/* SPDX-License-Identifier: MIT */
#include "sample.h"

#include <complex.h>

#include "unit_support.h"
#include "unity.h"

#define TOL_A   5.0e-6 /* A, currents up to 8 A; worst 1.0e-6 */
#define TOL_RAD 1.4e-6 /* rad, angles up to 7 rad; worst 2.8e-7 */

#define CASES 5000

static support_random_t random_state;
static drive_sample_t   sample;
static double complex   i_A; /* that the sample was made of, in the rotor frame */

/* Phase currents by projection on the phase axes. */
static void draw(void)
{
    const double theta = (double)support_uniform(&random_state, -6.28f, 6.28f);
    i_A                = support_complex((double)support_uniform(&random_state, -5.0f, 5.0f),
                                         (double)support_uniform(&random_state, -5.0f, 5.0f));
    const double complex stator = i_A * cexp(support_complex(0.0, theta));
    sample.theta_e_rad          = (float)theta;
    sample.ia_A                 = (float)creal(stator);
    sample.ib_A          = (float)creal(stator * cexp(support_complex(0.0, -2.0943951023931953)));
    sample.omega_e_radps = support_uniform(&random_state, -1500.0f, 1500.0f);
    sample.dc_link_V     = 295.0f;
    sample.valid         = true;
}

void setUp(void)
{
    random_state.state = 41u;
    draw();
}

void tearDown(void) {}

static void test_measurement_is_the_current_in_the_rotor_frame_and_the_speed(void)
{
    for (int n = 0; n < CASES; n++) {
        draw();

        const nodo_meas_t y = sample_measurement(&sample);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(i_A), (double)y.id_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, cimag(i_A), (double)y.iq_A);
        TEST_ASSERT_TRUE(y.omega_e_radps == sample.omega_e_radps);
    }
}

/* In the frame of any angle: the rotor frame turned by the difference. */
static void test_current_is_seen_from_the_angle_that_is_given(void)
{
    for (int n = 0; n < CASES; n++) {
        draw();
        const float          from = support_uniform(&random_state, -3.14f, 3.14f);
        const double         turn = (double)sample.theta_e_rad - (double)from;
        const double complex want = i_A * cexp(support_complex(0.0, turn));

        const dq_t seen_A = sample_current_A(&sample, from);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(want), (double)seen_A.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, cimag(want), (double)seen_A.q);
    }
}

/* EQ-DRIVE-2: the voltage acts from one to two periods after the sample. */
static void test_middle_angle_is_one_and_a_half_periods_on(void)
{
    for (int n = 0; n < CASES; n++) {
        draw();
        const double want = (double)sample.theta_e_rad + (0.0003 * (double)sample.omega_e_radps);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, want, (double)sample_middle_angle_rad(&sample, 2.0e-4f));
    }
}

static void test_middle_angle_of_a_standing_motor_is_its_angle(void)
{
    sample.omega_e_radps = 0.0f;

    TEST_ASSERT_TRUE(sample_middle_angle_rad(&sample, 2.0e-4f) == sample.theta_e_rad);
}

static void test_not_a_number_is_not_hidden(void)
{
    sample.ib_A         = NAN;
    const nodo_meas_t y = sample_measurement(&sample);

    TEST_ASSERT_TRUE(isnan(y.id_A) && isnan(y.iq_A));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_measurement_is_the_current_in_the_rotor_frame_and_the_speed);
    RUN_TEST(test_current_is_seen_from_the_angle_that_is_given);
    RUN_TEST(test_middle_angle_is_one_and_a_half_periods_on);
    RUN_TEST(test_middle_angle_of_a_standing_motor_is_its_angle);
    RUN_TEST(test_not_a_number_is_not_hidden);
    return UNITY_END();
}
