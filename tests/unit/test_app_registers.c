/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#include <string.h>

#include "unit_support.h"
#include "unity.h"

static app_registers_t registers;

void setUp(void)
{
    (void)memset(&registers, 0xFF, sizeof registers); /* init has to set everything */
    app_registers_init(&registers, 1569.0f);
}

void tearDown(void) {}

static uint16_t input(int address)
{
    uint16_t value = 0xDEADU;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_input(&registers, (uint16_t)address, 1U, &value));
    return value;
}

static uint16_t holding(int address)
{
    uint16_t value = 0xDEADU;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_holding(&registers, (uint16_t)address, 1U, &value));
    return value;
}

static app_registers_result_t write(int address, int value)
{
    const uint16_t word = (uint16_t)value;
    return app_registers_write(&registers, (uint16_t)address, 1U, &word);
}

/* Addresses, units and signs of docs/modbus.md, in numbers on purpose. */
static void test_input_registers_are_what_the_table_says(void)
{
    app_status_t *s      = &registers.status;
    s->mode              = APP_MODE_RUN;
    s->fault             = APP_FAULT_INDEX;
    s->drive_fault       = DRIVE_FAULT_ENCODER;
    s->board_faults      = 9U;
    s->hot               = true;
    s->gate_enable       = true;
    s->reference         = APP_ANGLE_INDEX;
    s->align_stage       = APP_ALIGN_SETTLE;
    s->speed_e_radps     = -300.04f;
    s->i_A.q             = 1.2346f;
    s->i_A.d             = -0.5004f;
    s->i_ref_A.q         = 2.5f;
    s->i_ref_A.d         = -3.25f;
    s->v_V.q             = 100.04f;
    s->v_V.d             = -20.06f;
    s->dc_link_V         = 295.04f;
    s->temperature_degC  = -12.34f;
    s->theta_e_rad       = 6.2826f;
    s->position_cnt      = 9999U;
    s->index_corrections = 7U;
    s->zero_a_cnt        = 2048.26f;
    s->zero_b_cnt        = 1999.94f;
    s->tick_cycles       = 2800U;
    s->tick_cycles_worst = 3100U;
    s->ticks             = 0x12345678UL;

    static const int want[] = {4,    8,     5,     9,    5,    2,      3,     -3000, 1235,
                               -500, 2500,  -3250, 1000, -201, 2950,   -123,  6283,  9999,
                               7,    20483, 19999, 2800, 3100, 0x1234, 0x5678};
    TEST_ASSERT_EQUAL_INT(25, SUPPORT_COUNT(want));
    for (int i = 0; i < SUPPORT_COUNT(want); i++) {
        TEST_ASSERT_EQUAL_HEX16((uint16_t)want[i], input(i));
    }
}

static void test_snapshot_registers_are_what_the_table_says(void)
{
    app_snapshot_t *f      = &registers.status.snapshot;
    f->fault               = APP_FAULT_DRIVE;
    f->mode                = APP_MODE_ALIGN;
    f->drive_fault         = DRIVE_FAULT_DC_LINK;
    f->board_faults        = 3U;
    f->raw.ia_cnt          = 101U;
    f->raw.ib_cnt          = 102U;
    f->raw.dc_link_cnt     = 103U;
    f->raw.temperature_cnt = 104U;
    f->raw.position_cnt    = 105U;
    f->raw.index_cnt       = 106U;
    f->raw.index_seen      = true;
    f->speed_e_radps       = -12.34f;
    f->wanted_e_radps      = 56.78f;
    f->ticks               = 0xABCD0123UL;

    static const int want[] = {10,  3,   3, 3,    101, 102,    103,   104,
                               105, 106, 2, -123, 568, 0xABCD, 0x0123};
    for (int i = 0; i < SUPPORT_COUNT(want); i++) {
        TEST_ASSERT_EQUAL_HEX16((uint16_t)want[i], input(25 + i));
    }
    f->raw.valid      = true;
    f->raw.index_seen = false;
    TEST_ASSERT_EQUAL_UINT(1U, input(35));
}

