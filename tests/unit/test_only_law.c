/* SPDX-License-Identifier: MIT */
/* Built with DRIVE_ONLY_LAW, once for each law; the shipped tables are of DRIVE_LAW_NOC. */
#include "drive_config.h"
#include "gain_tables.h"
#include "unity.h"

void setUp(void) {}

void tearDown(void) {}

static void test_tables_of_another_law_are_refused(void)
{
    const ctl_status_t expected = (DRIVE_ONLY_LAW == DRIVE_LAW_NOC) ? CTL_OK : CTL_BAD_CONFIG;

    TEST_ASSERT_EQUAL_INT(DRIVE_LAW_NOC, gain_tables_drive.law);
    TEST_ASSERT_EQUAL_INT(expected, drive_config_check(&gain_tables_drive));
}

static void test_the_law_is_its_own_only(void)
{
    TEST_ASSERT_TRUE(DRIVE_HAS_LAW(DRIVE_ONLY_LAW));
    TEST_ASSERT_EQUAL_INT(1, (DRIVE_HAS_LAW(DRIVE_LAW_NOC) ? 1 : 0) +
                                 (DRIVE_HAS_LAW(DRIVE_LAW_NOC_H) ? 1 : 0) +
                                 (DRIVE_HAS_LAW(DRIVE_LAW_CONVENTIONAL) ? 1 : 0) +
                                 (DRIVE_HAS_LAW(DRIVE_LAW_SERVO) ? 1 : 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_tables_of_another_law_are_refused);
    RUN_TEST(test_the_law_is_its_own_only);
    return UNITY_END();
}
