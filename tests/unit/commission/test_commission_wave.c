/* SPDX-License-Identifier: MIT */
#include "commission_wave.h"

#include "unit_support.h"
#include "unity.h"

#define TS_s    2.0e-4
#define BOUND_A 8.0
#define LINK_V  540.0f
#define TICKS   4000

typedef struct {
    double peak_A;
    double mean_A;     /* of the second half */
    int    half_waves; /* after the height was found */
    bool   found;
} swung_t;

/* A winding; what is asked for at a sample acts from the next one to the one after. */
static swung_t swing_of(double l_H, double r_Ohm, float noise_A, unsigned seed)
{
    support_random_t  random_state = {seed};
    commission_wave_t w;
    swung_t           out    = {0.0, 0.0, 0, false};
    double            i_A    = 0.0;
    double            before = 0.0;
    float             last_A = 0.0f;
    commission_wave_start(&w, (float)BOUND_A, 250, 1.0e9f);
    for (int k = 0; k < TICKS; k++) {
        const float  seen_A = (float)i_A + (noise_A * support_uniform(&random_state, -1.0f, 1.0f));
        const double v_V    = (double)commission_wave_tick(&w, seen_A, seen_A - last_A, LINK_V);
        const double decay  = exp(-r_Ohm * TS_s / l_H);
        last_A              = seen_A;
        i_A                 = (i_A * decay) + ((before / r_Ohm) * (1.0 - decay));
        before              = v_V;
        out.peak_A          = fmax(out.peak_A, fabs(i_A));
        out.mean_A += (k >= (TICKS / 2)) ? (i_A / (TICKS / 2)) : 0.0;
    }
    out.half_waves = w.halves;
    out.found      = w.found;
    return out;
}

static swung_t swing(double l_H, double r_Ohm, float noise_A)
{
    return swing_of(l_H, r_Ohm, noise_A, 17u);
}

void setUp(void) {}
void tearDown(void) {}

/* Over more than two decades of inductance, none of which the wave is told. */
static void test_current_never_exceeds_its_bound(void)
{
    for (double l_H = 0.003; l_H < 0.9; l_H *= 1.37) {
        const swung_t s = swing(l_H, 0.5, 0.0f);

        TEST_ASSERT_TRUE(s.peak_A <= (BOUND_A * 1.0001));
        TEST_ASSERT_TRUE(s.peak_A > (0.6 * BOUND_A));
        TEST_ASSERT_TRUE(s.found);
        TEST_ASSERT_TRUE(s.half_waves > 10);
    }
}

static void test_noise_adds_no_more_than_itself(void)
{
    for (double l_H = 0.003; l_H < 0.9; l_H *= 1.37) {
        TEST_ASSERT_TRUE(swing(l_H, 0.5, 0.05f).peak_A <= (BOUND_A + 0.3));
    }
}

/* The noise is a 14th of the bound, as of 3 A and 10 mA in LOOK. Its peaks end half waves. */
static void test_a_noise_peak_does_not_end_the_search(void)
{
    for (unsigned seed = 1u; seed <= 400u; seed++) {
        const swung_t s = swing_of(0.1, 0.5, 1.0f, seed);

        TEST_ASSERT_TRUE(s.found);
        TEST_ASSERT_TRUE(s.peak_A > (0.3 * BOUND_A));
        TEST_ASSERT_TRUE(s.half_waves > 40);
    }
}

/* An amplitude that does not move the current is searched again. */
static void test_an_amplitude_that_is_too_small_grows_again(void)
{
    commission_wave_t w;
    commission_wave_start(&w, (float)BOUND_A, 250, 1.0e9f);
    w.v_V    = 1.0f;
    w.found  = true;
    w.halves = 7;
    for (int k = 0; k < TICKS; k++) {
        (void)commission_wave_tick(&w, 0.0f, 0.0f, LINK_V);
    }
    TEST_ASSERT_TRUE(w.v_V > (0.4f * LINK_V));
}

/* A proved amplitude, or the largest one, does not move the current of a dead sensor. */
static void test_a_current_that_does_not_answer_is_lost(void)
{
    for (int proved = 0; proved < 2; proved++) {
        commission_wave_t w;
        int               ticks = 0;
        commission_wave_start(&w, (float)BOUND_A, 36, 10.0f);
        w.v_V   = 1.0f;
        w.found = proved != 0;
        while (!w.lost && (ticks < TICKS)) {
            (void)commission_wave_tick(&w, 0.0f, 0.0f, LINK_V);
            ticks++;
        }
        TEST_ASSERT_TRUE(w.v_V <= 10.0f);
        /* One half wave, or eleven that grow by a quarter. */
        TEST_ASSERT_EQUAL_INT((proved != 0) ? 36 : (12 * 16), ticks);
    }
}

/* A sensor that has died with a current: one direction is at its bound at once, the other never. */
static void test_short_and_long_half_waves_in_turn_are_lost(void)
{
    commission_wave_t w;
    int               ticks = 0;
    commission_wave_start(&w, (float)BOUND_A, 36, 1.0e9f);
    while (!w.lost && (ticks < 200)) {
        (void)commission_wave_tick(&w, (float)(1.1 * BOUND_A), 0.0f, LINK_V);
        ticks++;
    }
    TEST_ASSERT_TRUE(w.lost);
    TEST_ASSERT_TRUE(w.v_V < (4.0f * 0.002f * LINK_V));
}

static void test_mean_current_is_small(void)
{
    for (double l_H = 0.02; l_H < 0.9; l_H *= 1.37) {
        /* A tenth: the samples do not fall on the bounds. */
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * BOUND_A, 0.0, swing(l_H, 0.5, 0.0f).mean_A);
    }
}

/* L / R of four periods: hardly more than the current needs to settle. */
static void test_a_resistive_winding_swings_too(void)
{
    const swung_t s = swing(0.004, 5.0, 0.0f);

    TEST_ASSERT_TRUE(s.found);
    TEST_ASSERT_TRUE(s.peak_A <= (BOUND_A * 1.0001));
    TEST_ASSERT_TRUE(s.peak_A > (0.5 * BOUND_A));
}

static void test_height_is_within_its_share_of_the_dc_link(void)
{
    commission_wave_t w;
    commission_wave_start(&w, (float)BOUND_A, 250, 1.0e9f);
    for (int k = 0; k < TICKS; k++) {
        const float v_V = commission_wave_tick(&w, 0.0f, 0.0f, LINK_V); /* an open phase */
        TEST_ASSERT_TRUE(fabsf(v_V) <= (0.4501f * LINK_V));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_current_never_exceeds_its_bound);
    RUN_TEST(test_noise_adds_no_more_than_itself);
    RUN_TEST(test_a_noise_peak_does_not_end_the_search);
    RUN_TEST(test_an_amplitude_that_is_too_small_grows_again);
    RUN_TEST(test_a_current_that_does_not_answer_is_lost);
    RUN_TEST(test_short_and_long_half_waves_in_turn_are_lost);
    RUN_TEST(test_mean_current_is_small);
    RUN_TEST(test_a_resistive_winding_swings_too);
    RUN_TEST(test_height_is_within_its_share_of_the_dc_link);
    return UNITY_END();
}
