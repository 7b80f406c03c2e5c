/* SPDX-License-Identifier: MIT */
#include "app_board_check.h"

#include <math.h>
#include <stddef.h>

#include "board_config.h"
#include "gain_tables.h"
#include "unity.h"

static board_identity_t board;
static app_config_t     app;
static drive_config_t   drive;
static float            ntc_degC[32];

void setUp(void)
{
    board = board_identity;
    app   = board_config;
    drive = gain_tables_drive;
    for (uint16_t n = 0U; n < app.scale.ntc_points; n++) {
        ntc_degC[n] = board_config.scale.ntc_degC[n];
    }
    app.scale.ntc_degC = ntc_degC;
}

void tearDown(void) {}

static uint16_t field(void)
{
    return app_board_check(&board, &app, &drive).field;
}

static void expect(board_fact_t fact)
{
    TEST_ASSERT_EQUAL_STRING(board_field_name((uint16_t)((uint16_t)fact + 1U)),
                             board_field_name(field()));
}

static void test_the_shipped_constants_are_of_their_board(void)
{
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, field());
}

/* Name of the field that tells of a changed fact. A level is in no constant; the sensor's three facts make one table. */
static uint16_t field_of(uint16_t fact)
{
    if ((fact == (uint16_t)BOARD_FACT_NTC_BETA_K) ||
        (fact == (uint16_t)BOARD_FACT_NTC_DIVIDER_Ohm)) {
        return (uint16_t)BOARD_FACT_NTC_RESISTANCE_Ohm + 1U;
    }
    return (uint16_t)(fact + 1U);
}

/* A limit acts in one direction, an equality in both. A tenth, half, twice, and for zeros a hundredth. */
static void test_every_fact_of_the_board_is_compared_with_the_constants(void)
{
    for (uint16_t n = 0U; n < (uint16_t)BOARD_FACT_COUNT; n++) {
        bool seen = false;
        for (int way = 0; way < 4; way++) {
            setUp();
            const float x[] = {0.1f * board.fact[n], 0.5f * board.fact[n], 2.0f * board.fact[n],
                               board.fact[n] + 0.01f};
            board.fact[n]   = x[way];
            const uint16_t found = field();
            TEST_ASSERT_TRUE((found == (uint16_t)BOARD_FIELD_NONE) || (found == field_of(n)));
            seen = seen || (found != (uint16_t)BOARD_FIELD_NONE);
        }
        TEST_ASSERT_TRUE_MESSAGE(seen || (n == (uint16_t)BOARD_FACT_GATE_ON_LEVEL),
                                 board_field_name((uint16_t)(n + 1U)));
    }
}

static void test_a_shorter_dead_time_is_refused_wherever_it_stands(void)
{
    for (uint16_t cnt = 0U; cnt < 225U; cnt++) {
        app.board.dead_time_cnt = cnt;
        expect(BOARD_FACT_DEAD_TIME_MIN_s);
    }
    app.board.dead_time_cnt = 226U;
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, field());
    app.dead_time_s = 5e-8f;
    expect(BOARD_FACT_DEAD_TIME_MIN_s);
    setUp();
    drive.hardware.dead_time_s = 5e-8f;
    const board_difference_t d = app_board_check(&board, &app, &drive);
    TEST_ASSERT_EQUAL_UINT16((uint16_t)BOARD_FACT_DEAD_TIME_MIN_s + 1U, d.field);
    TEST_ASSERT_TRUE((d.image == 5e-8f) && (d.board == 3e-6f));
    drive.hardware.dead_time_s = NAN;
    expect(BOARD_FACT_DEAD_TIME_MIN_s);
}

static void test_another_scale_is_named(void)
{
    app.scale.current_A_per_cnt *= 0.5f; /* max_current_A = 2 by its default range */
    expect(BOARD_FACT_CURRENT_RANGE_A);
    setUp();
    app.scale.current_zero_cnt = 2040.0f;
    expect(BOARD_FACT_CURRENT_RANGE_A);
    for (int end = 0; end < 2; end++) { /* the other end of the range stays */
        setUp();
        const float zero_cnt        = app.scale.current_zero_cnt;
        const float room_cnt        = (end == 0) ? zero_cnt : (4096.0f - zero_cnt);
        const float ampere          = app.scale.current_A_per_cnt * room_cnt;
        app.scale.current_zero_cnt  = 2050.0f;
        app.scale.current_A_per_cnt = ampere / ((end == 0) ? 2050.0f : (4096.0f - 2050.0f));
        expect(BOARD_FACT_CURRENT_RANGE_A);
    }
    setUp();
    app.scale.dc_link_V_per_cnt *= 1.001f;
    expect(BOARD_FACT_DC_LINK_RANGE_V);
    for (uint16_t n = 0U; n < board_config.scale.ntc_points; n++) {
        setUp();
        ntc_degC[n] += 0.5f;
        expect(BOARD_FACT_NTC_RESISTANCE_Ohm);
        ntc_degC[n] -= 1.0f;
        expect(BOARD_FACT_NTC_RESISTANCE_Ohm);
    }
    setUp();
    app.scale.ntc_first_cnt++;
    expect(BOARD_FACT_NTC_RESISTANCE_Ohm);
    setUp();
    app.scale.ntc_step_cnt--;
    expect(BOARD_FACT_NTC_RESISTANCE_Ohm);
}