/* 48 on; values as digits and a power of ten. */
static void test_commissioning_registers_are_what_the_table_says(void)
{
    app_commission_status_t *c = &registers.status.commission;
    commission_result_t     *f = &c->found;
    c->stage                   = COMMISSION_SPIN;
    c->reason                  = COMMISSION_REASON_DRAG;
    c->percent                 = 80;
    f->direction               = -1;
    f->pole_pairs              = 3;
    f->counts_per_turn         = 0x12345L;
    f->reluctance              = true;
    f->r_Ohm.value             = 3.6006f;
    f->r_Ohm.error             = 0.0081f;
    f->inertia_kgm2.value      = 8.3e-5f;
    f->offset_rad.value        = -1.25f;
    static const int first[]   = {6, 12, 80, -1, 3, 1, 0x2345, 1};

    for (int i = 0; i < SUPPORT_COUNT(first); i++) {
        TEST_ASSERT_EQUAL_HEX16((uint16_t)first[i], input(48 + i));
    }
    static const struct {
        int    address;
        double value;
    } found[] = {{56, 3.6006}, {58, 0.0081}, {60, 0.0}, {56 + 20, 8.3e-5}, {56 + 32, -1.25}};
    for (int i = 0; i < SUPPORT_COUNT(found); i++) {
        const double digits = (int16_t)input(found[i].address);
        const double power  = (int16_t)input(found[i].address + 1);
        TEST_ASSERT_DOUBLE_WITHIN(2.0e-4 * fabs(found[i].value), found[i].value,
                                  digits * pow(10.0, power));
    }
    uint16_t value = 0U;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                          app_registers_read_input(&registers, 92U, 1U, &value));
}

static void test_commissioning_is_asked_for_with_its_bounds(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(4, 250));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(5, 1500));
    TEST_ASSERT_FALSE(registers.command.commission);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(3, 1));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write(3, 2));

    TEST_ASSERT_TRUE(registers.command.commission && !registers.command.run);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 2.5f, registers.command.bounds.current_A);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-4f, 150.0f, registers.command.bounds.speed_m_radps);
    TEST_ASSERT_EQUAL_INT(1, holding(3));
    TEST_ASSERT_EQUAL_INT(250, holding(4));
    TEST_ASSERT_EQUAL_INT(1500, holding(5));

    app_registers_silence(&registers);
    TEST_ASSERT_FALSE(registers.command.commission);
    TEST_ASSERT_TRUE(registers.silent);
}

static void test_registers_are_zero_at_the_start(void)
{
    for (int address = 0; address < 42; address++) {
        TEST_ASSERT_EQUAL_UINT(0U, input(address));
    }
    for (int address = 0; address < 3; address++) {
        TEST_ASSERT_EQUAL_UINT(0U, holding(address));
    }
    TEST_ASSERT_FALSE(registers.changed || registers.command.run || registers.command.reset);
}

static void test_values_are_held_at_the_ends_of_16_bits(void)
{
    registers.status.speed_e_radps = 1.0e9f;
    registers.status.i_A.q         = -1.0e9f;
    registers.status.dc_link_V     = 1.0e9f;
    TEST_ASSERT_EQUAL_HEX16(0x7FFFU, input(7));
    TEST_ASSERT_EQUAL_HEX16(0x8000U, input(8));
    TEST_ASSERT_EQUAL_HEX16(0xFFFFU, input(14));
    registers.status.dc_link_V     = -5.0f;
    registers.status.speed_e_radps = NAN;
    TEST_ASSERT_EQUAL_HEX16(0U, input(14));
    TEST_ASSERT_EQUAL_HEX16(0x8000U, input(7));
}

static void test_conditions_reset_and_phase_errors(void)
{
    registers.status.dc_link_out = true;
    TEST_ASSERT_EQUAL_UINT(8U, input(4));
    registers.status.tripped = true;
    TEST_ASSERT_EQUAL_UINT(24U, input(4));
    registers.status.reset_cause  = BOARD_RESET_WATCHDOG;
    registers.status.phase_errors = 1234U;
    TEST_ASSERT_EQUAL_UINT(1U, input(40));
    TEST_ASSERT_EQUAL_UINT(1234U, input(41));
    registers.status.ignored_angles   = 65535U;
    registers.status.ignored_currents = 7U;
    registers.status.without_angle    = true;
    TEST_ASSERT_EQUAL_UINT(65535U, input(42));
    TEST_ASSERT_EQUAL_UINT(7U, input(43));
    TEST_ASSERT_EQUAL_UINT(88U, input(4));
    registers.status.shorted = true;
    TEST_ASSERT_EQUAL_UINT(120U, input(4));
}

static void test_limits_and_heat_are_told(void)
{
    TEST_ASSERT_EQUAL_UINT(0U, input(4));
    registers.status.voltage_limited = true;
    TEST_ASSERT_EQUAL_UINT(128U, input(4));
    registers.status.current_limited = true;
    TEST_ASSERT_EQUAL_UINT(128U + 256U, input(4));
    registers.status.derating = 0.25f;
    TEST_ASSERT_EQUAL_UINT(128U + 256U + 512U, input(4));
    TEST_ASSERT_EQUAL_UINT(250U, input(47));
    registers.status.position_jumps = 3U;
    registers.status.motor_heat     = 0.5f;
    registers.status.inverter_heat  = 1.05f;
    TEST_ASSERT_EQUAL_UINT(3U, input(44));
    TEST_ASSERT_EQUAL_UINT(500U, input(45));
    TEST_ASSERT_EQUAL_UINT(1050U, input(46));
}

