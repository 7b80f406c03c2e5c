/* SPDX-License-Identifier: MIT */
#include "svpwm.h"

#include "bridge.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_DUTY 6.0e-7 /* ratio; worst 1.2e-7 */
#define TOL_V    2.0e-4 /* V line to line, 300 V dc link; worst 3.9e-5 */

#define V_DC_V      300.0f
#define V_LINEAR_V  173.2f /* a little inside 300 V / sqrt(3) */
#define ANGLE_STEPS 720

static const double pi = 3.14159265358979323846;

void setUp(void) {}
void tearDown(void) {}

static ab_t vector_at(double length_V, double angle_rad)
{
    const ab_t v = {.alpha = (float)(length_V * cos(angle_rad)),
                    .beta  = (float)(length_V * sin(angle_rad))};
    return v;
}

/* Upper switches of the active vectors at 0, 60, .. 300 degrees. */
static const int active[6][3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}};

/* Oracle: sector and dwell times of the two neighbouring active vectors, the rest split equally between
 * the two zero vectors. Duty of a phase is the time its upper switch is on. */
static void oracle_duty(ab_t v_V, double v_dc_V, double duty[3])
{
    const double angle    = atan2((double)v_V.beta, (double)v_V.alpha);
    const double positive = (angle < 0.0) ? (angle + (2.0 * pi)) : angle;
    const int    sector   = (int)(positive / (pi / 3.0)) % 6;
    const double within   = positive - ((double)sector * pi / 3.0);
    const double depth    = sqrt(3.0) * hypot((double)v_V.alpha, (double)v_V.beta) / v_dc_V;
    const double first    = depth * sin((pi / 3.0) - within);
    const double second   = depth * sin(within);

    for (int x = 0; x < 3; x++) {
        duty[x] = (first * (double)active[sector][x]) +
                  (second * (double)active[(sector + 1) % 6][x]) + (0.5 * (1.0 - first - second));
    }
}

static void test_duty_matches_dwell_times_over_linear_range(void)
{
    for (int length = 0; length <= 10; length++) {
        for (int step = 0; step < ANGLE_STEPS; step++) {
            const ab_t v_V = vector_at(0.1 * (double)length * (double)V_LINEAR_V,
                                       2.0 * pi * (double)step / ANGLE_STEPS);
            double     expected[3];
            oracle_duty(v_V, (double)V_DC_V, expected);

            const abc_t duty = svpwm_duty(v_V, V_DC_V);

            TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, expected[0], (double)duty.a);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, expected[1], (double)duty.b);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, expected[2], (double)duty.c);
        }
    }
}

static void test_line_to_line_voltages_are_reproduced(void)
{
    for (int step = 0; step < ANGLE_STEPS; step++) {
        const double angle = 2.0 * pi * (double)step / ANGLE_STEPS;
        const double v_V   = (double)V_LINEAR_V;

        const abc_t duty = svpwm_duty(vector_at(v_V, angle), V_DC_V);

        const double ab = (double)V_DC_V * ((double)duty.a - (double)duty.b);
        const double bc = (double)V_DC_V * ((double)duty.b - (double)duty.c);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, sqrt(3.0) * v_V * cos(angle + (pi / 6.0)), ab);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_V, sqrt(3.0) * v_V * sin(angle), bc);
    }
}

static void test_zero_voltage_gives_one_half_everywhere(void)
{
    const abc_t duty = svpwm_duty(vector_at(0.0, 0.0), V_DC_V);

    TEST_ASSERT_TRUE((duty.a == 0.5f) && (duty.b == 0.5f) &&
                     (duty.c == 0.5f)); /* exact by design */
}

static void test_largest_linear_vector_uses_the_whole_period(void)
{
    const abc_t duty = svpwm_duty(vector_at((double)V_DC_V / sqrt(3.0), pi / 6.0), V_DC_V);

    TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 1.0, (double)duty.a);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 0.0, (double)duty.c);
}

static void test_a_sixth_of_a_turn_inverts_and_shifts_the_phases(void)
{
    for (int step = 0; step < ANGLE_STEPS; step++) {
        const double angle = 2.0 * pi * (double)step / ANGLE_STEPS;

        const abc_t here = svpwm_duty(vector_at(150.0, angle), V_DC_V);
        const abc_t next = svpwm_duty(vector_at(150.0, angle + (pi / 3.0)), V_DC_V);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 1.0 - (double)here.b, (double)next.a);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 1.0 - (double)here.c, (double)next.b);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, 1.0 - (double)here.a, (double)next.c);
    }
}

static void test_only_the_ratio_of_voltages_matters(void)
{
    for (int step = 0; step < ANGLE_STEPS; step++) {
        const double angle = 2.0 * pi * (double)step / ANGLE_STEPS;

        const abc_t one = svpwm_duty(vector_at(100.0, angle), V_DC_V);
        const abc_t two = svpwm_duty(vector_at(37.0, angle), 0.37f * V_DC_V);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, (double)one.a, (double)two.a);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, (double)one.b, (double)two.b);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, (double)one.c, (double)two.c);
    }
}

