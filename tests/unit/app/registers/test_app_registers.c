/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

#include <string.h>

#include "board_config.h"
#include "gain_tables.h"
#include "register_types.h"
#include "register_words.h"
#include "unit_support.h"
#include "unity.h"

static app_registers_t registers;
static drive_config_t  drive;

void setUp(void)
{
    (void)memset(&registers, 0xFF, sizeof registers); /* init has to set everything */
    drive                     = gain_tables_drive;
    drive.speed_max_e_radps   = 1569.0f;
    drive.hardware.pole_pairs = 3U;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_registers_init(&registers, &board_config, &drive));
}

void tearDown(void) {}

static uint16_t input(int address)
{
    return register_words_input(&registers, address);
}

static uint16_t holding(int address)
{
    return register_words_holding(&registers, address);
}

static app_registers_result_t write(int address, int value)
{
    return register_words_write(&registers, address, value);
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

    s->state             = APP_CONTROL_FAULT_REACTION_ACTIVE;
    s->mode_of_operation = APP_CONTROL_COMMISSIONING;
    s->demand_e_radps    = 31.41593f; /* 100 r/min of 3 pole pairs */

    /* 300.04 rad/s over 3 pole pairs are 955.06 r/min; a fault of the index is code 7305h */
    static const int want[] = {0xC29F, -1,    0x7305, 4,     8,    5,      9,     5,    2,    3,
                               -1,     -3000, -1,     -9551, 0,    1000,   0,     1235, -1,   -500,
                               0,      2500,  -1,     -3250, 1000, -201,   2950,  -123, 6283, 9999,
                               7,      20483, 19999,  2800,  3100, 0x1234, 0x5678};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_RESET_CAUSE, SUPPORT_COUNT(want));
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

    static const int want[] = {10,  3, 3,  3,    101, 102, 103,    104,   105,
                               106, 2, -1, -123, 0,   568, 0xABCD, 0x0123};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_LIVE_END - APP_REGISTERS_FIRST_FAULT, SUPPORT_COUNT(want));
    for (int i = 0; i < SUPPORT_COUNT(want); i++) {
        TEST_ASSERT_EQUAL_HEX16((uint16_t)want[i], input(APP_REGISTERS_FIRST_FAULT + i));
    }
    f->raw.valid      = true;
    f->raw.index_seen = false;
    TEST_ASSERT_EQUAL_UINT(1U, input(APP_REGISTERS_FIRST_SAMPLE));
}

/* Values as digits and a power of ten. */
/* A change of 200 rad/s by a shaft with three times the inertia, one pass of the background in each
 * tick of 200 us. A load of zero stands for a law that estimates none. */
static void turn(float accel, float load, int ticks)
{
    app_status_t *s = &registers.status;

    for (int i = 0; i < ticks; i++) {
        s->ticks++;
        s->speed_e_radps += accel * 200.0e-6f;
        s->d_omega = ((load < 0.0f) ? ((1.0f - 3.0f) * accel) : 0.0f) + load;
        app_registers_see_inertia(&registers, 1.0f);
    }
}

static void change_speed(float load)
{
    turn(0.0f, load, 500);
    turn(2000.0f, load, 500);
    turn(0.0f, load, 500);
}

static void test_the_inertia_is_shown_by_runs_with_a_speed_and_an_encoder(void)
{
    app_status_t *s = &registers.status;

    TEST_ASSERT_EQUAL_UINT16(1000u, input(96));
    s->mode              = APP_MODE_RUN;
    s->mode_of_operation = 1; /* to a position: the law adds to d_w, EQ-INERTIA-3 */
    change_speed(-3571.0f);
    s->mode_of_operation = 3;
    s->without_angle     = true;
    change_speed(-3571.0f);
    s->without_angle = false;
    s->mode          = APP_MODE_FAULT;
    change_speed(-3571.0f);
    TEST_ASSERT_EQUAL_UINT16(1000u, input(96));
    TEST_ASSERT_EQUAL_UINT16(0u, input(97));
    s->mode = APP_MODE_RUN;
    change_speed(0.0f); /* a law without an estimate of the load */
    TEST_ASSERT_EQUAL_UINT16(0u, input(97));
    change_speed(-3571.0f);
    TEST_ASSERT_UINT16_WITHIN(20u, 2500u, input(96));
    TEST_ASSERT_EQUAL_UINT16(1u, input(97));
    s->mode = APP_MODE_FAULT;
    change_speed(-3571.0f);
    TEST_ASSERT_UINT16_WITHIN(20u, 2500u, input(96));
    TEST_ASSERT_EQUAL_UINT16(1u, input(97));
}

