/* SPDX-License-Identifier: MIT */
#include "current_gate.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_A 2.0e-6 /* A, up to 8 A; worst 4e-7 */

static current_gate_t       gate;
static current_gate_input_t in;

void setUp(void)
{
    const current_gate_input_t expected = {.trip_A   = 8.0f,
                                           .jump_A   = 1.5f,
                                           .i_hat_A  = {.a = 1.0f, .b = -0.5f, .c = -0.5f},
                                           .expected = true};
    in                                  = expected;
    current_gate_reset(&gate);
}

void tearDown(void) {}

static int judge(float ia_A, float ib_A)
{
    return (int)current_gate_judge(&gate, ia_A, ib_A, &in);
}

/* Every sequence of eight samples, beyond the trip level or not, against what the definition says. */
static void test_two_of_three_trip(void)
{
    in.jump_A = 100.0f;
    for (int pattern = 0; pattern < 256; pattern++) {
        current_gate_reset(&gate);
        for (int n = 0; n < 8; n++) {
            const int beyond = (pattern >> n) & 1;
            const int before = ((n > 0) ? ((pattern >> (n - 1)) & 1) : 0) +
                               ((n > 1) ? ((pattern >> (n - 2)) & 1) : 0);
            const int spike = (before > 0) ? CURRENT_GATE_TRIP : CURRENT_GATE_SPIKE;
            const int want  = (beyond == 1) ? spike : CURRENT_GATE_GOOD;
            TEST_ASSERT_EQUAL_INT(want, judge((beyond == 1) ? 8.1f : 7.9f, -1.0f));
        }
    }
}

static void test_every_phase_counts(void)
{
    static const float ia_A[] = {8.1f, -8.1f, 0.0f, 0.0f, 4.1f, -4.1f};
    static const float ib_A[] = {0.0f, 0.0f, 8.1f, -8.1f, 4.1f, -4.1f};
    in.jump_A                 = 100.0f;
    for (int i = 0; i < SUPPORT_COUNT(ia_A); i++) {
        current_gate_reset(&gate);
        TEST_ASSERT_EQUAL_INT(CURRENT_GATE_SPIKE, judge(ia_A[i], ib_A[i]));
        TEST_ASSERT_EQUAL_INT(CURRENT_GATE_TRIP, judge(ia_A[i], ib_A[i]));
    }
}

static void test_not_a_number_trips_at_once(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        current_gate_reset(&gate);
        TEST_ASSERT_EQUAL_INT(CURRENT_GATE_TRIP, judge(support_not_finite[k], 0.0f));
        current_gate_reset(&gate);
        TEST_ASSERT_EQUAL_INT(CURRENT_GATE_TRIP, judge(0.0f, support_not_finite[k]));
    }
}

/* EQ-CURRENT-GATE-2: the second sample in a row is believed, whatever it says. */
static void test_a_jump_is_believed_when_it_stays(void)
{
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_GOOD, judge(2.5f, -0.5f));
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_SPIKE, judge(2.51f, -0.5f));
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_GOOD, judge(2.51f, -0.5f));
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_GOOD, judge(1.0f, -0.5f));
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_SPIKE, judge(1.0f, -2.01f));
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_GOOD, judge(1.0f, 1.0f));
    TEST_ASSERT_EQUAL_UINT16(2U, gate.ignored);
    in.expected = false;
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_GOOD, judge(5.0f, -0.5f));
    TEST_ASSERT_EQUAL_INT(CURRENT_GATE_TRIP, judge(8.1f, -0.5f)); /* no law runs */
}

static void test_count_stays_at_its_end(void)
{
    for (uint32_t n = 0; n < 140000U; n++) {
        (void)judge(((n % 2U) == 0U) ? 3.0f : 1.0f, -0.5f);
    }
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, gate.ignored);
}

static void test_replaced_currents_are_the_expected_ones(void)
{
    const drive_sample_t s = {
        .ia_A = 9.0f, .ib_A = 9.0f, .dc_link_V = 295.0f, .theta_e_rad = 2.0f, .valid = true};
    for (int k = -30; k <= 30; k++) {
        const dq_t           i_A = {.d = -0.7f, .q = 2.0f};
        const float          at  = 0.1f * (float)k;
        const drive_sample_t r   = current_gate_replaced(&s, i_A, at);
        const dq_t           got = sample_current_A(&r, at);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, -0.7, (double)got.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 2.0, (double)got.q);
        TEST_ASSERT_TRUE((r.theta_e_rad == 2.0f) && (r.dc_link_V == 295.0f) && r.valid);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_of_three_trip);
    RUN_TEST(test_every_phase_counts);
    RUN_TEST(test_not_a_number_trips_at_once);
    RUN_TEST(test_a_jump_is_believed_when_it_stays);
    RUN_TEST(test_count_stays_at_its_end);
    RUN_TEST(test_replaced_currents_are_the_expected_ones);
    return UNITY_END();
}
