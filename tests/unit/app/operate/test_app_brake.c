/* SPDX-License-Identifier: MIT */
#include "app_brake.h"

#include "app_slow.h"
#include "unity.h"

#define STILL_TURNS 20U

/* The oracle keeps asks and output beside the brake. */
typedef struct {
    bool     used;    /* when the bridge was last off */
    bool     high;    /* the output */
    bool     by_off;  /* low because the bridge went off */
    uint32_t held;    /* for so many periods */
    uint32_t closing; /* so many turns of asks to close, in a row */
} history_t;

static app_brake_t   brake;
static app_objects_t objects;
static history_t     history;
static uint32_t      random_state;

void setUp(void)
{
    const app_objects_t none  = {.brake_used = 1U, .brake_release_ms = 20U, .brake_close_ms = 10U};
    const history_t     start = {.by_off = true};

    objects      = none;
    history      = start;
    random_state = 1UL;
    app_brake_init(&brake);
}

void tearDown(void) {}

static uint32_t random_below(uint32_t limit)
{
    random_state = (random_state * (uint32_t)1664525UL) + (uint32_t)1013904223UL;
    return (random_state >> 8) % limit;
}

/* The level that an ask allows. */
static void assert_level(app_brake_ask_t ask, bool held_before)
{
    const bool high = app_brake_output(brake.state);

    if (ask == APP_BRAKE_BRIDGE_OFF) {
        TEST_ASSERT_FALSE(high);
    } else if ((ask == APP_BRAKE_RELEASE) && history.used) {
        TEST_ASSERT_TRUE(high);
    } else if ((ask == APP_BRAKE_CLOSE) && history.high && !held_before) { /* it was released */
        TEST_ASSERT_TRUE(high || (history.closing >= STILL_TURNS));
        TEST_ASSERT_TRUE(!high || (history.closing <= (STILL_TURNS + 2U)));
    } else if ((ask == APP_BRAKE_CLOSE) && history.high) {
        TEST_ASSERT_FALSE(high);
    } else {
        TEST_ASSERT_EQUAL_INT(history.high, high);
    }
}

static void remember(app_brake_ask_t ask, bool turn, bool held_before)
{
    history.used    = (ask == APP_BRAKE_BRIDGE_OFF) ? (objects.brake_used != 0U) : history.used;
    history.closing = (ask == APP_BRAKE_CLOSE) ? (history.closing + (turn ? 1U : 0U)) : 0U;
    assert_level(ask, held_before);
    if (history.high != app_brake_output(brake.state)) {
        history.held   = 0U;
        history.by_off = false;
    }
    history.high   = app_brake_output(brake.state);
    history.by_off = history.by_off || (ask == APP_BRAKE_BRIDGE_OFF);
}

/* Is at least the time, and at most three turns more. */
static void assert_times(float ts_s)
{
    const float slack_s   = 3.0f * app_slow_s(ts_s);
    const float release_s = 1.0e-3f * (float)objects.brake_release_ms;
    const float close_s   = 1.0e-3f * (float)objects.brake_close_ms;
    const float held_s    = (float)history.held * ts_s;

    if (!history.used) {
        TEST_ASSERT_EQUAL_INT(APP_BRAKE_NONE, brake.state);
        TEST_ASSERT_FALSE(app_brake_may_hold(brake.state));
        TEST_ASSERT_FALSE(app_brake_may_be_open(brake.state));
    } else if (history.high) {
        TEST_ASSERT_TRUE(app_brake_may_be_open(brake.state));
        TEST_ASSERT_TRUE(app_brake_may_hold(brake.state) || (held_s >= release_s));
        TEST_ASSERT_TRUE(!app_brake_may_hold(brake.state) || (held_s <= (release_s + slack_s)));
    } else {
        TEST_ASSERT_TRUE(app_brake_may_hold(brake.state));
        TEST_ASSERT_TRUE(!app_brake_may_be_open(brake.state) || !history.by_off);
        TEST_ASSERT_TRUE(app_brake_may_be_open(brake.state) || history.by_off ||
                         (held_s >= close_s));
        TEST_ASSERT_TRUE(!app_brake_may_be_open(brake.state) || (held_s <= (close_s + slack_s)));
    }
}

