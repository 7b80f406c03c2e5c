/* SPDX-License-Identifier: MIT */
/* PDOs that wait for SYNC act in the control interrupt: the whole application, tick by tick. */
#include "app.h"
#include "app_line.h"
#include "app_parameters.h"
#include "board_config.h"
#include "fake_board.h"
#include "gain_tables.h"
#include "unity.h"

#define NODE      1
#define CONTROL   (0x200 + NODE) /* received PDO 1: 6040h */
#define AND_MODE  (0x300 + NODE) /* received PDO 2: 6040h, 6060h */
#define AND_SPEED (0x500 + NODE) /* received PDO 4: 6040h, 60FFh */
#define SYNC      0x80

#define SHUT_DOWN 6
#define SWITCH_ON 7

#define DISABLED APP_CONTROL_SWITCH_ON_DISABLED
#define READY    APP_CONTROL_READY_TO_SWITCH_ON
#define SWITCHED APP_CONTROL_SWITCHED

#define REST_TICKS (250 + 1280 + 2) /* after a start, until the drive is at rest */

static app_config_t config;

static void both(int count)
{
    for (int n = 0; n < count; n++) {
        app_tick();
        app_background();
    }
}

static void put_frame(int id, int length, const int *octets)
{
    board_can_frame_t *f = &fake_board.can_rx[fake_board.can_rx_count++];

    f->id     = (uint16_t)id;
    f->length = (uint16_t)length;
    for (int n = 0; n < length; n++) {
        f->octets[n] = (uint16_t)octets[n];
    }
}

/* The bus has it, and the background has not read it. */
static void put_sync(void)
{
    put_frame(SYNC, 0, NULL);
}

static void nmt(int command)
{
    const int octets[] = {command, 0};

    put_frame(0, 2, octets);
    both(2);
}

static void control(int controlword)
{
    const int octets[] = {controlword, 0};

    put_frame(CONTROL, 2, octets);
}

static void write_register(int address, int word)
{
    const uint16_t words[] = {(uint16_t)word};

    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_write(&app_line.registers, (uint16_t)address, 1U, words));
}

static app_control_state_t state(void)
{
    return app_status_read().state;
}

void setUp(void)
{
    fake_board_reset();
    config = board_config;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &gain_tables_drive));
    app_take_parameters(APP_PARAMETERS_NOT_ASKED);
    both(REST_TICKS);
    nmt(1);
    for (int n = 0; n < (int)APP_CANOPEN_PDOS; n++) {
        app_line.canopen.received[n].type = 1U;
    }
    TEST_ASSERT_EQUAL_INT(APP_CANOPEN_OPERATIONAL, app_line.canopen.state);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
}

void tearDown(void) {}

static void test_the_tick_after_sync_takes_the_command(void)
{
    control(SHUT_DOWN);
    both(20);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    TEST_ASSERT_EQUAL_HEX(0, app_line.registers.requested.objects.controlword);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(READY, state());
    TEST_ASSERT_EQUAL_HEX(0, app_line.registers.requested.objects.controlword);
    both(3);
    TEST_ASSERT_EQUAL_HEX(SHUT_DOWN, app_line.registers.requested.objects.controlword);
    TEST_ASSERT_EQUAL_INT(READY, state());
    TEST_ASSERT_TRUE(app_line.registers.by_can);
    write_register(APP_REGISTERS_CONTROLWORD, 0);
    both(3);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
}

static bool is_free(void)
{
    const app_objects_t o = app_line.registers.requested.objects;

    return app_command_write(&o); /* false: one waits for the tick */
}

/* A command takes three periods, and SYNC may come every fifth. */
static void test_the_command_is_given_once(void)
{
    control(SHUT_DOWN);
    both(5);
    put_sync();
    app_tick();
    app_background();
    TEST_ASSERT_EQUAL_HEX(SHUT_DOWN, app_line.registers.requested.objects.controlword);
    TEST_ASSERT_TRUE(is_free());
    both(2);
    control(SWITCH_ON);
    both(5);
    put_sync();
    app_background(); /* reads SYNC before the tick sees it */
    TEST_ASSERT_FALSE(is_free());
    app_tick();
    TEST_ASSERT_EQUAL_INT(SWITCHED, state());
    app_background();
    TEST_ASSERT_TRUE(is_free());
}

