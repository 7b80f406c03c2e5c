/* SPDX-License-Identifier: MIT */
/* Position units and polarity as a master sees them. */
#include "board_config.h"
#include "gain_tables.h"
#include "register_words.h"
#include "unit_support.h"
#include "unity.h"

static app_registers_t registers;
static drive_config_t  drive;

void setUp(void)
{
    drive = gain_tables_drive;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_registers_init(&registers, &board_config, &drive));
}

void tearDown(void) {}

static app_registers_result_t write_32(int address, int32_t value)
{
    const uint32_t x        = (uint32_t)value;
    const uint16_t words[2] = {(uint16_t)(x >> 16), (uint16_t)(x & 0xFFFFU)};

    return app_registers_write(&registers, (uint16_t)address, 2U, words);
}

static app_registers_result_t write(int address, int value)
{
    return register_words_write(&registers, address, value);
}

static int32_t input_32(int address)
{
    const uint32_t high = register_words_input(&registers, address);
    const uint32_t low  = register_words_input(&registers, address + 1);

    return (int32_t)((high << 16) | low);
}

static int32_t holding_32(int address)
{
    const uint32_t high = register_words_holding(&registers, address);
    const uint32_t low  = register_words_holding(&registers, address + 1);

    return (int32_t)((high << 16) | low);
}

static app_objects_t command(void)
{
    app_objects_t o;

    app_registers_command(&registers.requested, &o);
    return o;
}

static void test_the_command_has_counts(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_GEAR_MOTOR, 4));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_TARGET_POSITION, -1001));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_POSITION_OFFSET, 7));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_FOLLOWING_WINDOW, 12));
    TEST_ASSERT_TRUE((command().target_cnt == -4004) && (command().offset_cnt == 28));
    TEST_ASSERT_TRUE((command().following_window_cnt == 48U) && !command().limits);
    TEST_ASSERT_EQUAL_INT32(-1001, holding_32(APP_REGISTERS_TARGET_POSITION));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_POSITION_MOST, 2));
    TEST_ASSERT_TRUE(command().limits && (command().least_cnt == 0) && (command().most_cnt == 8));
}

#define PER_RPM 0.20943951 /* rad/s electrical of a motor with two pole pairs */

/* 0.1 r/min and whole r/min. The speed of PROFILE_VELOCITY counts 0.1 rad/s. */
static void test_one_limit_of_all_commanded_speeds(void)
{
    const double most = 1000.5 * PER_RPM;

    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_SPEED_RPM, -15000));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_TORQUE_SPEED_MAX, 1200));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, -1500.0 * PER_RPM, (double)command().omega_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1200.0 * PER_RPM, (double)command().torque_speed_max_e_radps);
    TEST_ASSERT_TRUE((command().profile_e_radps == 0.0f) && !app_registers_cuts_speed(&registers));

    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_PROFILE_SPEED_MAX, 10005));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, -most, (double)command().omega_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, most, (double)command().profile_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, most, (double)command().torque_speed_max_e_radps);
    TEST_ASSERT_EQUAL_INT32(-15000, holding_32(APP_REGISTERS_SPEED_RPM)); /* it stays requested */
    for (int mode = APP_CONTROL_FIND_ANGLE; mode <= APP_CONTROL_CYCLIC_TORQUE; mode++) {
        registers.status.mode_of_operation = (int16_t)mode;
        TEST_ASSERT_EQUAL_INT(app_control_is_speed((int16_t)mode),
                              app_registers_cuts_speed(&registers));
        TEST_ASSERT_EQUAL_INT(app_control_is_speed((int16_t)mode) ? APP_REGISTERS_LIMITED : 0,
                              app_registers_statusword(&registers) & APP_REGISTERS_LIMITED);
    }

    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_SPEED_RPM, 10000));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_PROFILE_VELOCITY, 1500));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_TORQUE_SPEED_MAX, 900));
    registers.status.mode_of_operation = APP_CONTROL_PROFILE_VELOCITY;
    TEST_ASSERT_FALSE(app_registers_cuts_speed(&registers));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1000.0 * PER_RPM, (double)command().omega_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 150.0, (double)command().profile_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 900.0 * PER_RPM, (double)command().torque_speed_max_e_radps);
    TEST_ASSERT_EQUAL_INT32(7162, holding_32(APP_REGISTERS_PROFILE_VELOCITY_RPM));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_PROFILE_VELOCITY_RPM, 5000));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 500.0 * PER_RPM, (double)command().profile_e_radps);
    TEST_ASSERT_EQUAL_INT32(1047, holding_32(APP_REGISTERS_PROFILE_VELOCITY));
}

