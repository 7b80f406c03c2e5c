/* SPDX-License-Identifier: MIT */
/* Registers whose values are computed: position mode, scope, record, loader, stored parameters. */
#include "app_registers.h"

#include <string.h>

#include "board_config.h"
#include "fake_board.h"
#include "gain_tables.h"
#include "register_words.h"
#include "unit_support.h"
#include "unity.h"

#define REACHED 0x0400
#define OF_MODE 0x1000

static app_registers_t  registers;
static drive_config_t   drive;
static app_scope_t      scope;
static app_record_t     record;
static app_loader_t     loader;
static app_image_t      in_force;
static app_parameters_t parameters;

void setUp(void)
{
    drive = gain_tables_drive;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_registers_init(&registers, &board_config, &drive));
    app_scope_init(&scope);
    (void)memset(&record, 0, sizeof record);
}

void tearDown(void) {}

static uint16_t input(int address)
{
    return register_words_input(&registers, address);
}

static app_registers_result_t write(int address, int value)
{
    return register_words_write(&registers, address, value);
}

static uint16_t statusword(int bits)
{
    return (uint16_t)(input(APP_REGISTERS_STATUSWORD) & (uint16_t)bits);
}

static uint32_t input_32(int address)
{
    return ((uint32_t)input(address) << 16) | input(address + 1);
}

static void test_a_position_is_reached_at_rest_within_the_window(void)
{
    app_status_t *s        = &registers.status;
    const int32_t here_cnt = app_registers_position(&registers);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_POSITION_WINDOW, 3));
    s->state             = APP_CONTROL_OPERATION_ENABLED;
    s->mode              = APP_MODE_RUN;
    s->mode_of_operation = APP_CONTROL_PROFILE_POSITION;
    s->arrived           = true;
    for (int32_t off = -5; off <= 5; off++) {
        s->target_cnt = here_cnt - off;
        TEST_ASSERT_EQUAL_HEX16(((off >= -3) && (off <= 3)) ? REACHED : 0, statusword(REACHED));
    }
    s->target_cnt = here_cnt;
    s->arrived    = false;
    TEST_ASSERT_EQUAL_HEX16(0, statusword(REACHED));
    s->arrived = true;
    s->mode    = APP_MODE_STOP;
    TEST_ASSERT_EQUAL_HEX16(0, statusword(REACHED));
}

static void test_a_halted_position_run_is_reached_at_standstill(void)
{
    app_status_t *s                            = &registers.status;
    registers.requested.objects.controlword    = 0x010FU;
    registers.requested.objects.window_e_radps = 5.0f;
    s->state                                   = APP_CONTROL_OPERATION_ENABLED;
    s->mode                                    = APP_MODE_RUN;
    s->mode_of_operation                       = APP_CONTROL_PROFILE_POSITION;
    s->speed_e_radps                           = 6.0f;
    TEST_ASSERT_EQUAL_HEX16(0, statusword(REACHED));
    s->speed_e_radps = -4.0f;
    TEST_ASSERT_EQUAL_HEX16(REACHED, statusword(REACHED));
}

static void test_bit_12_of_a_position_run_is_the_acknowledgement(void)
{
    registers.status.mode_of_operation = APP_CONTROL_PROFILE_POSITION;
    registers.status.acknowledged      = false;
    TEST_ASSERT_EQUAL_HEX16(0, statusword(OF_MODE));
    registers.status.acknowledged = true;
    TEST_ASSERT_EQUAL_HEX16(OF_MODE, statusword(OF_MODE));
}

/* Bit n - 1 is mode n of CiA 402; bits 16 and 17 are the manufacturer's. */
static void test_modes_of_a_drive(void)
{
    drive.positions = true;
    drive.torques   = true;
    TEST_ASSERT_EQUAL_HEX32(0x000303ADUL, input_32(APP_REGISTERS_SUPPORTED_MODES));
    drive.torques = false;
    TEST_ASSERT_EQUAL_HEX32(0x000301A5UL, input_32(APP_REGISTERS_SUPPORTED_MODES));
    drive.positions = false;
    TEST_ASSERT_EQUAL_HEX32(0x00030124UL, input_32(APP_REGISTERS_SUPPORTED_MODES));
}

