/* SPDX-License-Identifier: MIT */
#include "frames.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_ANGLE    2.0e-7 /* cosine or sine within +-2 turns; worst 9.2e-8 over 2e6 angles */
#define TOL_WRAP_RAD 9.0e-7 /* rad, angles within +-3 pi; worst 1.8e-7 */
#define TOL_A        1.0e-5 /* A, vectors of 10 A at any angle; worst 1.9e-6 */

#define FAR_RAD 5.0e4f /* some thousand turns */

#define STEPS 360 /* of one degree; the sweeps go from -2 pi to 2 pi */

static const double third_turn = 2.0943951023931953; /* rad */

void setUp(void) {}
void tearDown(void) {}

static float sweep_angle(int step)
{
    return BASE_TWO_PI * (float)step / (float)STEPS;
}

/* A vector of 10 A that turns against the sweep, so that all combinations of signs appear. */
static ab_t sweep_vector(int step)
{
    const double at = -0.7 - (0.37 * (double)step);
    const ab_t   x  = {.alpha = (float)(10.0 * cos(at)), .beta = (float)(10.0 * sin(at))};
    return x;
}

static void test_angle_is_the_unit_vector_at_that_angle(void)
{
    for (int step = -STEPS; step <= STEPS; step++) {
        const float          theta    = sweep_angle(step);
        const double complex expected = cexp(support_complex(0.0, (double)theta));

        const frames_angle_t angle = frames_angle(theta);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_ANGLE, creal(expected), (double)angle.cos);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_ANGLE, cimag(expected), (double)angle.sin);
    }
}

/* EQ-FRAMES-3 in steps of 13 arc seconds, and out to where a quarter turn can still be counted. */
static void test_angle_is_as_good_everywhere(void)
{
    for (int32_t step = -200000; step <= 200000; step++) {
        const float          theta = BASE_TWO_PI * (float)step / 1.0e5f;
        const frames_angle_t angle = frames_angle(theta);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_ANGLE, cos((double)theta), (double)angle.cos);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_ANGLE, sin((double)theta), (double)angle.sin);
    }
    for (float theta = 20.0f; theta < FAR_RAD; theta *= 1.003f) {
        for (int sign = -1; sign <= 1; sign += 2) {
            const double         far       = (double)theta * (double)sign;
            const double         tolerance = TOL_ANGLE + (6.0e-8 * (double)theta);
            const frames_angle_t angle     = frames_angle((float)far);
            TEST_ASSERT_DOUBLE_WITHIN(tolerance, cos(far), (double)angle.cos);
            TEST_ASSERT_DOUBLE_WITHIN(tolerance, sin(far), (double)angle.sin);
        }
    }
}

/* Opposite angles mirror to the last bit: nothing in the core prefers a direction. */
static void test_opposite_angles_are_mirror_images(void)
{
    for (int32_t step = 0; step <= 100000; step++) {
        const float          theta = 40.0f * (float)step / 1.0e5f;
        const frames_angle_t a     = frames_angle(theta);
        const frames_angle_t b     = frames_angle(-theta);
        TEST_ASSERT_TRUE((a.cos == b.cos) && (a.sin == -b.sin));
    }
}

/* Oracle for EQ-FRAMES-1: 2/3 (a + b e^(j 2 pi/3) + c e^(-j 2 pi/3)) with c = -a - b. */
static void test_clarke_matches_space_vector_of_three_phases(void)
{
    for (int ia = -10; ia <= 10; ia++) {
        for (int ib = -10; ib <= 10; ib++) {
            const double complex turn = cexp(support_complex(0.0, third_turn));
            const double complex expected =
                (2.0 / 3.0) * ((double)ia + ((double)ib * turn) - ((double)(ia + ib) * conj(turn)));

            const ab_t x = frames_clarke((float)ia, (float)ib);

            TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(expected), (double)x.alpha);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_A, cimag(expected), (double)x.beta);
        }
    }
}

static void test_clarke_keeps_the_phase_amplitude(void)
{
    for (int step = 0; step < STEPS; step++) {
        const double theta = (double)sweep_angle(step);

        const ab_t x =
            frames_clarke((float)(10.0 * cos(theta)), (float)(10.0 * cos(theta - third_turn)));

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 10.0, hypot((double)x.alpha, (double)x.beta));
    }
}

/* Each phase is the projection of the vector on the axis of that phase. */
static void test_inverse_clarke_projects_on_phase_axes(void)
{
    for (int step = -STEPS; step <= STEPS; step++) {
        const ab_t           x = sweep_vector(step);
        const double complex v = support_complex((double)x.alpha, (double)x.beta);

        const abc_t phases = frames_inverse_clarke(x);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(v), (double)phases.a);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(v * cexp(support_complex(0.0, -third_turn))),
                                  (double)phases.b);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(v * cexp(support_complex(0.0, third_turn))),
                                  (double)phases.c);
    }
}

static void test_phases_of_a_vector_sum_to_zero(void)
{
    for (int step = -STEPS; step <= STEPS; step++) {
        const abc_t phases = frames_inverse_clarke(sweep_vector(step));

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 0.0,
                                  (double)phases.a + (double)phases.b + (double)phases.c);
    }
}

