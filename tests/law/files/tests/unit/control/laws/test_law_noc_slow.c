/* SPDX-License-Identifier: MIT */
#include "law_noc_slow.h"

#include "drive_tick.h"
#include "gain_tables.h"
#include "unity.h"

void setUp(void) {}

void tearDown(void) {}

static void test_a_share_of_nothing_is_refused(void)
{
    static law_noc_slow_config_t constants;
    static drive_t               drive;
    drive_config_t               config = gain_tables_drive;

    config.law       = &law_noc_slow;
    config.constants = &constants;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_share_of_nothing_is_refused);
    return UNITY_END();
}