static void test_a_torque_is_reached_by_its_references(void)
{
    app_status_t *s                          = &registers.status;
    registers.requested.objects.torque_share = 0.4f;
    s->state                                 = APP_CONTROL_OPERATION_ENABLED;
    s->mode                                  = APP_MODE_RUN;
    s->mode_of_operation                     = APP_CONTROL_PROFILE_TORQUE;
    s->torque_demand_share                   = 0.404f;
    TEST_ASSERT_EQUAL_HEX16(REACHED, statusword(REACHED | OF_MODE));
    s->torque_demand_share = 0.394f; /* on its way, or limited */
    TEST_ASSERT_EQUAL_HEX16(0, statusword(REACHED | OF_MODE));

    registers.requested.objects.torque_offset = 0.2f; /* of cyclic torque alone */
    registers.requested.objects.torque_most   = 0.5f;
    s->torque_demand_share                    = 0.4f;
    TEST_ASSERT_EQUAL_HEX16(REACHED, statusword(REACHED));
    s->mode_of_operation = APP_CONTROL_CYCLIC_TORQUE;
    TEST_ASSERT_EQUAL_HEX16(OF_MODE, statusword(REACHED | OF_MODE));
    s->torque_demand_share = 0.5f;
    TEST_ASSERT_EQUAL_HEX16(REACHED | OF_MODE, statusword(REACHED | OF_MODE));

    registers.requested.objects.controlword = 0x010FU; /* halt */
    TEST_ASSERT_EQUAL_HEX16(REACHED, statusword(REACHED | OF_MODE));
    s->speed_e_radps = 100.0f;
    TEST_ASSERT_EQUAL_HEX16(0, statusword(REACHED | OF_MODE));
    registers.requested.objects.controlword = 0x000FU;
    s->mode                                 = APP_MODE_STOP;
    TEST_ASSERT_EQUAL_HEX16(0, statusword(REACHED | OF_MODE));
}

static void test_a_cyclic_velocity_is_reached_with_its_offset(void)
{
    app_status_t *s                                  = &registers.status;
    registers.requested.objects.omega_e_radps        = 100.0f;
    registers.requested.objects.omega_offset_e_radps = 50.0f;
    registers.requested.objects.window_e_radps       = 5.0f;
    s->state                                         = APP_CONTROL_OPERATION_ENABLED;
    s->mode                                          = APP_MODE_RUN;
    s->mode_of_operation                             = APP_CONTROL_CYCLIC_VELOCITY;
    s->speed_e_radps                                 = 147.0f;
    TEST_ASSERT_EQUAL_HEX16(REACHED | OF_MODE, statusword(REACHED | OF_MODE));
    s->speed_e_radps = 100.0f;
    TEST_ASSERT_EQUAL_HEX16(OF_MODE, statusword(REACHED | OF_MODE));
    registers.requested.objects.controlword = 0x010FU; /* halt */
    TEST_ASSERT_EQUAL_HEX16(0, statusword(REACHED | OF_MODE));
    s->speed_e_radps = 2.0f;
    TEST_ASSERT_EQUAL_HEX16(REACHED, statusword(REACHED | OF_MODE));
    s->mode_of_operation = APP_CONTROL_PROFILE_VELOCITY; /* the offset is not of this mode */
    registers.requested.objects.controlword = 0x000FU;
    s->speed_e_radps                        = 102.0f;
    TEST_ASSERT_EQUAL_HEX16(REACHED, statusword(REACHED | OF_MODE));
}

