/* SPDX-License-Identifier: MIT */
#include "inertia.h"

#include "unit_support.h"
#include "unity.h"

#define MOST    6000.0f
#define PERIODS 600
#define CASES   200

static inertia_t        inertia;
static support_random_t random_state;

void setUp(void)
{
    random_state.state = 7u;
    inertia_reset(&inertia);
}

void tearDown(void) {}

/* The observer shows d_w = d_0 + (1 - k) a. */
static inertia_seen_t seen_of(float truth, float asked, float seen)
{
    const inertia_seen_t s = {.asked_e_radps2 = asked,
                              .seen_e_radps2  = seen,
                              .more_e_radps2  = (1.0f - truth) * seen,
                              .most_e_radps2  = MOST};
    return s;
}

static void learn(const inertia_seen_t *seen, int periods)
{
    for (int i = 0; i < periods; i++) {
        inertia_learn(&inertia, seen);
    }
}

static void test_learns_every_inertia_of_its_range_in_both_directions(void)
{
    for (int i = 0; i < CASES; i++) {
        const float          truth = support_uniform(&random_state, INERTIA_LEAST, INERTIA_MOST);
        const float          sign  = ((i % 2) == 0) ? 1.0f : -1.0f;
        const float          a     = sign * MOST * support_uniform(&random_state, 0.3f, 1.0f);
        const inertia_seen_t seen  = seen_of(truth, a, a);

        inertia_reset(&inertia);
        learn(&seen, PERIODS);
        TEST_ASSERT_FLOAT_WITHIN(0.01f, truth, inertia.ratio);
        const float gain = (truth < 1.0f) ? truth : (0.5f * (1.0f + truth)); /* EQ-INERTIA-4 */
        TEST_ASSERT_FLOAT_WITHIN(0.01f, gain, inertia.gain);
    }
}

static void test_a_law_limits_the_gain(void)
{
    const inertia_seen_t more = seen_of(3.0f, MOST, MOST);
    const inertia_seen_t less = seen_of(0.6f, MOST, MOST);

    inertia.gain_most = 1.0f;
    learn(&more, PERIODS);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, inertia.gain);
    learn(&less, PERIODS);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, 0.6f, inertia.gain);
}

static void test_learns_slowly(void)
{
    const inertia_seen_t seen = seen_of(3.0f, MOST, MOST);

    learn(&seen, 1);
    TEST_ASSERT_TRUE(inertia.ratio > 1.03f);
    TEST_ASSERT_TRUE(inertia.ratio < 1.04f); /* 0.02 of the way */
}

static void test_learns_from_a_shaft_that_falls_short_of_its_reference(void)
{
    const inertia_seen_t seen = seen_of(3.0f, MOST, 0.5f * MOST);

    learn(&seen, PERIODS);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, 3.0f, inertia.ratio);
}

static void test_a_load_without_acceleration_teaches_nothing(void)
{
    inertia_seen_t load = {.asked_e_radps2 = 0.0f,
                           .seen_e_radps2  = -3000.0f,
                           .more_e_radps2  = -7000.0f,
                           .most_e_radps2  = MOST};

    learn(&load, PERIODS);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, inertia.ratio);
    load.asked_e_radps2 = 0.14f * MOST; /* too little */
    load.seen_e_radps2  = 3000.0f;
    learn(&load, PERIODS);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, inertia.ratio);
    load.asked_e_radps2 = MOST; /* the shaft goes the other way */
    load.seen_e_radps2  = -3000.0f;
    learn(&load, PERIODS);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, inertia.ratio);
}

static void test_stays_in_its_range_with_any_input(void)
{
    const float values[] = {0.0f, 1.0f, -1.0f, 1.0e9f, -1.0e9f, INFINITY, -INFINITY, NAN};

    for (int i = 0; i < (8 * 8 * 8); i++) {
        const inertia_seen_t seen = {.asked_e_radps2 = values[i % 8],
                                     .seen_e_radps2  = values[(i / 8) % 8],
                                     .more_e_radps2  = values[(i / 64) % 8],
                                     .most_e_radps2  = MOST};
        inertia_learn(&inertia, &seen);
        TEST_ASSERT_TRUE((inertia.ratio >= INERTIA_LEAST) && (inertia.ratio <= INERTIA_MOST));
        TEST_ASSERT_TRUE((inertia.gain >= INERTIA_LEAST) && (inertia.gain <= INERTIA_MOST));
    }
}

static void test_adds_what_the_reference_will_ask_for(void)
{
    const inertia_seen_t seen = seen_of(3.0f, MOST, MOST);
    float                sum  = 0.0f;

    TEST_ASSERT_EQUAL_FLOAT(0.0f, inertia_ahead(&inertia, 0.5f * MOST)); /* as believed */
    (void)inertia_ahead(&inertia, 0.0f);
    learn(&seen, 2 * PERIODS);
    for (int i = 1; i <= 10; i++) {
        sum += inertia_ahead(&inertia, 0.1f * (float)i * MOST);
    }
    TEST_ASSERT_FLOAT_WITHIN(0.01f * MOST, -2.0f * MOST, sum); /* (1 - k) a */
    sum += inertia_ahead(&inertia, 0.0f);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f * MOST, 0.0f, sum);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_learns_every_inertia_of_its_range_in_both_directions);
    RUN_TEST(test_a_law_limits_the_gain);
    RUN_TEST(test_learns_slowly);
    RUN_TEST(test_learns_from_a_shaft_that_falls_short_of_its_reference);
    RUN_TEST(test_a_load_without_acceleration_teaches_nothing);
    RUN_TEST(test_stays_in_its_range_with_any_input);
    RUN_TEST(test_adds_what_the_reference_will_ask_for);
    return UNITY_END();
}