/* INERTIA_START lets the law use the ratio, begins with it, and takes the place of what was learned. */
static void test_the_law_gets_the_inertia_on_request(void)
{
    app_status_t *s = &registers.status;

    s->mode              = APP_MODE_RUN;
    s->mode_of_operation = 3;
    change_speed(-3571.0f);
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) == 1.0f);
    TEST_ASSERT_EQUAL_UINT16(1000u, input(99)); /* INERTIA_BELIEVED */

    registers.requested.inertia_start = 1700u;
    turn(0.0f, -3571.0f, 1);
    TEST_ASSERT_EQUAL_UINT16(1700u, input(96));
    TEST_ASSERT_EQUAL_UINT16(0u, input(97));
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) == 1.7f);
    app_registers_see_inertia(&registers, 1.7f);
    TEST_ASSERT_EQUAL_UINT16(1700u, input(99));
    change_speed(-3571.0f);
    TEST_ASSERT_EQUAL_UINT16(1u, input(97));
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) > 2.0f);

    s->without_angle = true;
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) == 1.0f);
    s->without_angle     = false;
    s->mode_of_operation = 1;
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) == 1.0f);
    s->mode_of_operation                          = 3;
    registers.requested.objects.mode_of_operation = 1; /* the next command */
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) == 1.0f);
    registers.requested.objects.mode_of_operation = 3;
    s->mode = APP_MODE_READY; /* the next run begins with it */
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) > 2.0f);

    registers.requested.inertia_start = 0u;
    turn(0.0f, -3571.0f, 1);
    TEST_ASSERT_EQUAL_UINT16(1000u, input(96));
    TEST_ASSERT_TRUE(app_registers_inertia_wanted(&registers) == 1.0f);
    registers.requested.inertia_start = 200u; /* below the least */
    turn(0.0f, -3571.0f, 1);
    TEST_ASSERT_EQUAL_UINT16(500u, input(96));
}

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
        TEST_ASSERT_EQUAL_HEX16((uint16_t)first[i], input(128 + i));
    }
    f->coupling           = COMMISSION_COUPLING_ELASTIC;
    f->searched_Hz        = 571.4f;
    f->resonance_Hz.value = 221.7f;
    f->damping.value      = 0.0213f;
    f->load_share.error   = 0.0041f;
    TEST_ASSERT_EQUAL_UINT16(2U, input(172));
    TEST_ASSERT_EQUAL_UINT16(5714U, input(173));
    static const struct {
        int    address;
        double value;
    } found[] = {{174, 221.7},  {178, 0.0213}, {184, 0.0041},      {136, 3.6006},
                 {138, 0.0081}, {140, 0.0},    {136 + 20, 8.3e-5}, {136 + 32, -1.25}};
    for (int i = 0; i < SUPPORT_COUNT(found); i++) {
        const double digits = (int16_t)input(found[i].address);
        const double power  = (int16_t)input(found[i].address + 1);
        TEST_ASSERT_DOUBLE_WITHIN(2.0e-4 * fabs(found[i].value), found[i].value,
                                  digits * pow(10.0, power));
    }
    uint16_t value = 0U;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                          app_registers_read_input(&registers, 186U, 1U, &value));
}

static void test_commissioning_is_asked_for_with_its_bounds(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_COMMISSION_CURRENT, 250));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_COMMISSION_SPEED, 1500));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_MODE_OF_OPERATION, -1));

    TEST_ASSERT_EQUAL_INT(APP_CONTROL_COMMISSIONING, registers.requested.objects.mode_of_operation);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 2.5f, registers.requested.objects.bounds.current_A);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-4f, 150.0f, registers.requested.objects.bounds.speed_m_radps);
    TEST_ASSERT_EQUAL_HEX16(0xFFFFU, holding(APP_REGISTERS_MODE_OF_OPERATION));
    TEST_ASSERT_EQUAL_INT(250, holding(APP_REGISTERS_COMMISSION_CURRENT));
    TEST_ASSERT_EQUAL_INT(1500, holding(APP_REGISTERS_COMMISSION_SPEED));
}

