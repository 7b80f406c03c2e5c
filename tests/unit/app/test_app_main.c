/* SPDX-License-Identifier: MIT */
/* main.c is compiled with main renamed to firmware_main, and yields to test_yield(). */
#include <setjmp.h>

#include "app.h"
#include "board_config.h"
#include "fake_board.h"
#include "prepare.h"
#include "unity.h"
#include "yield.h"

int firmware_main(void);

static jmp_buf      out_of_main;
static volatile int passes;
static int          passes_wanted;
static bool         prepares;
static int          events_before_prepare;

bool board_prepare(void)
{
    events_before_prepare = fake_board.event_count;
    return prepares;
}

void test_yield(void)
{
    passes++;
    if (fake_board.tick != NULL) {
        fake_board.tick();
    }
    if (passes >= passes_wanted) {
        longjmp(out_of_main, 1);
    }
}

static void run_main(int count)
{
    passes        = 0;
    passes_wanted = count;
    if (setjmp(out_of_main) == 0) {
        (void)firmware_main();
    }
}

void setUp(void)
{
    fake_board_reset();
    prepares              = true;
    events_before_prepare = -1;
}

void tearDown(void) {}

static void test_board_comes_first_and_ticks_start_last(void)
{
    run_main(1);

    TEST_ASSERT_EQUAL_INT(0, events_before_prepare);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_INIT, fake_board.events[0]);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_START, fake_board.events[1]);
    TEST_ASSERT_EQUAL_UINT32(board_config.board.pwm_cycles, fake_board.setup->pwm_cycles);
    TEST_ASSERT_EQUAL_UINT16(board_config.board.positions, fake_board.setup->positions);
    TEST_ASSERT_TRUE(fake_board.tick == app_tick);
    TEST_ASSERT_FALSE(fake_board.gate);
}

static void test_background_runs_and_serves_the_watchdog(void)
{
    run_main(2000);

    TEST_ASSERT_EQUAL_INT(1999, fake_board.served); /* the first pass came before any tick */
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, app_status_read().mode);
}

static void test_board_that_did_not_start_stays_off_for_good(void)
{
    fake_board.init_result = false;
    run_main(5000);

    TEST_ASSERT_TRUE(fake_board.tick == NULL);
    TEST_ASSERT_EQUAL_INT(0, fake_board.served);
    TEST_ASSERT_EQUAL_INT(2, fake_board.event_count);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_TRIP, fake_board.events[1]);
}

static void test_board_that_is_not_prepared_is_not_set_up(void)
{
    prepares = false;
    run_main(5000);

    TEST_ASSERT_TRUE(fake_board.tick == NULL);
    TEST_ASSERT_EQUAL_INT(0, fake_board.served);
    TEST_ASSERT_EQUAL_INT(1, fake_board.event_count);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_TRIP, fake_board.events[0]);
}

static void test_main_can_run_again_from_the_start(void)
{
    run_main(2000);
    run_main(10);
    TEST_ASSERT_EQUAL_INT(APP_MODE_BOOT, app_status_read().mode);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_board_comes_first_and_ticks_start_last);
    RUN_TEST(test_background_runs_and_serves_the_watchdog);
    RUN_TEST(test_board_that_did_not_start_stays_off_for_good);
    RUN_TEST(test_board_that_is_not_prepared_is_not_set_up);
    RUN_TEST(test_main_can_run_again_from_the_start);
    return UNITY_END();
}
