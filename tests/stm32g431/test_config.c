/* SPDX-License-Identifier: MIT */
/* The constants that are compiled into the image of the B-G431B-ESC1, on the host. */
#include "app_board_check.h"
#include "app_config_check.h"
#include "board_config.h"
#include "clock_tree.h"
#include "gain_tables.h"
#include "unity.h"

#define SHUNT_Ohm   0.003
#define SUPPLY_V    3.3
#define PIN_PER_V   (4.0 / 7.0) /* of the shunt's voltage, behind 1.5 kOhm, 2.2 kOhm and 22 kOhm */
#define PIN_ZERO_V  (0.9 / 7.0)
#define PIN_GAIN    16.0
#define SETTLE_s    1.3e-6 /* of the amplifiers, after a lower switch is on */
#define SAMPLE_6_5  6.5    /* converter clocks */
#define CONVERT_cnt 12.5

void setUp(void) {}
void tearDown(void) {}

static void test_identity_is_whole(void)
{
    TEST_ASSERT_EQUAL_HEX32(board_identity_sum(&board_identity), board_identity.sum);
}

static void test_tables_and_constants_are_of_this_board(void)
{
    const board_difference_t found =
        app_board_check(&board_identity, &board_config, &gain_tables_drive);

    TEST_ASSERT_EQUAL_STRING("b_g431b_esc1", board_identity.name);
    TEST_ASSERT_EQUAL_STRING("", board_field_name(found.field));
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_config_check(&board_config, &gain_tables_drive));
}

/* board_fits() of board.c: a count is a cycle. */
static void test_period_is_that_of_the_timer(void)
{
    const double period_s = (double)board_config.board.pwm_cycles / CLOCK_SYSCLK_Hz;

    TEST_ASSERT_EQUAL_UINT32(2UL * board_config.board.duty_full_cnt, board_config.board.pwm_cycles);
    TEST_ASSERT_TRUE(board_config.board.pwm_cycles <= CLOCK_PERIOD_MAX_cycles);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7 * period_s, period_s, (double)board_config.pwm_period_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 50e-6, period_s);
}

static void test_currents_are_those_of_network_and_amplifier(void)
{
    const double A_per_cnt = SUPPLY_V / (SHUNT_Ohm * PIN_PER_V * PIN_GAIN) / BOARD_ADC_CODES;
    const double zero_cnt  = PIN_ZERO_V * PIN_GAIN / SUPPLY_V * BOARD_ADC_CODES;
    const double off_cnt   = zero_cnt - (double)board_config.scale.current_zero_cnt;

    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * A_per_cnt, A_per_cnt,
                              (double)board_config.scale.current_A_per_cnt);
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 505.0, off_cnt);
    TEST_ASSERT_TRUE(off_cnt < (double)board_config.scale.offset_max_cnt);
}

/* A lower switch is on for the rest of the period less the dead times. Half of it lies before the
 * samples at the counter's top: the amplifier has to settle. Half lies after: c is held last. */
static void test_shunts_are_read_at_the_largest_duty(void)
{
    const double count_s = 1.0 / CLOCK_SYSCLK_Hz;
    const double off_s =
        (double)(board_config.board.duty_full_cnt - board_config.gate.duty_max_cnt) * count_s;
    const double dead_s   = board_config.board.dead_time_cnt * count_s;
    const double before_s = off_s - dead_s;
    const double held_s   = (2.0 * SAMPLE_6_5 + CONVERT_cnt) / CLOCK_ADCCLK_Hz;

    TEST_ASSERT_TRUE(before_s > (SETTLE_s - 1e-12));
    TEST_ASSERT_TRUE(off_s >= held_s);
    TEST_ASSERT_TRUE(before_s < 1.05 * SETTLE_s); /* and no more voltage is given away */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_identity_is_whole);
    RUN_TEST(test_tables_and_constants_are_of_this_board);
    RUN_TEST(test_period_is_that_of_the_timer);
    RUN_TEST(test_currents_are_those_of_network_and_amplifier);
    RUN_TEST(test_shunts_are_read_at_the_largest_duty);
    return UNITY_END();
}