/* Every object is taken in its unit and read back as it was written. */
static void test_objects_are_written_and_read_back(void)
{
    const app_objects_t *o = &registers.requested.objects;
    static const struct {
        int      address;
        uint32_t value;
    } all[] = {{APP_REGISTERS_CONTROLWORD, 0x018FU},  {APP_REGISTERS_MODE_OF_OPERATION, 6U},
               {APP_REGISTERS_QUICK_STOP_OPTION, 6U}, {APP_REGISTERS_SHUTDOWN_OPTION, 1U},
               {APP_REGISTERS_DISABLE_OPTION, 1U},    {APP_REGISTERS_LOST_OPTION, 3U},
               {APP_REGISTERS_SPEED_WINDOW, 123U}};
    for (int i = 0; i < SUPPORT_COUNT(all); i++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(all[i].address, (int)all[i].value));
        TEST_ASSERT_EQUAL_UINT(all[i].value, holding(all[i].address));
    }
    const uint16_t ramps[] = {1U, 0x86A0U, 0U, 2000U, 0U, 3000U};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_write(&registers, APP_REGISTERS_ACCELERATION, 6U, ramps));
    const uint16_t limit[] = {0U, 2500U};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_write(&registers, APP_REGISTERS_MAX_CURRENT, 2U, limit));

    TEST_ASSERT_EQUAL_HEX16(0x018FU, o->controlword);
    TEST_ASSERT_TRUE((o->mode_of_operation == 6) && (o->quick_option == 6) &&
                     (o->shutdown_option == 1) && (o->disable_option == 1) &&
                     (o->lost_option == 3));
    TEST_ASSERT_TRUE((o->accel_e_radps2 == 100000.0f) && (o->decel_e_radps2 == 2000.0f) &&
                     (o->quick_e_radps2 == 3000.0f) && (o->current_max_A == 2.5f));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 12.3f, o->window_e_radps);
}

static void test_the_line_is_changed_while_stopped_only(void)
{
    registers.status.state = APP_CONTROL_OPERATION_ENABLED;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, write(APP_REGISTERS_LINE_FORMAT, 1));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_LINE_FORMAT, 0)); /* is so */
    registers.status.state = APP_CONTROL_SWITCHED;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_LINE_FORMAT, 1));
    registers.status.gate_enable = true;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, write(APP_REGISTERS_LINE_FORMAT, 2));
}

static void test_the_mode_of_operation_is_changed_in_a_run_too(void)
{
    static const int modes[] = {1, 4, 8, 9, 10, 3, 6, -1};

    registers.status.state       = APP_CONTROL_OPERATION_ENABLED;
    registers.status.gate_enable = true;
    for (int i = 0; i < SUPPORT_COUNT(modes); i++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_MODE_OF_OPERATION, modes[i]));
        TEST_ASSERT_EQUAL_INT(modes[i], registers.requested.objects.mode_of_operation);
    }
}

/* Bits 0 to 3, 5 and 6 by the standard's table of states; 9 always; 4 and 7 by what is in the way. */
static void test_statusword(void)
{
    static const int states[] = {0x0000, 0x0040, 0x0021, 0x0023, 0x0027, 0x0007, 0x000F, 0x0008};
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_STATES, SUPPORT_COUNT(states));
    app_status_t *s      = &registers.status;
    s->mode_of_operation = APP_CONTROL_PROFILE_VELOCITY;
    s->speed_e_radps     = 300.0f;
    for (int i = 0; i < SUPPORT_COUNT(states); i++) {
        s->state = (app_control_state_t)i;
        TEST_ASSERT_EQUAL_HEX16(states[i], input(APP_REGISTERS_STATUSWORD) & 0x006F);
        TEST_ASSERT_EQUAL_HEX16(0x0210, input(APP_REGISTERS_STATUSWORD) & 0xFF90);
    }
    s->dc_link_out = true;
    TEST_ASSERT_EQUAL_HEX16(0x0280, input(APP_REGISTERS_STATUSWORD) & 0xFF90);
    s->dc_link_out = false;
    s->hot         = true;
    TEST_ASSERT_EQUAL_HEX16(0x0290, input(APP_REGISTERS_STATUSWORD) & 0xFF90);
    s->hot             = false;
    s->voltage_limited = true;
    s->gate_enable     = true;
    s->reference       = APP_ANGLE_INDEX;
    registers.silent   = true;
    TEST_ASSERT_EQUAL_HEX16(0xCB10, input(APP_REGISTERS_STATUSWORD) & 0xFF90);
}