static void test_clarke_undoes_its_inverse(void)
{
    for (int step = -STEPS; step <= STEPS; step++) {
        const ab_t  x      = sweep_vector(step);
        const abc_t phases = frames_inverse_clarke(x);

        const ab_t back = frames_clarke(phases.a, phases.b);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (double)x.alpha, (double)back.alpha);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (double)x.beta, (double)back.beta);
    }
}

static void test_park_turns_backwards_by_the_angle(void)
{
    for (int step = -STEPS; step <= STEPS; step++) {
        const ab_t           x        = sweep_vector(step);
        const float          theta    = sweep_angle(step);
        const double complex expected = support_complex((double)x.alpha, (double)x.beta) *
                                        cexp(support_complex(0.0, -(double)theta));

        const dq_t y = frames_park(x, frames_angle(theta));

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(expected), (double)y.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, cimag(expected), (double)y.q);
    }
}

static void test_inverse_park_turns_forwards_by_the_angle(void)
{
    for (int step = -STEPS; step <= STEPS; step++) {
        const ab_t           v     = sweep_vector(step);
        const dq_t           x     = {.d = v.alpha, .q = v.beta};
        const float          theta = sweep_angle(step);
        const double complex expected =
            support_complex((double)x.d, (double)x.q) * cexp(support_complex(0.0, (double)theta));

        const ab_t y = frames_inverse_park(x, frames_angle(theta));

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, creal(expected), (double)y.alpha);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, cimag(expected), (double)y.beta);
    }
}

static void test_balanced_phases_become_constant_in_the_rotor_frame(void)
{
    for (int step = -STEPS; step <= STEPS; step++) {
        const float  theta = sweep_angle(step);
        const double at    = (double)theta + 0.5; /* of the current vector, 0.5 rad ahead of d */

        const ab_t x = frames_clarke((float)(10.0 * cos(at)), (float)(10.0 * cos(at - third_turn)));
        const dq_t y = frames_park(x, frames_angle(theta));

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 10.0 * cos(0.5), (double)y.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 10.0 * sin(0.5), (double)y.q);
    }
}

static void test_not_a_number_is_not_hidden(void)
{
    const ab_t x = {.alpha = NAN, .beta = 1.0f};

    const dq_t y = frames_park(x, frames_angle(0.5f));

    TEST_ASSERT_TRUE(isnan(y.d) && isnan(y.q));
}

static void test_wrap_moves_angles_of_three_half_turns_into_one(void)
{
    for (int step = -942; step <= 942; step++) {
        const float angle = 0.01f * (float)step;

        const float out = frames_wrap(angle);

        TEST_ASSERT_TRUE(base_in_range(out, -BASE_PI, BASE_PI));
        TEST_ASSERT_DOUBLE_WITHIN(TOL_WRAP_RAD, 0.0,
                                  remainder((double)out - (double)angle, 3.0 * third_turn));
        TEST_ASSERT_TRUE(frames_wrap(-angle) == -out);
    }
}

/* Every angle within a quarter turn of zero, in steps of 2^-15 rad and at the ends. */
static void test_small_angle_is_the_angle_bit_for_bit(void)
{
    const int ends = 51471; /* below pi/2 */

    for (int step = -ends; step <= ends; step++) {
        const float          theta_rad = (float)step / 32768.0f;
        const frames_angle_t any       = frames_angle(theta_rad);
        const frames_angle_t small     = frames_small_angle(theta_rad);

        TEST_ASSERT_EQUAL_MEMORY(&any, &small, sizeof any);
    }
}

static void test_wrap_leaves_what_is_in_range(void)
{
    TEST_ASSERT_TRUE(frames_wrap(BASE_PI) == BASE_PI);
    TEST_ASSERT_TRUE(frames_wrap(-BASE_PI) == -BASE_PI);
    TEST_ASSERT_TRUE(frames_wrap(0.0f) == 0.0f);
    TEST_ASSERT_TRUE(frames_wrap(1.0e-30f) == 1.0e-30f);
    TEST_ASSERT_TRUE(frames_wrap(nextafterf(BASE_PI, 4.0f)) < 0.0f);
    TEST_ASSERT_TRUE(frames_wrap(-nextafterf(BASE_PI, 4.0f)) > 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angle_is_the_unit_vector_at_that_angle);
    RUN_TEST(test_angle_is_as_good_everywhere);
    RUN_TEST(test_opposite_angles_are_mirror_images);
    RUN_TEST(test_clarke_matches_space_vector_of_three_phases);
    RUN_TEST(test_clarke_keeps_the_phase_amplitude);
    RUN_TEST(test_inverse_clarke_projects_on_phase_axes);
    RUN_TEST(test_phases_of_a_vector_sum_to_zero);
    RUN_TEST(test_clarke_undoes_its_inverse);
    RUN_TEST(test_park_turns_backwards_by_the_angle);
    RUN_TEST(test_inverse_park_turns_forwards_by_the_angle);
    RUN_TEST(test_balanced_phases_become_constant_in_the_rotor_frame);
    RUN_TEST(test_not_a_number_is_not_hidden);
    RUN_TEST(test_wrap_moves_angles_of_three_half_turns_into_one);
    RUN_TEST(test_small_angle_is_the_angle_bit_for_bit);
    RUN_TEST(test_wrap_leaves_what_is_in_range);
    return UNITY_END();
}