static void test_a_second_sync_takes_nothing_back(void)
{
    control(SHUT_DOWN);
    both(5);
    put_sync();
    put_sync();
    app_background(); /* reads both */
    app_tick();
    TEST_ASSERT_EQUAL_INT(READY, state());
    both(5);
    TEST_ASSERT_EQUAL_INT(READY, state());
}

static void test_a_sync_before_the_pdo_does_not_count(void)
{
    put_sync();
    both(3);
    control(SHUT_DOWN);
    both(5);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
}

static void test_so_does_one_after_the_background_has_read_sync(void)
{
    control(SHUT_DOWN);
    both(20);
    put_sync();
    app_background();
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    app_tick();
    TEST_ASSERT_EQUAL_INT(READY, state());
}

/* Ticks and passes in the order of these bits, around SYNC. Frames before it delay its reading. */
static void go_through(int order, int write_at, int frames)
{
    bool ready = false;

    control(SHUT_DOWN);
    for (int n = 0; n < 8; n++) {
        if (n == 2) {
            for (int k = 0; k < frames; k++) {
                put_frame(0x701, 1, (const int[]){5});
            }
            put_sync();
        }
        if (n == write_at) {
            write_register(APP_REGISTERS_SPEED_WINDOW, 40 + n);
        }
        if ((order & (1 << n)) != 0) {
            app_tick();
        } else {
            app_background();
        }
        TEST_ASSERT_FALSE((n < 2) && (state() != DISABLED));
        TEST_ASSERT_FALSE(ready && (state() != READY)); /* not taken back */
        ready = ready || (state() == READY);
    }
    both(5);
    TEST_ASSERT_EQUAL_INT(READY, state());
    TEST_ASSERT_EQUAL_HEX(SHUT_DOWN, app_line.registers.requested.objects.controlword);
}

static void test_no_order_loses_a_command_or_takes_one_back(void)
{
    for (int order = 0; order < 256; order++) {
        for (int write_at = 0; write_at < 9; write_at += 2) {
            for (int frames = 0; frames < 5; frames += 4) {
                setUp();
                go_through(order, write_at, frames);
            }
        }
    }
}

static void sync_and_tick(void)
{
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(READY, state());
}

/* The background has looked, and is about to withdraw the command. */
static void test_a_tick_in_between_is_not_taken_back(void)
{
    control(SHUT_DOWN);
    both(5);
    write_register(APP_REGISTERS_SPEED_WINDOW, 40);
    fake_board.after_triggered = sync_and_tick;
    app_background();
    for (int n = 0; n < 5; n++) {
        app_tick();
        TEST_ASSERT_EQUAL_INT(READY, state());
        app_background();
    }
    TEST_ASSERT_EQUAL_HEX(SHUT_DOWN, app_line.registers.requested.objects.controlword);
}

static void test_a_change_of_modbus_does_not_wait_for_sync(void)
{
    const int speed[] = {SWITCH_ON, 0, 0xE8, 0x03, 0, 0};

    write_register(APP_REGISTERS_CONTROLWORD, SHUT_DOWN);
    both(3);
    TEST_ASSERT_EQUAL_INT(READY, state());
    put_frame(AND_SPEED, 6, speed);
    both(5);
    write_register(APP_REGISTERS_CONTROLWORD, 0);
    both(3);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    write_register(APP_REGISTERS_CONTROLWORD, SHUT_DOWN);
    both(3);
    TEST_ASSERT_EQUAL_INT(READY, state());
    put_sync();
    app_tick(); /* the PDO has been prepared again */
    TEST_ASSERT_EQUAL_INT(SWITCHED, state());
    both(3);
    TEST_ASSERT_FLOAT_WITHIN(0.01F, 100.0F / app_line.registers.rpm_per_e_radps,
                             app_line.registers.requested.objects.omega_e_radps);
}

static void test_the_newest_of_two_counts(void)
{
    control(SHUT_DOWN);
    both(5);
    control(0);
    both(5);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    both(3);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
}