static void test_target_reached_and_what_bit_12_says(void)
{
    app_status_t *s                            = &registers.status;
    registers.requested.objects.omega_e_radps  = 300.0f;
    registers.requested.objects.window_e_radps = 5.0f;
    s->state                                   = APP_CONTROL_OPERATION_ENABLED;
    s->mode                                    = APP_MODE_RUN;
    s->mode_of_operation                       = APP_CONTROL_PROFILE_VELOCITY;
    s->speed_e_radps                           = 296.0f;
    TEST_ASSERT_EQUAL_HEX16(0x0400, input(APP_REGISTERS_STATUSWORD) & 0x1400);
    s->speed_e_radps = 294.0f;
    TEST_ASSERT_EQUAL_HEX16(0x0000, input(APP_REGISTERS_STATUSWORD) & 0x1400);
    s->speed_e_radps = 1.0f;
    TEST_ASSERT_EQUAL_HEX16(0x1000, input(APP_REGISTERS_STATUSWORD) & 0x1400);
    registers.requested.objects.controlword = 0x010FU; /* halt */
    TEST_ASSERT_EQUAL_HEX16(0x1400, input(APP_REGISTERS_STATUSWORD) & 0x1400);
    s->mode_of_operation = APP_CONTROL_FIND_ANGLE;
    TEST_ASSERT_EQUAL_HEX16(0x0000, input(APP_REGISTERS_STATUSWORD) & 0x1400);
    s->done = true;
    TEST_ASSERT_EQUAL_HEX16(0x0400, input(APP_REGISTERS_STATUSWORD) & 0x1400);
    s->reference = APP_ANGLE_ALIGNED;
    TEST_ASSERT_EQUAL_HEX16(0x1400, input(APP_REGISTERS_STATUSWORD) & 0x1400);
}

static void test_error_codes(void)
{
    TEST_ASSERT_EQUAL_HEX16(0, app_error_code(APP_FAULT_NONE, DRIVE_FAULT_NONE));
    TEST_ASSERT_EQUAL_HEX16(0x4310, app_error_code(APP_FAULT_TEMPERATURE, DRIVE_FAULT_NONE));
    TEST_ASSERT_EQUAL_HEX16(0x8611, app_error_code(APP_FAULT_FOLLOWING, DRIVE_FAULT_NONE));
    TEST_ASSERT_EQUAL_HEX16(0x2310, app_error_code(APP_FAULT_DRIVE, DRIVE_FAULT_OVER_CURRENT));
    TEST_ASSERT_EQUAL_HEX16(0x7121, app_error_code(APP_FAULT_DRIVE, DRIVE_FAULT_STALL));
    for (int f = 1; f <= (int)APP_FAULT_FOLLOWING; f++) {
        TEST_ASSERT_TRUE(app_error_code((app_fault_t)f, DRIVE_FAULT_NONE) >= 0x1000U);
    }
    for (int f = 1; f <= (int)DRIVE_FAULT_MEMORY; f++) {
        TEST_ASSERT_TRUE(app_error_code(APP_FAULT_DRIVE, (drive_fault_t)f) > 0x1000U);
    }
    TEST_ASSERT_EQUAL_HEX16(0x1000, app_error_code((app_fault_t)99, DRIVE_FAULT_NONE));
}

static void test_registers_at_the_start(void)
{
    /* dc link in range, remote; speed is zero */
    TEST_ASSERT_EQUAL_HEX16(0x1210U, input(APP_REGISTERS_STATUSWORD) | 0x1000U);
    for (int address = 1; address < APP_REGISTERS_LIVE_END; address++) {
        TEST_ASSERT_EQUAL_UINT(0U, input(address));
    }
    static const struct {
        int address;
        int value;
    } others[] = {{APP_REGISTERS_MODE_OF_OPERATION, 3},
                  {APP_REGISTERS_QUICK_STOP_OPTION, 2},
                  {APP_REGISTERS_LOST_OPTION, 2},
                  {APP_REGISTERS_MAX_CURRENT + 1, 4000},
                  {APP_REGISTERS_SPEED_WINDOW, 50}};
    for (int address = 0; address < APP_REGISTERS_COMMAND_END; address++) {
        int want = 0;
        for (int i = 0; i < SUPPORT_COUNT(others); i++) {
            want = (others[i].address == address) ? others[i].value : want;
        }
        TEST_ASSERT_EQUAL_INT(want, holding(address));
    }
    TEST_ASSERT_FALSE(registers.changed);
}