/* Beyond the linear range: the projections on the phase axes, centred, each clipped. */
static void test_overmodulation_is_clipped_phase_by_phase(void)
{
    for (int step = 0; step < ANGLE_STEPS; step++) {
        const double angle    = 2.0 * pi * (double)step / ANGLE_STEPS;
        const double phase[3] = {400.0 * cos(angle), 400.0 * cos(angle - (2.0 * pi / 3.0)),
                                 400.0 * cos(angle + (2.0 * pi / 3.0))};
        const double top      = fmax(phase[0], fmax(phase[1], phase[2]));
        const double bottom   = fmin(phase[0], fmin(phase[1], phase[2]));
        double       expected[3];
        for (int x = 0; x < 3; x++) {
            expected[x] = support_limit(
                0.5 + ((phase[x] - (0.5 * (top + bottom))) / (double)V_DC_V), 0.0, 1.0);
        }

        const abc_t duty = bridge_closed(svpwm_duty(vector_at(400.0, angle), V_DC_V)).duty;

        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, expected[0], (double)duty.a);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, expected[1], (double)duty.b);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, expected[2], (double)duty.c);
    }
}

static void test_overmodulation_stays_within_the_period(void)
{
    for (int step = 0; step < ANGLE_STEPS; step++) {
        const abc_t duty =
            bridge_closed(
                svpwm_duty(vector_at(1.0e6, 2.0 * pi * (double)step / ANGLE_STEPS), V_DC_V))
                .duty;

        TEST_ASSERT_TRUE(base_in_range(duty.a, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(duty.b, 0.0f, 1.0f));
        TEST_ASSERT_TRUE(base_in_range(duty.c, 0.0f, 1.0f));
    }
}

static void test_bad_numbers_never_leave_the_range_of_a_duty(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        const ab_t bad[] = {{.alpha = support_not_finite[i], .beta = 1.0f},
                            {.alpha = 1.0f, .beta = support_not_finite[i]},
                            {.alpha = support_not_finite[i], .beta = support_not_finite[i]}};
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            const abc_t duty = bridge_closed(svpwm_duty(bad[k], V_DC_V)).duty;

            TEST_ASSERT_TRUE(base_in_range(duty.a, 0.0f, 1.0f));
            TEST_ASSERT_TRUE(base_in_range(duty.b, 0.0f, 1.0f));
            TEST_ASSERT_TRUE(base_in_range(duty.c, 0.0f, 1.0f));
        }
    }
}

/* Oracle: the hexagon's edge lies v_dc / sqrt(3) from the centre, across the middle of each sector. */
static void test_share_reaches_the_hexagon_in_every_direction(void)
{
    for (int length = 1; length <= 40; length++) {
        for (int step = 0; step < ANGLE_STEPS; step++) {
            const double angle    = 2.0 * pi * (double)step / ANGLE_STEPS;
            const double length_V = 10.0 * (double)length;
            const double reach_V =
                (double)V_DC_V / sqrt(3.0) / cos(fmod(angle, pi / 3.0) - (pi / 6.0));

            const float share = svpwm_within(vector_at(length_V, angle), V_DC_V).share;

            TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, fmin(reach_V / length_V, 1.0), (double)share);
        }
    }
}

static void test_share_of_a_vector_is_what_the_duty_ratios_produce(void)
{
    for (int step = 0; step < ANGLE_STEPS; step++) {
        const double angle = 2.0 * pi * (double)step / ANGLE_STEPS;
        const float  share = svpwm_within(vector_at(250.0, angle), V_DC_V).share;

        const abc_t duty = svpwm_duty(vector_at(250.0 * (double)share, angle), V_DC_V);

        const double a_b_V = (double)V_DC_V * ((double)duty.a - (double)duty.b);
        TEST_ASSERT_DOUBLE_WITHIN(
            TOL_DUTY * (double)V_DC_V,
            250.0 * (double)share * (cos(angle) - cos(angle - (2.0 * pi / 3.0))), a_b_V);
    }
}

static void test_duty_within_the_hexagon_is_that_of_the_share(void)
{
    for (int length = 0; length <= 40; length++) {
        for (int step = 0; step < ANGLE_STEPS; step++) {
            const double  angle    = 2.0 * pi * (double)step / ANGLE_STEPS;
            const double  length_V = 10.0 * (double)length;
            const svpwm_t within   = svpwm_within(vector_at(length_V, angle), V_DC_V);

            const abc_t duty =
                svpwm_duty(vector_at(length_V * (double)within.share, angle), V_DC_V);

            TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, (double)duty.a, (double)within.duty.a);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, (double)duty.b, (double)within.duty.b);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_DUTY, (double)duty.c, (double)within.duty.c);
        }
    }
}

static void test_share_inside_the_hexagon_is_exactly_one(void)
{
    const ab_t zero = {0.0f, 0.0f};

    TEST_ASSERT_TRUE(svpwm_within(zero, V_DC_V).share == 1.0f);
    TEST_ASSERT_TRUE(svpwm_within(vector_at(170.0, 0.4), V_DC_V).share == 1.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_duty_matches_dwell_times_over_linear_range);
    RUN_TEST(test_line_to_line_voltages_are_reproduced);
    RUN_TEST(test_zero_voltage_gives_one_half_everywhere);
    RUN_TEST(test_largest_linear_vector_uses_the_whole_period);
    RUN_TEST(test_a_sixth_of_a_turn_inverts_and_shifts_the_phases);
    RUN_TEST(test_only_the_ratio_of_voltages_matters);
    RUN_TEST(test_overmodulation_is_clipped_phase_by_phase);
    RUN_TEST(test_overmodulation_stays_within_the_period);
    RUN_TEST(test_bad_numbers_never_leave_the_range_of_a_duty);
    RUN_TEST(test_share_reaches_the_hexagon_in_every_direction);
    RUN_TEST(test_share_of_a_vector_is_what_the_duty_ratios_produce);
    RUN_TEST(test_duty_within_the_hexagon_is_that_of_the_share);
    RUN_TEST(test_share_inside_the_hexagon_is_exactly_one);
    return UNITY_END();
}
