/* SPDX-License-Identifier: MIT */
#include "bridge.h"

#include "unit_support.h"
#include "unity.h"

void setUp(void) {}
void tearDown(void) {}

static void test_open_bridge_has_no_gate_and_no_voltage(void)
{
    const bridge_t b = bridge_open();

    TEST_ASSERT_FALSE(b.gate_enable);
    TEST_ASSERT_TRUE((b.duty.a == 0.5f) && (b.duty.b == 0.5f) && (b.duty.c == 0.5f));
}

static void test_closed_bridge_switches_with_the_ratios_it_is_given(void)
{
    const abc_t duty = {.a = 0.25f, .b = 0.5f, .c = 0.875f};

    const bridge_t b = bridge_closed(duty);

    TEST_ASSERT_TRUE(b.gate_enable);
    TEST_ASSERT_TRUE((b.duty.a == 0.25f) && (b.duty.b == 0.5f) && (b.duty.c == 0.875f));
}

static void test_ends_of_the_range_are_ratios(void)
{
    const abc_t duty = {.a = 0.0f, .b = 1.0f, .c = 0.0f};

    const bridge_t b = bridge_closed(duty);

    TEST_ASSERT_TRUE((b.duty.a == 0.0f) && (b.duty.b == 1.0f) && (b.duty.c == 0.0f));
}

/* One phase is limited, the others are what they were. */
static void test_each_phase_is_limited_by_itself(void)
{
    const float bad[]  = {-0.001f, 1.001f, -1.0e9f, 1.0e9f, -INFINITY, INFINITY, NAN};
    const float want[] = {0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f};

    for (int i = 0; i < SUPPORT_COUNT(bad); i++) {
        const abc_t in_a = {.a = bad[i], .b = 0.3f, .c = 0.7f};
        const abc_t in_b = {.a = 0.3f, .b = bad[i], .c = 0.7f};
        const abc_t in_c = {.a = 0.3f, .b = 0.7f, .c = bad[i]};

        const bridge_t a = bridge_closed(in_a);
        const bridge_t b = bridge_closed(in_b);
        const bridge_t c = bridge_closed(in_c);

        TEST_ASSERT_TRUE((a.duty.a == want[i]) && (a.duty.b == 0.3f) && (a.duty.c == 0.7f));
        TEST_ASSERT_TRUE((b.duty.a == 0.3f) && (b.duty.b == want[i]) && (b.duty.c == 0.7f));
        TEST_ASSERT_TRUE((c.duty.a == 0.3f) && (c.duty.b == 0.7f) && (c.duty.c == want[i]));
        TEST_ASSERT_TRUE(a.gate_enable && b.gate_enable && c.gate_enable);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_open_bridge_has_no_gate_and_no_voltage);
    RUN_TEST(test_closed_bridge_switches_with_the_ratios_it_is_given);
    RUN_TEST(test_ends_of_the_range_are_ratios);
    RUN_TEST(test_each_phase_is_limited_by_itself);
    return UNITY_END();
}