static void test_positions_are_shown_in_units(void)
{
    registers.status.position.pole_pairs   = 2U;
    registers.status.position.positions    = 10000U;
    registers.status.position.rad_per_cnt  = 1.2566371e-3f;
    registers.status.position.actual.turns = 4; /* two turns of the shaft */
    registers.status.target_cnt            = 30001;
    TEST_ASSERT_EQUAL_INT32(20000, input_32(APP_REGISTERS_POSITION_NOW));
    TEST_ASSERT_EQUAL_INT32(30001, input_32(APP_REGISTERS_POSITION_TARGET));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_GEAR_MOTOR, 4));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_POLARITY, 128));
    TEST_ASSERT_EQUAL_INT32(2500000, input_32(APP_REGISTERS_TURN_UNITS)); /* thousandths */
    TEST_ASSERT_EQUAL_INT32(-5000, input_32(APP_REGISTERS_POSITION_NOW));
    TEST_ASSERT_EQUAL_INT32(-7500, input_32(APP_REGISTERS_POSITION_TARGET));
}

static void test_a_position_beyond_the_counts_is_refused_and_so_is_its_gear(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_TARGET_POSITION, 1000000000));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE,
                          write_32(APP_REGISTERS_TARGET_POSITION, 1000000001));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write(APP_REGISTERS_GEAR_MOTOR, 2));
    TEST_ASSERT_EQUAL_UINT16(1U, register_words_holding(&registers, APP_REGISTERS_GEAR_MOTOR));
    TEST_ASSERT_EQUAL_INT32(1000000000, command().target_cnt);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_GEAR_SHAFT, 2));
    TEST_ASSERT_EQUAL_INT32(500000000, command().target_cnt);
}

/* Each bit reverses its own commands and measurements, and the numbers stay. */
static void test_the_polarity_reverses_what_its_bits_name(void)
{
    for (int bits = 0; bits < 8; bits++) {
        const float speed  = ((bits & 2) != 0) ? -1.0f : 1.0f;
        const float torque = ((bits & 1) != 0) ? -1.0f : 1.0f;

        setUp();
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_SPEED, 1000));
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_TORQUE, 300));
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_VELOCITY_OFFSET, 70));
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_TORQUE_OFFSET, 30));
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_POLARITY, bits << 5));
        TEST_ASSERT_EQUAL_INT32(70, holding_32(APP_REGISTERS_VELOCITY_OFFSET));
        TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.03f * torque, command().torque_offset);
        TEST_ASSERT_EQUAL_INT32(1000, holding_32(APP_REGISTERS_SPEED));
        TEST_ASSERT_EQUAL_UINT16(300U, register_words_holding(&registers, APP_REGISTERS_TORQUE));
        TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, 100.0f * speed, command().omega_e_radps);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.3f * torque, command().torque_share);
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_VELOCITY_OFFSET, 50));
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_TORQUE_OFFSET, 20));
        TEST_ASSERT_TRUE((command().omega_offset_e_radps * speed) > 0.0f);
        TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 0.02f * torque, command().torque_offset);
        registers.status.speed_e_radps       = 20.0f;
        registers.status.demand_e_radps      = 30.0f;
        registers.status.torque_share        = 0.5f;
        registers.status.torque_demand_share = 0.6f;
        TEST_ASSERT_EQUAL_INT32((int32_t)(200.0f * speed), input_32(APP_REGISTERS_SPEED_NOW));
        TEST_ASSERT_TRUE(((float)input_32(APP_REGISTERS_SPEED_NOW_RPM) * speed) > 0.0f);
        TEST_ASSERT_TRUE(((float)input_32(APP_REGISTERS_SPEED_DEMAND_RPM) * speed) > 0.0f);
        TEST_ASSERT_EQUAL_INT16(
            (int16_t)(500.0f * torque),
            (int16_t)register_words_input(&registers, APP_REGISTERS_TORQUE_NOW));
        TEST_ASSERT_EQUAL_INT16(
            (int16_t)(600.0f * torque),
            (int16_t)register_words_input(&registers, APP_REGISTERS_TORQUE_DEMAND));
    }
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write(APP_REGISTERS_POLARITY, 1));
}

static void test_units_change_at_rest_only(void)
{
    registers.status.state = APP_CONTROL_OPERATION_ENABLED;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, write(APP_REGISTERS_POLARITY, 64));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, write(APP_REGISTERS_GEAR_MOTOR, 2));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, write_32(APP_REGISTERS_FEED, 360));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_GEAR_MOTOR, 1)); /* as it is */
}

static void test_a_large_feed_keeps_its_last_digit(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_32(APP_REGISTERS_FEED, 100000001));
    TEST_ASSERT_EQUAL_INT32(100000001, holding_32(APP_REGISTERS_FEED));
    TEST_ASSERT_EQUAL_UINT32(100000001U, registers.requested.scale.den);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_command_has_counts);
    RUN_TEST(test_one_limit_of_all_commanded_speeds);
    RUN_TEST(test_positions_are_shown_in_units);
    RUN_TEST(test_a_position_beyond_the_counts_is_refused_and_so_is_its_gear);
    RUN_TEST(test_the_polarity_reverses_what_its_bits_name);
    RUN_TEST(test_units_change_at_rest_only);
    RUN_TEST(test_a_large_feed_keeps_its_last_digit);
    return UNITY_END();
}