static uint32_t input_32(int address)
{
    uint16_t words[2] = {0xDEADU, 0xDEADU};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_input(&registers, (uint16_t)address, 2U, words));
    return ((uint32_t)words[0] << 16) | words[1];
}

static void test_values_are_held_at_the_ends_of_their_type(void)
{
    registers.status.speed_e_radps = 1.0e9f;
    registers.status.i_A.q         = -1.0e9f;
    registers.status.v_V.q         = 1.0e9f;
    registers.status.v_V.d         = -1.0e9f;
    registers.status.dc_link_V     = 1.0e9f;
    TEST_ASSERT_EQUAL_HEX32(0x7FFFFF80U, input_32(APP_REGISTERS_SPEED_NOW)); /* the last float */
    TEST_ASSERT_EQUAL_HEX32(0x80000080U, input_32(APP_REGISTERS_IQ));
    TEST_ASSERT_EQUAL_HEX16(0x7FFFU, input(APP_REGISTERS_VQ));
    TEST_ASSERT_EQUAL_HEX16(0x8000U, input(APP_REGISTERS_VD));
    TEST_ASSERT_EQUAL_HEX16(0xFFFFU, input(APP_REGISTERS_DC_LINK));
    registers.status.dc_link_V     = -5.0f;
    registers.status.speed_e_radps = NAN;
    registers.status.v_V.q         = NAN;
    TEST_ASSERT_EQUAL_HEX16(0U, input(APP_REGISTERS_DC_LINK));
    TEST_ASSERT_EQUAL_HEX32(0x80000080U, input_32(APP_REGISTERS_SPEED_NOW));
    TEST_ASSERT_EQUAL_HEX16(0x8000U, input(APP_REGISTERS_VQ));
}

/* 6,500 rad/s electrical: more than 16 bits of tenths. */
static void test_a_fast_motor_can_be_commanded_and_told(void)
{
    const uint16_t fast[]   = {0U, 65000U};
    drive.speed_max_e_radps = 6500.0f;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_write(&registers, APP_REGISTERS_SPEED, 2U, fast));
    TEST_ASSERT_TRUE(registers.requested.objects.omega_e_radps == 6500.0f);
    registers.status.speed_e_radps = -6500.0f;
    TEST_ASSERT_EQUAL_INT(-65000, (int32_t)input_32(APP_REGISTERS_SPEED_NOW));
    TEST_ASSERT_EQUAL_INT(-206901,
                          (int32_t)input_32(APP_REGISTERS_SPEED_NOW_RPM)); /* 20690.14 r/min */
    TEST_ASSERT_EQUAL_INT(20690, (int16_t)holding(APP_REGISTERS_SPEED_RPM_16));
    registers.requested.objects.omega_e_radps = 3.0f; /* -1000 r/min, then 10.5 r/min */
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SPEED_RPM_16, -1000));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, -314.15927f, registers.requested.objects.omega_e_radps);
    const uint16_t slow[] = {0U, 105U};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_write(&registers, APP_REGISTERS_SPEED_RPM, 2U, slow));
    TEST_ASSERT_FLOAT_WITHIN(1.0e-5f, 3.2986723f, registers.requested.objects.omega_e_radps);
    TEST_ASSERT_EQUAL_INT(33, holding(APP_REGISTERS_SPEED + 1));
}

static void test_constants_of_the_drive_are_told(void)
{
    TEST_ASSERT_EQUAL_INT(3, input(APP_REGISTERS_POLE_PAIRS));
    TEST_ASSERT_EQUAL_UINT(drive.hardware.encoder_positions,
                           input_32(APP_REGISTERS_ENCODER_POSITIONS));
    TEST_ASSERT_EQUAL_UINT(200000U, input_32(APP_REGISTERS_CONTROL_PERIOD));
    TEST_ASSERT_EQUAL_UINT(15690U, input_32(APP_REGISTERS_SPEED_MAX));
    TEST_ASSERT_EQUAL_UINT(49943U, input_32(APP_REGISTERS_SPEED_MAX_RPM)); /* 4994.3 r/min */
    TEST_ASSERT_EQUAL_UINT((unsigned)lrint(1000.0 * (double)drive.current_max_A),
                           input_32(APP_REGISTERS_CURRENT_MAX));
    TEST_ASSERT_EQUAL_UINT((unsigned)((10.0 * (double)drive.dc_link_max_V) + 0.5),
                           input(APP_REGISTERS_DC_LINK_MAX));
    TEST_ASSERT_EQUAL_INT(900, input(APP_REGISTERS_TEMPERATURE_TRIP));
    TEST_ASSERT_EQUAL_INT(1, holding(APP_REGISTERS_MODBUS_ADDRESS));
    TEST_ASSERT_EQUAL_INT(500, holding(APP_REGISTERS_MODBUS_TIMEOUT));
}