static void test_pdos_of_one_sync_act_together(void)
{
    const int mode[] = {SHUT_DOWN, 0, APP_CONTROL_PROFILE_VELOCITY};

    control(0);
    put_frame(AND_MODE, 3, mode); /* the later PDO number wins */
    both(5);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(READY, state());
}

static void test_a_node_that_stops_drops_what_waits(void)
{
    control(SHUT_DOWN);
    both(5);
    nmt(128);
    both(5);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    both(5);
    nmt(1);
    put_sync();
    both(5);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    TEST_ASSERT_EQUAL_HEX(0, app_line.registers.requested.objects.controlword);
}

static void drop_frames(void)
{
    fake_board.can_rx_count  = 0;
    fake_board.can_triggered = false;
}

/* The tick has taken what the registers never hear of. */
static void test_a_dropped_sync_takes_the_command_back(void)
{
    control(SHUT_DOWN);
    both(5);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(READY, state());
    drop_frames();
    both(5);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(READY, state());
    drop_frames();
    app_canopen_start(&app_line.canopen, &app_line.registers);
    both(5);
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
}

static void test_a_pdo_that_is_set_anew_does_not_act(void)
{
    control(SHUT_DOWN);
    both(5);
    const int off[] = {0x23, 0x00, 0x14, 1, 0x01, 0x02, 0, 0x80}; /* 1400h:1 */
    put_frame(0x600 + NODE, 8, off);
    both(5);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
}

/* Constants of another mode come with a command of the background. */
static void test_another_mode_waits_for_the_background(void)
{
    const int mode[] = {SHUT_DOWN, 0, 0xFE};

    put_frame(AND_MODE, 3, mode);
    both(5);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    both(2);
    TEST_ASSERT_EQUAL_INT(READY, state());
    TEST_ASSERT_EQUAL_INT(APP_CONTROL_FIND_ANGLE,
                          app_line.registers.requested.objects.mode_of_operation);
}

static void is_refused(int id, int length, const int *octets)
{
    put_frame(id, length, octets);
    both(5);
    TEST_ASSERT_EQUAL_INT(0, app_line.canopen.emergency.count);
    put_sync();
    app_tick();
    TEST_ASSERT_EQUAL_INT(DISABLED, state());
    both(3);
    TEST_ASSERT_EQUAL_INT(READY, state()); /* the object before it */
    TEST_ASSERT_EQUAL_HEX(0x8200, app_line.canopen.emergency.errors[0].code);
}

static void test_a_refused_value_is_told_with_sync(void)
{
    const int mode[] = {SHUT_DOWN, 0, 100};

    is_refused(AND_MODE, 3, mode);
}

static void test_a_speed_beyond_the_drive_too(void)
{
    const float most_rpm = gain_tables_drive.speed_max_e_radps * app_line.registers.rpm_per_e_radps;
    const int   x        = (int)(11.0f * most_rpm); /* 10 % more, in 0.1 r/min */
    const int   speed[]  = {SHUT_DOWN, 0, x & 0xFF, (x >> 8) & 0xFF, (x >> 16) & 0xFF, 0};

    is_refused(AND_SPEED, 6, speed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_tick_after_sync_takes_the_command);
    RUN_TEST(test_the_command_is_given_once);
    RUN_TEST(test_a_second_sync_takes_nothing_back);
    RUN_TEST(test_a_sync_before_the_pdo_does_not_count);
    RUN_TEST(test_so_does_one_after_the_background_has_read_sync);
    RUN_TEST(test_no_order_loses_a_command_or_takes_one_back);
    RUN_TEST(test_a_tick_in_between_is_not_taken_back);
    RUN_TEST(test_a_change_of_modbus_does_not_wait_for_sync);
    RUN_TEST(test_the_newest_of_two_counts);
    RUN_TEST(test_pdos_of_one_sync_act_together);
    RUN_TEST(test_a_node_that_stops_drops_what_waits);
    RUN_TEST(test_a_dropped_sync_takes_the_command_back);
    RUN_TEST(test_a_pdo_that_is_set_anew_does_not_act);
    RUN_TEST(test_another_mode_waits_for_the_background);
    RUN_TEST(test_a_refused_value_is_told_with_sync);
    RUN_TEST(test_a_speed_beyond_the_drive_too);
    return UNITY_END();
}