/* Periods with one ask; the turn comes once in `turns`. */
static void ask_for(app_brake_ask_t ask, uint32_t periods, float ts_s, bool only_at_turns)
{
    static uint32_t period = 0UL;

    for (uint32_t n = 0UL; n < periods; n++) {
        const bool turn = (period % app_slow_periods(ts_s)) == 0UL;

        period++;
        if (turn || !only_at_turns) {
            const bool held_before = app_brake_may_hold(brake.state);

            app_brake_tick(&brake, &objects, ask, turn, ts_s);
            remember(ask, turn, held_before);
            assert_times(ts_s);
        }
        history.held++;
    }
}

static void test_times_are_kept_in_any_sequence(void)
{
    static const float    periods_s[] = {50.0e-6f, 100.0e-6f, 125.013e-6f, 200.0e-6f, 436.9e-6f};
    static const uint16_t times_ms[]  = {0U, 1U, 2U, 17U, 100U, 5000U};

    for (int p = 0; p < 5; p++) {
        for (int r = 0; r < 6; r++) {
            for (int c = 0; c < 6; c++) {
                const bool law = ((p + r + c) % 2) == 0; /* it acts at turns only */

                setUp();
                objects.brake_release_ms = times_ms[r];
                objects.brake_close_ms   = times_ms[c];
                random_state             = (uint32_t)((36 * p) + (6 * r) + c + 1);
                for (int n = 0; n < 60; n++) {
                    const app_brake_ask_t ask = (app_brake_ask_t)random_below(4U);
                    const uint32_t        most =
                        1U + (uint32_t)((2.0e-3f * (float)(times_ms[r] + times_ms[c] + 15)) /
                                        periods_s[p]);

                    ask_for(ask, 1U + random_below(most), periods_s[p], law);
                }
            }
        }
    }
}

static void test_a_start_and_a_stop_pass_each_state_once(void)
{
    static const app_brake_state_t states[] = {APP_BRAKE_CLOSED, APP_BRAKE_RELEASING,
                                               APP_BRAKE_RELEASED, APP_BRAKE_CLOSING,
                                               APP_BRAKE_CLOSED};
    static const app_brake_ask_t asks[] = {APP_BRAKE_BRIDGE_OFF, APP_BRAKE_KEEP, APP_BRAKE_RELEASE,
                                           APP_BRAKE_KEEP, APP_BRAKE_CLOSE};
    int                          seen   = 0;

    for (int k = 0; k < 5; k++) {
        for (int n = 0; n < 500; n++) { /* 100 ms */
            app_brake_tick(&brake, &objects, asks[k], (n % 5) == 0, 200.0e-6f);
            if (brake.state != states[seen]) {
                seen++;
                TEST_ASSERT_TRUE(seen < 5);
                TEST_ASSERT_EQUAL_INT(states[seen], brake.state);
            }
        }
    }
    TEST_ASSERT_EQUAL_INT(4, seen);
}

/* The setting comes into use, and out of use, with the bridge off. */
static void test_a_setting_acts_with_the_bridge_off(void)
{
    objects.brake_used = 0U;
    ask_for(APP_BRAKE_BRIDGE_OFF, 10U, 200.0e-6f, false);
    ask_for(APP_BRAKE_RELEASE, 10U, 200.0e-6f, false);
    objects.brake_used = 1U;
    ask_for(APP_BRAKE_RELEASE, 1000U, 200.0e-6f, false);
    TEST_ASSERT_EQUAL_INT(APP_BRAKE_NONE, brake.state);
    ask_for(APP_BRAKE_BRIDGE_OFF, 1U, 200.0e-6f, false);
    TEST_ASSERT_EQUAL_INT(APP_BRAKE_CLOSED, brake.state);
    ask_for(APP_BRAKE_RELEASE, 1000U, 200.0e-6f, false);
    objects.brake_used = 0U;
    ask_for(APP_BRAKE_RELEASE, 1000U, 200.0e-6f, false);
    TEST_ASSERT_EQUAL_INT(APP_BRAKE_RELEASED, brake.state);
    ask_for(APP_BRAKE_BRIDGE_OFF, 1U, 200.0e-6f, false);
    TEST_ASSERT_EQUAL_INT(APP_BRAKE_NONE, brake.state);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_times_are_kept_in_any_sequence);
    RUN_TEST(test_a_start_and_a_stop_pass_each_state_once);
    RUN_TEST(test_a_setting_acts_with_the_bridge_off);
    return UNITY_END();
}
