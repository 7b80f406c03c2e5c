/* SPDX-License-Identifier: MIT */
#include "app_believe.h"

#include <math.h>
#include <string.h>

#include "gain_tables.h"
#include "unity.h"

static const drive_config_t *own;
static app_believe_t         b;
static bool                  made;

static const drive_config_t *choose(const drive_config_t *in_force, float ratio)
{
    return app_believe_choose(&b, own, in_force, ratio, &made);
}

void setUp(void)
{
    own = &gain_tables_drive;
    app_believe_init(&b, own);
}

void tearDown(void) {}

static void test_the_drives_own_inertia_has_its_own_constants(void)
{
    const float same[] = {1.0f, 0.921f, 1.079f};

    for (int i = 0; i < 3; i++) {
        TEST_ASSERT_TRUE(choose(own, same[i]) == own);
        TEST_ASSERT_FALSE(made);
        TEST_ASSERT_TRUE(choose(&b.drive, same[i]) == own);
    }
}

static void test_another_ratio_makes_the_second_set(void)
{
    TEST_ASSERT_TRUE(choose(own, 2.0f) == &b.drive);
    TEST_ASSERT_TRUE(made);
    TEST_ASSERT_TRUE(b.ratio == 2.0f);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 0.5f * own->motor.l1, b.drive.motor.l1);
    TEST_ASSERT_TRUE(b.drive.constants == &b.constants);
}

/* While it is in force no bit of it changes, whatever is asked. */
static void test_the_set_in_force_stays_as_it_is(void)
{
    TEST_ASSERT_TRUE(choose(own, 2.0f) == &b.drive);
    const app_believe_t before  = b;
    const float         asked[] = {2.15f, 1.85f, 2.2f, 1.8f, 0.5f, 5.0f, 1.0f};

    for (int i = 0; i < 7; i++) {
        const drive_config_t *next = choose(&b.drive, asked[i]);

        TEST_ASSERT_FALSE(made);
        TEST_ASSERT_TRUE(next == ((i < 2) ? &b.drive : own));
        TEST_ASSERT_EQUAL_MEMORY(&before, &b, sizeof b);
    }
    TEST_ASSERT_TRUE(choose(own, 2.2f) == &b.drive); /* once the own ones are in force */
    TEST_ASSERT_TRUE(made && (b.ratio == 2.2f));
}

/* A ratio beyond the certified range, which the law bounds, does not lead to and fro. */
static void test_a_bounded_ratio_stays(void)
{
    TEST_ASSERT_TRUE(choose(own, 0.5f) == &b.drive);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.6f, b.ratio);
    TEST_ASSERT_TRUE(choose(&b.drive, 0.5f) == &b.drive);
}

static void test_no_number_is_the_drives_own(void)
{
    TEST_ASSERT_TRUE(choose(own, NAN) == own);
    TEST_ASSERT_TRUE(choose(own, 0.0f) == own);
    TEST_ASSERT_TRUE(choose(own, -2.0f) == own);
}

static void test_a_law_with_one_inertia_keeps_it(void)
{
    law_t          one  = *gain_tables_drive.law;
    drive_config_t copy = gain_tables_drive;

    one.believe = NULL;
    copy.law    = &one;
    own         = &copy;
    TEST_ASSERT_TRUE(choose(own, 2.0f) == own);
    TEST_ASSERT_FALSE(made);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_drives_own_inertia_has_its_own_constants);
    RUN_TEST(test_another_ratio_makes_the_second_set);
    RUN_TEST(test_the_set_in_force_stays_as_it_is);
    RUN_TEST(test_a_bounded_ratio_stays);
    RUN_TEST(test_no_number_is_the_drives_own);
    RUN_TEST(test_a_law_with_one_inertia_keeps_it);
    return UNITY_END();
}
