/* SPDX-License-Identifier: MIT */
/* Dead times that TIM1's generator has, by the four ranges of its code in RM0440. */
#include "peripherals.h"
#include "unity.h"

#define CODES    256U
#define MOST_cnt 1008U

void setUp(void) {}
void tearDown(void) {}

/* Counts of a code: the upper bits choose step and offset. */
static uint32_t counts_of(uint32_t code)
{
    uint32_t counts = code;

    if (code >= 0xE0U) {
        counts = (32U + (code & 0x1FU)) * 16U;
    } else if (code >= 0xC0U) {
        counts = (32U + (code & 0x1FU)) * 8U;
    } else if (code >= 0x80U) {
        counts = (64U + (code & 0x3FU)) * 2U;
    } else {
        /* one step is one count */
    }
    return counts;
}

static void test_every_code_is_found(void)
{
    for (uint32_t code = 1U; code < CODES; code++) {
        TEST_ASSERT_EQUAL_UINT32(code, pwm_dead_time((uint16_t)counts_of(code)));
    }
}

static void test_others_are_refused(void)
{
    uint32_t refused = 0U;

    for (uint32_t counts = 0U; counts <= 65535U; counts++) {
        const uint32_t code = pwm_dead_time((uint16_t)counts);

        refused += (code == 0U) ? 1U : 0U;
        TEST_ASSERT_TRUE((code == 0U) || (counts_of(code) == counts));
    }
    TEST_ASSERT_EQUAL_UINT32(65536U - (CODES - 1U), refused);
    TEST_ASSERT_EQUAL_UINT32(MOST_cnt, counts_of(CODES - 1U));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_code_is_found);
    RUN_TEST(test_others_are_refused);
    return UNITY_END();
}