static void test_bits_of_a_cyclic_position(void)
{
    app_status_t *s      = &registers.status;
    s->state             = APP_CONTROL_OPERATION_ENABLED;
    s->mode              = APP_MODE_RUN;
    s->mode_of_operation = APP_CONTROL_CYCLIC_POSITION;
    s->arrived           = true;
    TEST_ASSERT_EQUAL_HEX16(OF_MODE, statusword(REACHED | OF_MODE | 0x2000));
    for (int n = APP_BRAKE_NONE; n <= (int)APP_BRAKE_CLOSING; n++) { /* it follows nothing yet */
        s->brake = (app_brake_state_t)n;
        TEST_ASSERT_EQUAL_HEX16(
            ((n == (int)APP_BRAKE_NONE) || (n == (int)APP_BRAKE_RELEASED)) ? OF_MODE : 0,
            statusword(REACHED | OF_MODE));
        TEST_ASSERT_EQUAL_HEX16((n == (int)APP_BRAKE_CLOSED) || (n == (int)APP_BRAKE_CLOSING),
                                app_registers_outputs(&registers));
    }
    s->brake  = APP_BRAKE_NONE;
    s->beyond = true;
    TEST_ASSERT_EQUAL_HEX16(OF_MODE | 0x2000, statusword(REACHED | OF_MODE | 0x2000));
    registers.requested.objects.controlword = 0x010FU; /* halt: reached when it stands */
    TEST_ASSERT_EQUAL_HEX16(REACHED | 0x2000, statusword(REACHED | OF_MODE | 0x2000));
}

/* 6077h and 6074h in thousandths; 6075h and 6076h in mA and mN m. */
static void test_torques_and_what_they_are_of(void)
{
    registers.status.torque_share        = -0.2504f;
    registers.status.torque_demand_share = 40.0f;
    drive.rated_current_A                = 2.3694f;
    drive.rated_torque_Nm                = 150.0f;
    TEST_ASSERT_EQUAL_INT16(-250, (int16_t)input(APP_REGISTERS_TORQUE_NOW));
    TEST_ASSERT_EQUAL_INT16(32767, (int16_t)input(APP_REGISTERS_TORQUE_DEMAND)); /* clamped */
    TEST_ASSERT_EQUAL_UINT32(2369UL, input_32(APP_REGISTERS_RATED_CURRENT));
    TEST_ASSERT_EQUAL_UINT32(150000UL, input_32(APP_REGISTERS_RATED_TORQUE));
}

static void test_the_current_limit_is_a_share_of_the_rated_current_too(void)
{
    drive.rated_current_A = 2.5f;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_MAX_CURRENT_SHARE, 800));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-6f, 2.0f, registers.requested.objects.current_max_A);
    registers.requested.objects.current_max_A = 5.0f;
    TEST_ASSERT_EQUAL_HEX16(2000,
                            register_words_holding(&registers, APP_REGISTERS_MAX_CURRENT_SHARE));
}

static void test_without_scope_and_record_their_registers_are_zero(void)
{
    TEST_ASSERT_EQUAL_HEX16(0, input(APP_REGISTERS_SCOPE_STATE));
    TEST_ASSERT_EQUAL_HEX32(0, input_32(APP_REGISTERS_SCOPE_TICKS));
    TEST_ASSERT_EQUAL_HEX16(0, input(APP_REGISTERS_RECORD_NUMBER));
    TEST_ASSERT_EQUAL_HEX16(0, input(APP_REGISTERS_RECORD_COUNT));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SCOPE_COMMAND, 1));
    TEST_ASSERT_EQUAL_INT(APP_SCOPE_IDLE, scope.state);
}

static void test_the_scope_is_armed_and_stopped(void)
{
    registers.scope = &scope;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SCOPE_CHANNEL, 3));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SCOPE_BEFORE, 7));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SCOPE_COMMAND, 1));
    TEST_ASSERT_EQUAL_UINT16(2U, scope.setup.channel); /* counted from 0 */
    TEST_ASSERT_EQUAL_UINT16(7U, scope.setup.before);
    TEST_ASSERT_NOT_EQUAL(APP_SCOPE_IDLE, scope.state);
    TEST_ASSERT_EQUAL_HEX16(scope.state, input(APP_REGISTERS_SCOPE_STATE));
    TEST_ASSERT_EQUAL_HEX16(3, register_words_holding(&registers, APP_REGISTERS_SCOPE_CHANNEL));
    TEST_ASSERT_EQUAL_HEX16(0, register_words_holding(&registers, APP_REGISTERS_SCOPE_COMMAND));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SCOPE_COMMAND, 2));
    TEST_ASSERT_EQUAL_INT(APP_SCOPE_IDLE, scope.state);
}