/* In whatever pieces a block is read, its words are the same. */
static void test_a_block_may_be_cut_anywhere(void)
{
    uint16_t all[128];
    uint16_t part[128];
    registers.status.ticks         = 0x12345678UL;
    registers.status.speed_e_radps = -1.5f;
    const uint16_t count           = APP_REGISTERS_LIVE_END;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, app_registers_read_input(&registers, 0U, count, all));
    for (uint16_t first = 0U; first < count; first++) {
        for (uint16_t n = 1U; n <= (uint16_t)(count - first); n++) {
            part[n] = 0xA5A5U;
            TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                                  app_registers_read_input(&registers, first, n, part));
            TEST_ASSERT_EQUAL_HEX16_ARRAY(&all[first], part, n);
            TEST_ASSERT_EQUAL_HEX16(0xA5A5U, part[n]);
        }
    }
}

static void test_input_registers_are_read_as_holding_registers_too(void)
{
    uint16_t all[64];
    uint16_t again[64];
    registers.status.speed_e_radps = -1.5f;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_input(&registers, 0U, APP_REGISTERS_LIVE_END, all));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, app_registers_read_holding(
                                                &registers, 4096U, APP_REGISTERS_LIVE_END, again));
    TEST_ASSERT_EQUAL_HEX16_ARRAY(all, again, APP_REGISTERS_LIVE_END);
    TEST_ASSERT_EQUAL_INT(
        APP_REGISTERS_BAD_ADDRESS,
        app_registers_read_holding(&registers, 4096U, APP_REGISTERS_LIVE_END + 1U, again));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS, write(4096, 0));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS,
                          app_registers_read_holding(&registers, 4095U, 2U, again));
}

static void test_conditions_reset_and_phase_errors(void)
{
    registers.status.dc_link_out = true;
    TEST_ASSERT_EQUAL_UINT(8U, input(APP_REGISTERS_CONDITIONS));
    registers.status.tripped = true;
    TEST_ASSERT_EQUAL_UINT(24U, input(APP_REGISTERS_CONDITIONS));
    registers.status.reset_cause  = BOARD_RESET_WATCHDOG;
    registers.status.phase_errors = 1234U;
    TEST_ASSERT_EQUAL_UINT(1U, input(APP_REGISTERS_RESET_CAUSE));
    TEST_ASSERT_EQUAL_UINT(1234U, input(APP_REGISTERS_PHASE_ERRORS));
    registers.status.ignored_angles   = 65535U;
    registers.status.ignored_currents = 7U;
    registers.status.without_angle    = true;
    TEST_ASSERT_EQUAL_UINT(65535U, input(APP_REGISTERS_IGNORED_ANGLES));
    TEST_ASSERT_EQUAL_UINT(7U, input(APP_REGISTERS_IGNORED_CURRENTS));
    TEST_ASSERT_EQUAL_UINT(88U, input(APP_REGISTERS_CONDITIONS));
    registers.status.shorted = true;
    TEST_ASSERT_EQUAL_UINT(120U, input(APP_REGISTERS_CONDITIONS));
}

static void test_limits_and_heat_are_told(void)
{
    TEST_ASSERT_EQUAL_UINT(0U, input(APP_REGISTERS_CONDITIONS));
    registers.status.voltage_limited = true;
    TEST_ASSERT_EQUAL_UINT(128U, input(APP_REGISTERS_CONDITIONS));
    registers.status.current_limited = true;
    TEST_ASSERT_EQUAL_UINT(128U + 256U, input(APP_REGISTERS_CONDITIONS));
    registers.status.derating = 0.25f;
    TEST_ASSERT_EQUAL_UINT(128U + 256U + 512U, input(APP_REGISTERS_CONDITIONS));
    TEST_ASSERT_EQUAL_UINT(250U, input(APP_REGISTERS_DERATING));
    registers.status.position_jumps = 3U;
    registers.status.motor_heat     = 0.5f;
    registers.status.inverter_heat  = 1.05f;
    TEST_ASSERT_EQUAL_UINT(3U, input(APP_REGISTERS_JUMPS));
    TEST_ASSERT_EQUAL_UINT(500U, input(APP_REGISTERS_MOTOR_HEAT));
    TEST_ASSERT_EQUAL_UINT(1050U, input(APP_REGISTERS_INVERTER_HEAT));
}

