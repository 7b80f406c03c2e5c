/* SPDX-License-Identifier: MIT */
#include "fpu.h"

#include <float.h>

#include "unit_support.h"
#include "unity.h"

/* Units of the last place. */
#define TOL_INVERSE      2.0
#define TOL_INVERSE_ROOT 2.5
#define TOL_ROOT         3.0

/* Mantissas of a sweep: with 1 in place of it, all of them, the bounds hold too. A prime, so that all last digits appear. */
#define STRIDE 61

/* An estimate is off by this at the most: 2^-8, and a quarter of that. */
#define OFF 4.8828125e-3
static const double offs[] = {0.0, OFF, -OFF, 0.3 * OFF, -0.7 * OFF};

void setUp(void) {}
void tearDown(void) {}

static double units(float x, double exact)
{
    int exponent = 0;

    (void)frexp(exact, &exponent);
    return fabs((double)x - exact) / ldexp(1.0, exponent - FLT_MANT_DIG);
}

static void check_inverse(float x)
{
    const double exact = 1.0 / (double)x;

    for (int i = 0; i < SUPPORT_COUNT(offs); i++) {
        const float y = fpu_inverse_from(x, (float)(exact * (1.0 + offs[i])));
        TEST_ASSERT_TRUE(units(y, exact) <= TOL_INVERSE);
    }
    TEST_ASSERT_TRUE(units(fpu_inverse(x), exact) <= TOL_INVERSE);
}

static void check_root(float x)
{
    const double exact = 1.0 / sqrt((double)x);

    for (int i = 0; i < SUPPORT_COUNT(offs); i++) {
        const float y = fpu_inverse_root_from(x, (float)(exact * (1.0 + offs[i])));
        TEST_ASSERT_TRUE(units(y, exact) <= TOL_INVERSE_ROOT);
        TEST_ASSERT_TRUE(units(x * y, sqrt((double)x)) <= TOL_ROOT);
    }
    TEST_ASSERT_TRUE(units(fpu_inverse_root(x), exact) <= TOL_INVERSE_ROOT);
    TEST_ASSERT_TRUE(units(fpu_root(x), sqrt((double)x)) <= TOL_ROOT);
}

static void test_inverse_of_every_mantissa(void)
{
    for (int32_t m = 0; m < (1L << 23); m += STRIDE) {
        const float x = 1.0f + ((float)m * FLT_EPSILON);
        check_inverse(((m % 2) == 0) ? x : -x);
    }
}

static void test_root_of_every_mantissa(void)
{
    for (int32_t m = 0; m < (1L << 23); m += STRIDE) {
        const float x = 1.0f + ((float)m * FLT_EPSILON);
        check_root(x);
        check_root(2.0f * x);
    }
}

static void test_every_exponent(void)
{
    for (int exponent = -126; exponent <= 127; exponent++) {
        for (int32_t m = 0; m < (1L << 23); m += (1L << 17) - 1L) {
            const float x = ldexpf(1.0f + ((float)m * FLT_EPSILON), exponent);
            check_root(x);
            if (exponent < 125) {
                check_inverse(x);
            }
        }
    }
    check_inverse(ldexpf(1.0f, 125));
    check_root(FLT_MAX);
}

/* Whatever comes out is refused by the check that every answer of a law passes, base_within(). The sanitizer of these tests
 * stops a division by zero, so that zero comes with the estimate that the C28x has for it. */
static void test_what_has_no_inverse_makes_no_number(void)
{
    const float none[] = {INFINITY, -INFINITY, NAN, -NAN};

    for (int i = 0; i < SUPPORT_COUNT(none); i++) {
        TEST_ASSERT_FALSE(base_within(fpu_inverse(none[i]), FLT_MAX));
        TEST_ASSERT_FALSE(base_within(fpu_inverse_root(none[i]), FLT_MAX));
    }
    TEST_ASSERT_FALSE(base_within(fpu_inverse_from(0.0f, INFINITY), FLT_MAX));
    TEST_ASSERT_FALSE(base_within(fpu_inverse_from(-0.0f, -INFINITY), FLT_MAX));
    TEST_ASSERT_FALSE(base_within(fpu_inverse_root_from(0.0f, INFINITY), FLT_MAX));
    TEST_ASSERT_FALSE(base_within(fpu_inverse_root(-1.0f), FLT_MAX));
    TEST_ASSERT_FALSE(base_within(fpu_inverse(ldexpf(1.0f, -140)), FLT_MAX));
}

static void test_root_of_nothing_and_of_less_is_zero(void)
{
    const float less[] = {0.0f, -0.0f, -FLT_MIN, -1.0f, -FLT_MAX, -INFINITY, NAN};

    for (int i = 0; i < SUPPORT_COUNT(less); i++) {
        TEST_ASSERT_TRUE(fpu_root(less[i]) == 0.0f);
    }
    TEST_ASSERT_FALSE(base_within(fpu_root(INFINITY), FLT_MAX));
}

/* A denormal number is zero on the C28x. */
static void test_root_of_a_denormal_number_is_its_own_or_zero(void)
{
    const float tiny = ldexpf(1.0f, -140);

    TEST_ASSERT_TRUE(base_in_range(fpu_root(tiny), 0.0f, 1.001f * sqrtf(tiny)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_inverse_of_every_mantissa);
    RUN_TEST(test_root_of_every_mantissa);
    RUN_TEST(test_every_exponent);
    RUN_TEST(test_what_has_no_inverse_makes_no_number);
    RUN_TEST(test_root_of_nothing_and_of_less_is_zero);
    RUN_TEST(test_root_of_a_denormal_number_is_its_own_or_zero);
    return UNITY_END();
}