static void test_samples_are_read_when_there_are_any(void)
{
    uint16_t values[2];

    registers.scope  = &scope;
    registers.record = &record;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY,
                          app_registers_read_input(&registers, APP_TRACES_SCOPE, 2U, values));
    scope.state         = APP_SCOPE_DONE;
    scope.count         = APP_SCOPE_SAMPLES;
    scope.trigger_ticks = 0x12345678UL;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_input(&registers, APP_TRACES_SCOPE, 2U, values));
    TEST_ASSERT_EQUAL_INT(
        APP_REGISTERS_BAD_ADDRESS,
        app_registers_read_input(
            &registers, (uint16_t)(APP_TRACES_SCOPE + (8U * APP_SCOPE_SAMPLES)), 2U, values));
    TEST_ASSERT_EQUAL_HEX32(0x12345678UL, input_32(APP_REGISTERS_SCOPE_TICKS));
    record.number     = 5U;
    record.kept_count = 9U;
    TEST_ASSERT_EQUAL_HEX16(5, input(APP_REGISTERS_RECORD_NUMBER));
    TEST_ASSERT_EQUAL_HEX16(9, input(APP_REGISTERS_RECORD_COUNT));
}

static void test_the_loaders_registers_are_beyond_the_map(void)
{
    uint16_t value = 0U;

    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                          app_registers_read_input(&registers, APP_LOADER_FIRST, 1U, &value));
    fake_board_erase_store();
    TEST_ASSERT_TRUE(
        app_image_choose(&in_force, &board_config, &gain_tables_drive, &board_identity));
    app_loader_init(&loader, &in_force);
    registers.loader = &loader;
    loader.state     = APP_LOADER_BUSY;
    TEST_ASSERT_EQUAL_HEX16(APP_LOADER_BUSY, input(APP_LOADER_FIRST + APP_LOADER_STATE));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_holding(&registers, APP_LOADER_FIRST, 1U, &value));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                          app_registers_read_holding(&registers, 0x7FFFU, 1U, &value));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS, write(0x7FFF, 0));
}

static app_registers_result_t write_text(int address, const char *text)
{
    const uint16_t words[2] = {(uint16_t)(((uint16_t)text[3] << 8) | (uint16_t)text[2]),
                               (uint16_t)(((uint16_t)text[1] << 8) | (uint16_t)text[0])};
    return app_registers_write(&registers, (uint16_t)address, 2U, words);
}

static void test_commands_of_the_store_need_their_words(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, write_text(APP_REGISTERS_STORE_PARAMETERS, "save"));
    registers.parameters = &parameters;
    registers.loader     = &loader;
    parameters.rested    = true;
    loader.fallback      = true; /* there is something to accept */
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_text(APP_REGISTERS_STORE_PARAMETERS, "save"));
    TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_STORE, registers.requested.store_command);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_text(APP_REGISTERS_RESTORE_PARAMETERS, "load"));
    TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_RESTORE, registers.requested.store_command);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_text(APP_REGISTERS_ACCEPT_FALLBACK, "take"));
    TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_ACCEPT, registers.requested.store_command);
    registers.requested.store_command = 0U;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE,
                          write_text(APP_REGISTERS_STORE_PARAMETERS, "sane"));
    TEST_ASSERT_EQUAL_INT(0, registers.requested.store_command);
}

static void test_every_address_is_read_with_one_answer(void)
{
    int inputs   = 0;
    int holdings = 0;

    for (uint32_t address = 0U; address < APP_REGISTERS_INPUTS_TOO; address++) {
        uint16_t       a     = 0U;
        uint16_t       b     = 0U;
        const uint16_t at    = (uint16_t)address;
        const bool     there = app_registers_read_input(&registers, at, 1U, &a) == APP_REGISTERS_OK;
        const uint16_t twin  = (uint16_t)(at + APP_REGISTERS_INPUTS_TOO);
        TEST_ASSERT_EQUAL_INT(there, app_registers_read_holding(&registers, twin, 1U, &b) ==
                                         APP_REGISTERS_OK);
        TEST_ASSERT_EQUAL_HEX16(a, b);
        inputs += there ? 1 : 0;
        holdings +=
            (app_registers_read_holding(&registers, at, 1U, &b) == APP_REGISTERS_OK) ? 1 : 0;
    }
    TEST_ASSERT_GREATER_OR_EQUAL_INT(APP_REGISTERS_MAP_INPUT, inputs);
    TEST_ASSERT_GREATER_OR_EQUAL_INT(APP_REGISTERS_MAP_HOLDING, holdings);
}