static void test_blocks_that_do_not_exist_as_a_whole_are_refused(void)
{
    static const uint32_t inputs[][2]   = {{92UL, 1UL},    {91UL, 2UL},    {0UL, 93UL},
                                           {65535UL, 1UL}, {65535UL, 2UL}, {1UL, 65535UL}};
    static const uint32_t holdings[][2] = {{6UL, 1UL}, {5UL, 2UL}, {0UL, 7UL}, {65535UL, 2UL}};
    uint16_t              values[96]    = {0U};
    for (int i = 0; i < SUPPORT_COUNT(inputs); i++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                              app_registers_read_input(&registers, (uint16_t)inputs[i][0],
                                                       (uint16_t)inputs[i][1], values));
    }
    for (int i = 0; i < SUPPORT_COUNT(holdings); i++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                              app_registers_read_holding(&registers, (uint16_t)holdings[i][0],
                                                         (uint16_t)holdings[i][1], values));
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                              app_registers_write(&registers, (uint16_t)holdings[i][0],
                                                  (uint16_t)holdings[i][1], values));
    }
    TEST_ASSERT_FALSE(registers.changed);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, app_registers_read_input(&registers, 0U, 92U, values));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, app_registers_read_holding(&registers, 0U, 6U, values));
}

static void test_every_speed_in_range_is_taken_and_read_back(void)
{
    for (int tenths = -15690; tenths <= 15690; tenths++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(2, tenths));
        TEST_ASSERT_TRUE(fabs((double)registers.command.omega_e_radps - (0.1 * tenths)) < 1.0e-4);
        TEST_ASSERT_EQUAL_HEX16((uint16_t)tenths, holding(2));
    }
}

static void test_value_out_of_range_is_refused_and_changes_nothing(void)
{
    static const int bad[][2] = {{2, 15691}, {2, -15691}, {2, 32767}, {2, -32768},
                                 {0, 2},     {0, 65535},  {1, 2},     {1, 256}};
    (void)write(2, 1234);
    registers.changed = false;
    for (int i = 0; i < SUPPORT_COUNT(bad); i++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write(bad[i][0], bad[i][1]));
    }
    TEST_ASSERT_EQUAL_UINT(1234U, holding(2));
    TEST_ASSERT_EQUAL_UINT(0U, holding(0));
    TEST_ASSERT_FALSE(registers.changed || registers.command.reset);
}

static void test_block_with_one_bad_value_is_refused_as_a_whole(void)
{
    const uint16_t block[] = {1U, 0U, 20000U};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, app_registers_write(&registers, 0U, 3U, block));
    TEST_ASSERT_FALSE(registers.command.run || registers.changed);
}

static void test_run_and_reset_reach_the_command(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(0, 1));
    TEST_ASSERT_TRUE(registers.changed && registers.command.run && !registers.command.reset);
    TEST_ASSERT_EQUAL_UINT(1U, holding(0));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(0, 0));
    TEST_ASSERT_FALSE(registers.command.run);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(1, 1));
    TEST_ASSERT_TRUE(registers.command.reset);
    TEST_ASSERT_EQUAL_UINT(0U, holding(1));
}

static void test_silence_withdraws_run_until_it_is_given_again(void)
{
    app_registers_silence(&registers);
    TEST_ASSERT_FALSE(registers.changed || registers.silent);
    (void)write(0, 1);
    registers.changed = false;

    app_registers_silence(&registers);

    TEST_ASSERT_TRUE(registers.changed && registers.silent && !registers.command.run);
    TEST_ASSERT_EQUAL_UINT(APP_REGISTERS_SILENT, input(4) & 2U);
    TEST_ASSERT_EQUAL_UINT(0U, holding(0));
    (void)write(0, 0);
    TEST_ASSERT_TRUE(registers.silent);
    (void)write(0, 1);
    TEST_ASSERT_FALSE(registers.silent);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_input_registers_are_what_the_table_says);
    RUN_TEST(test_snapshot_registers_are_what_the_table_says);
    RUN_TEST(test_commissioning_registers_are_what_the_table_says);
    RUN_TEST(test_commissioning_is_asked_for_with_its_bounds);
    RUN_TEST(test_registers_are_zero_at_the_start);
    RUN_TEST(test_values_are_held_at_the_ends_of_16_bits);
    RUN_TEST(test_conditions_reset_and_phase_errors);
    RUN_TEST(test_limits_and_heat_are_told);
    RUN_TEST(test_blocks_that_do_not_exist_as_a_whole_are_refused);
    RUN_TEST(test_every_speed_in_range_is_taken_and_read_back);
    RUN_TEST(test_value_out_of_range_is_refused_and_changes_nothing);
    RUN_TEST(test_block_with_one_bad_value_is_refused_as_a_whole);
    RUN_TEST(test_run_and_reset_reach_the_command);
    RUN_TEST(test_silence_withdraws_run_until_it_is_given_again);
    return UNITY_END();
}