static void test_another_clock_is_named(void)
{
    app.pwm_period_s = 2.002e-4f;
    expect(BOARD_FACT_PWM_CLOCK_Hz);
    setUp();
    app.board.duty_full_cnt = 7499U;
    expect(BOARD_FACT_PWM_CLOCK_Hz);
}

/* Bootstrap supplies: more is allowed, less is not. */
static void test_what_the_gate_supply_needs_is_the_least(void)
{
    board.fact[BOARD_FACT_PRECHARGE_s] = 0.02f; /* 100 periods */
    board.fact[BOARD_FACT_DUTY_MAX]    = 0.95f; /* 7125 counts */
    board.fact[BOARD_FACT_PULSE_MIN_s] = 1e-6f; /* 75 counts */
    app.gate.precharge_ticks           = 100U;
    app.gate.duty_max_cnt              = 7125U;
    app.gate.pulse_min_cnt             = 75U;
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, field());
    app.gate.precharge_ticks = 101U;
    app.gate.duty_max_cnt    = 7124U;
    app.gate.pulse_min_cnt   = 76U;
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, field());
    app.gate.pulse_min_cnt = 74U;
    expect(BOARD_FACT_PULSE_MIN_s);
    app.gate.duty_max_cnt = 7127U;
    expect(BOARD_FACT_DUTY_MAX);
    app.gate.precharge_ticks = 99U;
    expect(BOARD_FACT_PRECHARGE_s);
}

/* EQ-BOARD-1: no pulse is longer than a quarter of the period. */
static void test_a_pulse_that_is_a_quarter_of_the_period_is_the_longest(void)
{
    board.fact[BOARD_FACT_PULSE_MIN_s] = 1e-4f; /* 7500 counts */
    app.gate.pulse_min_cnt             = 1875U;
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, field());
    app.gate.pulse_min_cnt = 1874U;
    expect(BOARD_FACT_PULSE_MIN_s);
}

static void test_limits_beyond_the_board_are_named(void)
{
    drive.current_max_A = 5.01f;
    expect(BOARD_FACT_RATED_CURRENT_A);
    setUp();
    drive.trip_current_A = 9.01f;
    expect(BOARD_FACT_TRIP_CURRENT_A);
    setUp();
    drive.dc_link_max_V = 450.1f;
    expect(BOARD_FACT_RATED_DC_LINK_V);
    setUp();
    drive.trip_speed_e_radps *= 6.0f;
    expect(BOARD_FACT_ENCODER_EDGES_Hz);
    setUp();
    app.temperature_limit_degC = 80.1f;
    expect(BOARD_FACT_TEMPERATURE_LIMIT_degC);
    setUp();
    app.temperature_trip_degC = 90.1f;
    expect(BOARD_FACT_TEMPERATURE_TRIP_degC);
    setUp();
    app.heat.inverter_A = 5.01f;
    expect(BOARD_FACT_INVERTER_CURRENT_A);
    setUp();
    app.heat.inverter_s = 2.01f;
    expect(BOARD_FACT_INVERTER_TIME_CONSTANT_s);
}

static void test_a_chopper_follows_from_its_facts(void)
{
    const float                facts[] = {385.0f, 375.0f, 100.0f, 50.0f, 20.0f};
    const app_chopper_config_t good    = {
           .on_cnt = 3504U, .off_cnt = 3413U, .per_V2 = 2.0e-4f, .tau_s = 20.0f};

    app.board.chopper = 1U;
    app.chopper       = good;
    expect(BOARD_FACT_CHOPPER_ON_V); /* the board has none */
    setUp();
    for (uint16_t n = 0U; n < 5U; n++) {
        board.fact[(uint16_t)BOARD_FACT_CHOPPER_ON_V + n] = facts[n];
    }
    const board_identity_t with = board;
    expect(BOARD_FACT_CHOPPER_ON_V); /* the image has none */
    app.board.chopper = 1U;
    app.chopper       = good;
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, field());
    for (uint16_t n = 0U; n < 5U; n++) {
        board                         = with;
        const uint16_t fact           = (uint16_t)((uint16_t)BOARD_FACT_CHOPPER_ON_V + n);
        const bool     in_the_product = fact == (uint16_t)BOARD_FACT_CHOPPER_RESISTANCE_Ohm;
        board.fact[fact] *= 1.01f;
        expect(in_the_product ? BOARD_FACT_CHOPPER_POWER_W : (board_fact_t)fact);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_shipped_constants_are_of_their_board);
    RUN_TEST(test_a_chopper_follows_from_its_facts);
    RUN_TEST(test_every_fact_of_the_board_is_compared_with_the_constants);
    RUN_TEST(test_a_shorter_dead_time_is_refused_wherever_it_stands);
    RUN_TEST(test_another_scale_is_named);
    RUN_TEST(test_another_clock_is_named);
    RUN_TEST(test_what_the_gate_supply_needs_is_the_least);
    RUN_TEST(test_a_pulse_that_is_a_quarter_of_the_period_is_the_longest);
    RUN_TEST(test_limits_beyond_the_board_are_named);
    return UNITY_END();
}