/* The table of CiA 402 for bits 13, 12 and 10. */
static void test_status_word_of_homing(void)
{
    static const struct {
        app_homing_stage_t stage;
        float              speed;
        int                bits;
    } rows[]        = {{APP_HOMING_IDLE, 0.0f, REACHED},
                       {APP_HOMING_FIND, 20.0f, 0},
                       {APP_HOMING_FIND, 0.0f, 0},
                       {APP_HOMING_INDEX, 0.0f, 0},
                       {APP_HOMING_ATTAINED, 20.0f, OF_MODE},
                       {APP_HOMING_ATTAINED, 0.0f, OF_MODE | REACHED},
                       {APP_HOMING_FAILED, -20.0f, APP_REGISTERS_FOLLOWING_ERROR},
                       {APP_HOMING_FAILED, 0.0f, APP_REGISTERS_FOLLOWING_ERROR | REACHED}};
    app_status_t *s = &registers.status;

    s->state                                  = APP_CONTROL_OPERATION_ENABLED;
    s->mode                                   = APP_MODE_RUN;
    registers.requested.objects.omega_e_radps = 20.0f; /* of another mode */
    for (int n = 0; n < SUPPORT_COUNT(rows); n++) {
        s->mode_of_operation = APP_CONTROL_HOMING;
        s->homing            = rows[n].stage;
        s->speed_e_radps     = rows[n].speed;
        TEST_ASSERT_EQUAL_HEX16(rows[n].bits,
                                statusword(REACHED | OF_MODE | APP_REGISTERS_FOLLOWING_ERROR));
        s->mode_of_operation = APP_CONTROL_PROFILE_POSITION;
        TEST_ASSERT_EQUAL_HEX16(0, statusword(OF_MODE | APP_REGISTERS_FOLLOWING_ERROR));
    }
}

static void test_a_limit_switch_and_a_limit_of_position_set_bit_11(void)
{
    TEST_ASSERT_EQUAL_HEX16(0, statusword(APP_REGISTERS_LIMITED));
    registers.status.inputs = BOARD_INPUT_HOME;
    TEST_ASSERT_EQUAL_HEX16(0, statusword(APP_REGISTERS_LIMITED));
    registers.status.inputs = BOARD_INPUT_NEGATIVE;
    TEST_ASSERT_EQUAL_HEX16(APP_REGISTERS_LIMITED, statusword(APP_REGISTERS_LIMITED));
    registers.status.inputs = BOARD_INPUT_POSITIVE;
    TEST_ASSERT_EQUAL_HEX16(APP_REGISTERS_LIMITED, statusword(APP_REGISTERS_LIMITED));
    registers.status.inputs = 0U;
    registers.status.held   = true;
    TEST_ASSERT_EQUAL_HEX16(APP_REGISTERS_LIMITED, statusword(APP_REGISTERS_LIMITED));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_position_is_reached_at_rest_within_the_window);
    RUN_TEST(test_a_halted_position_run_is_reached_at_standstill);
    RUN_TEST(test_bit_12_of_a_position_run_is_the_acknowledgement);
    RUN_TEST(test_modes_of_a_drive);
    RUN_TEST(test_status_word_of_homing);
    RUN_TEST(test_a_limit_switch_and_a_limit_of_position_set_bit_11);
    RUN_TEST(test_a_torque_is_reached_by_its_references);
    RUN_TEST(test_a_cyclic_velocity_is_reached_with_its_offset);
    RUN_TEST(test_bits_of_a_cyclic_position);
    RUN_TEST(test_torques_and_what_they_are_of);
    RUN_TEST(test_the_current_limit_is_a_share_of_the_rated_current_too);
    RUN_TEST(test_without_scope_and_record_their_registers_are_zero);
    RUN_TEST(test_the_scope_is_armed_and_stopped);
    RUN_TEST(test_samples_are_read_when_there_are_any);
    RUN_TEST(test_the_loaders_registers_are_beyond_the_map);
    RUN_TEST(test_commands_of_the_store_need_their_words);
    RUN_TEST(test_every_address_is_read_with_one_answer);
    return UNITY_END();
}