static void test_blocks_that_do_not_exist_as_a_whole_are_refused(void)
{
    static const uint32_t inputs[][2]   = {{62UL, 1UL},    {61UL, 2UL},    {0UL, 63UL},
                                           {127UL, 2UL},   {100UL, 60UL},  {186UL, 1UL},
                                           {65535UL, 1UL}, {65535UL, 2UL}, {1UL, 65535UL}};
    static const uint32_t holdings[][2] = {{23UL, 1UL}, {22UL, 2UL}, {0UL, 24UL}, {65535UL, 2UL}};
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
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, app_registers_read_input(&registers, 0U, 62U, values));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_holding(&registers, 0U, 22U, values));
}

static app_registers_result_t write_speed(int tenths)
{
    const uint16_t words[] = {(uint16_t)((uint32_t)tenths >> 16), (uint16_t)tenths};
    return app_registers_write(&registers, APP_REGISTERS_SPEED, 2U, words);
}

/* A value of 32 bits is written as a whole or not at all. */
static void test_half_of_a_value_is_not_written(void)
{
    const uint16_t words[] = {3U, 0U, 0U, 0U, 0U}; /* 3: a mode of operation */
    for (uint16_t first = 1U; first < 5U; first++) {
        for (uint16_t count = 1U; count < 5U; count++) {
            const bool begins = (first != 3U) && (first != 5U);
            const bool ends =
                (first + count != 3U) && (first + count != 5U) && (first + count != 8U);
            TEST_ASSERT_EQUAL_INT(
                (begins && ends) ? APP_REGISTERS_OK : APP_REGISTERS_BAD_ADDRESS,
                app_registers_write(&registers, first, count, &words[(first > 1U) ? 1 : 0]));
        }
    }
}

static void test_every_speed_in_range_is_taken_and_read_back(void)
{
    for (int tenths = -15690; tenths <= 15690; tenths++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_speed(tenths));
        TEST_ASSERT_TRUE(fabs((double)registers.requested.objects.omega_e_radps - (0.1 * tenths)) <
                         1.0e-4);
        TEST_ASSERT_EQUAL_HEX16((uint16_t)tenths, holding(APP_REGISTERS_SPEED + 1));
        TEST_ASSERT_EQUAL_HEX16((tenths < 0) ? 0xFFFFU : 0U, holding(APP_REGISTERS_SPEED));
    }
}

static void test_value_out_of_range_is_refused_and_changes_nothing(void)
{
    static const int bad[][2] = {{6, 5000}, {6, -5000}, {6, 32767}, {6, -32768}, {64, 0}, {1, 0},
                                 {1, 5},    {1, 2},     {1, 256},   {64, 248},   {13, 3}, {13, 4},
                                 {13, 7},   {14, 2},    {15, 2},    {16, 1},     {16, 4}};
    static const int speeds[] = {15691, -15691, 65000, -65000, 1 << 30, INT32_MIN};
    (void)write_speed(1234);
    registers.changed = false;
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write_speed(speeds[i]));
    }
    for (int i = 0; i < SUPPORT_COUNT(bad); i++) {
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write(bad[i][0], bad[i][1]));
    }
    TEST_ASSERT_EQUAL_UINT(1234U, holding(APP_REGISTERS_SPEED + 1));
    TEST_ASSERT_EQUAL_UINT(0U, holding(0));
    TEST_ASSERT_FALSE(registers.changed);
}

static void test_block_with_one_bad_value_is_refused_as_a_whole(void)
{
    const uint16_t block[] = {15U, 3U, 0U, 20000U};
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, app_registers_write(&registers, 0U, 4U, block));
    TEST_ASSERT_FALSE(registers.changed);
}

static void test_silence_stops_until_it_is_enabled_again(void)
{
    app_registers_silence(&registers);
    TEST_ASSERT_FALSE(registers.changed || registers.silent);
    (void)write(APP_REGISTERS_CONTROLWORD, 6);
    registers.changed = false;
    app_registers_silence(&registers);
    TEST_ASSERT_FALSE(registers.changed || registers.silent);
    (void)write(APP_REGISTERS_CONTROLWORD, 15);
    registers.changed = false;

    app_registers_silence(&registers);

    TEST_ASSERT_TRUE(registers.changed && registers.silent);
    TEST_ASSERT_EQUAL_UINT(APP_REGISTERS_SILENT, input(APP_REGISTERS_CONDITIONS) & 2U);
    TEST_ASSERT_EQUAL_UINT(0U, holding(APP_REGISTERS_CONTROLWORD));
    (void)write(APP_REGISTERS_CONTROLWORD, 6);
    TEST_ASSERT_TRUE(registers.silent);
    (void)write(APP_REGISTERS_LOST_OPTION, 3);
    (void)write(APP_REGISTERS_CONTROLWORD, 15);
    TEST_ASSERT_FALSE(registers.silent);
    app_registers_silence(&registers);
    TEST_ASSERT_EQUAL_UINT(2U, holding(APP_REGISTERS_CONTROLWORD)); /* quick stop */
}

/* Whole counts of 32 bits, of which a float holds 24. */
static void test_target_positions_are_taken_to_the_count(void)
{
    static const int32_t counts[] = {0,         1,          -1,         16777217,   -16777217,
                                     123456789, -987654321, 1000000000, -1000000000};
    for (int i = 0; i < SUPPORT_COUNT(counts); i++) {
        const uint32_t x        = (uint32_t)counts[i];
        const uint16_t words[2] = {(uint16_t)(x >> 16), (uint16_t)(x & 0xFFFFu)};
        TEST_ASSERT_EQUAL_INT(
            APP_REGISTERS_OK,
            app_registers_write(&registers, APP_REGISTERS_TARGET_POSITION, 2U, words));
        TEST_ASSERT_EQUAL_INT32(counts[i], registers.requested.positions.target);
    }
    const uint16_t beyond[2] = {0x4000U, 0U};
    TEST_ASSERT_EQUAL_INT(
        APP_REGISTERS_BAD_VALUE,
        app_registers_write(&registers, APP_REGISTERS_TARGET_POSITION, 2U, beyond));
}

int main(void)
{
    register_types();
    UNITY_BEGIN();
    RUN_TEST(test_target_positions_are_taken_to_the_count);
    RUN_TEST(test_input_registers_are_what_the_table_says);
    RUN_TEST(test_snapshot_registers_are_what_the_table_says);
    RUN_TEST(test_the_inertia_is_shown_by_runs_with_a_speed_and_an_encoder);
    RUN_TEST(test_the_law_gets_the_inertia_on_request);
    RUN_TEST(test_commissioning_registers_are_what_the_table_says);
    RUN_TEST(test_commissioning_is_asked_for_with_its_bounds);
    RUN_TEST(test_registers_at_the_start);
    RUN_TEST(test_values_are_held_at_the_ends_of_their_type);
    RUN_TEST(test_a_fast_motor_can_be_commanded_and_told);
    RUN_TEST(test_constants_of_the_drive_are_told);
    RUN_TEST(test_a_block_may_be_cut_anywhere);
    RUN_TEST(test_half_of_a_value_is_not_written);
    RUN_TEST(test_input_registers_are_read_as_holding_registers_too);
    RUN_TEST(test_conditions_reset_and_phase_errors);
    RUN_TEST(test_limits_and_heat_are_told);
    RUN_TEST(test_blocks_that_do_not_exist_as_a_whole_are_refused);
    RUN_TEST(test_every_speed_in_range_is_taken_and_read_back);
    RUN_TEST(test_value_out_of_range_is_refused_and_changes_nothing);
    RUN_TEST(test_block_with_one_bad_value_is_refused_as_a_whole);
    RUN_TEST(test_silence_stops_until_it_is_enabled_again);
    RUN_TEST(test_objects_are_written_and_read_back);
    RUN_TEST(test_the_line_is_changed_while_stopped_only);
    RUN_TEST(test_the_mode_of_operation_is_changed_in_a_run_too);
    RUN_TEST(test_statusword);
    RUN_TEST(test_target_reached_and_what_bit_12_says);
    RUN_TEST(test_error_codes);
    return UNITY_END();
}
