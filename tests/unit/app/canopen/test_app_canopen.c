/* SPDX-License-Identifier: MIT */
/* States, emergencies and lost connections of the node. */
#include "canopen_bench.h"

#include "unity.h"

#define STATE     (0x700 + BENCH_NODE)
#define EMERGENCY (0x80 + BENCH_NODE)
#define STOPPED   0x0006 /* control words: shut down, enable operation */
#define ENABLED   0x000F

static int octets[8];

void setUp(void)
{
    bench_start();
}

void tearDown(void) {}

static int state(void)
{
    return (bench_take(STATE, octets) == 1) ? octets[0] : -1;
}

static void expect_emergency(int code, int reg)
{
    TEST_ASSERT_EQUAL_INT(8, bench_take(EMERGENCY, octets));
    TEST_ASSERT_EQUAL_HEX(code, octets[0] | (octets[1] << 8));
    TEST_ASSERT_EQUAL_HEX(reg, octets[2]);
}

static void enable_by_can(void)
{
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x6040, 0, ENABLED, 2));
    TEST_ASSERT_TRUE(registers.by_can);
}

static void test_a_start_is_told_once(void)
{
    app_canopen_start(&node, &registers);
    bench_run_ms(50.0);
    TEST_ASSERT_EQUAL_INT(0, state());
    TEST_ASSERT_EQUAL_INT(-1, state());
    TEST_ASSERT_EQUAL_INT(APP_CANOPEN_PRE_OPERATIONAL, node.state);
    TEST_ASSERT_EQUAL_UINT(500, fake_board.can_rate_kbps);
}

static void test_the_start_waits_for_the_bus(void)
{
    app_canopen_start(&node, &registers);
    fake_board.can_room = 0;
    bench_run_ms(50.0);
    bench_nmt(1, 0);
    TEST_ASSERT_EQUAL_INT(APP_CANOPEN_BOOTS, node.state);
    fake_board.can_room = 1;
    bench_run(1);
    TEST_ASSERT_EQUAL_INT(0, state());
    TEST_ASSERT_EQUAL_INT(APP_CANOPEN_PRE_OPERATIONAL, node.state);
}

static void test_commands_change_the_state(void)
{
    static const struct {
        int command, to, state;
    } steps[] = {{1, BENCH_NODE, 5}, {2, BENCH_NODE, 4}, {128, BENCH_NODE, 127}, {1, 0, 5},
                 {128, 0, 127},      {2, 0, 4},          {1, BENCH_NODE + 1, 4}, {7, 0, 4},
                 {1, BENCH_NODE, 5}};

    for (size_t n = 0; n < sizeof steps / sizeof steps[0]; n++) {
        bench_nmt(steps[n].command, steps[n].to);
        TEST_ASSERT_EQUAL_INT_MESSAGE(steps[n].state, node.state, "command");
    }
    const int one[] = {2};
    bench_send(0, 1, one); /* no command: too short */
    TEST_ASSERT_EQUAL_INT(5, node.state);
}

static void test_a_stopped_node_answers_no_request(void)
{
    const int request[] = {0x40, 0x00, 0x10, 0, 0, 0, 0, 0};

    bench_nmt(2, 0);
    bench_send(0x600 + BENCH_NODE, 8, request);
    bench_run_ms(20.0);
    TEST_ASSERT_EQUAL_INT(0, bench_count(0x580 + BENCH_NODE));
}

static void test_the_heartbeat_has_its_period_and_the_state(void)
{
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1017, 0, 100, 2));
    bench_run_ms(100.0);
    (void)bench_count(STATE);
    bench_run_ms(1000.0);
    TEST_ASSERT_INT_WITHIN(1, 10, bench_count(STATE));
    bench_nmt(1, 0);
    bench_run_ms(110.0);
    TEST_ASSERT_EQUAL_INT(5, state());
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1017, 0, 0, 2));
    (void)bench_count(STATE);
    bench_run_ms(1000.0);
    TEST_ASSERT_EQUAL_INT(0, bench_count(STATE));
}

static void test_a_new_number_and_rate_act_with_reset_communication(void)
{
    registers.requested.can_node      = 9U;
    registers.requested.can_rate_kbps = 125U;
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1017, 0, 100, 2));
    bench_nmt(130, BENCH_NODE);
    bench_run_ms(10.0);
    TEST_ASSERT_EQUAL_UINT(125, fake_board.can_rate_kbps);
    TEST_ASSERT_EQUAL_INT(1, bench_take(0x709, octets));
    TEST_ASSERT_EQUAL_INT(0, octets[0]);
    TEST_ASSERT_EQUAL_UINT(0x609, fake_board.can_ids[2]);
    TEST_ASSERT_EQUAL_UINT(0, node.heartbeat_ms);
    TEST_ASSERT_FALSE(node.restart);
}

static void test_reset_node_restarts_the_drive_unless_modbus_runs_it(void)
{
    bench_nmt(129, BENCH_NODE);
    TEST_ASSERT_TRUE(node.restart);

    bench_start();
    registers.status.gate_enable            = true;
    registers.requested.objects.controlword = ENABLED;
    bench_nmt(129, BENCH_NODE);
    TEST_ASSERT_FALSE(node.restart);
    TEST_ASSERT_EQUAL_HEX(ENABLED, registers.requested.objects.controlword);

    bench_start();
    registers.status.gate_enable = true;
    enable_by_can();
    bench_nmt(129, BENCH_NODE);
    TEST_ASSERT_TRUE(node.restart);
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
}

static void test_leaving_the_operational_state_stops_a_drive_that_can_commands(void)
{
    static const int commands[] = {2, 128, 130};

    for (size_t n = 0; n < sizeof commands / sizeof commands[0]; n++) {
        bench_start();
        bench_nmt(1, 0);
        enable_by_can();
        bench_nmt(commands[n], 0);
        TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
        TEST_ASSERT_TRUE(registers.silent);
    }
    bench_start(); /* Modbus has it */
    bench_nmt(1, 0);
    registers.requested.objects.controlword = ENABLED;
    bench_nmt(128, 0);
    TEST_ASSERT_EQUAL_HEX(ENABLED, registers.requested.objects.controlword);
    bench_start(); /* without PDOs from the beginning */
    enable_by_can();
    bench_nmt(128, 0);
    TEST_ASSERT_EQUAL_HEX(ENABLED, registers.requested.objects.controlword);
}

static void test_the_bus_that_wrote_the_control_word_last_commands(void)
{
    const uint16_t words[] = {ENABLED};

    enable_by_can();
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, app_registers_write(&registers, 0U, 1U, words));
    TEST_ASSERT_FALSE(registers.by_can);
    enable_by_can();
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x60FF, 0, 10, 4));
    TEST_ASSERT_TRUE(registers.by_can);
    const uint16_t window[] = {3U}; /* of Modbus, but no control word */
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_write(&registers, APP_REGISTERS_SPEED_WINDOW, 1U, window));
    TEST_ASSERT_TRUE(registers.by_can);
}

static void test_a_lost_heartbeat_stops_the_drive(void)
{
    const int alive[] = {5};

    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1016, 1, (0x20UL << 16) | 50UL, 4));
    TEST_ASSERT_EQUAL_UINT(0x720, fake_board.can_ids[fake_board.can_id_count - 1]);
    bench_nmt(1, 0);
    enable_by_can();
    bench_run_ms(500.0); /* not heard yet: not watched */
    TEST_ASSERT_EQUAL_HEX(ENABLED, registers.requested.objects.controlword);
    for (int n = 0; n < 10; n++) {
        bench_send(0x720, 1, alive);
        bench_run_ms(45.0);
    }
    TEST_ASSERT_EQUAL_HEX(ENABLED, registers.requested.objects.controlword);
    TEST_ASSERT_EQUAL_INT(0, bench_count(EMERGENCY));
    bench_run_ms(10.0);
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
    TEST_ASSERT_EQUAL_INT(APP_CANOPEN_PRE_OPERATIONAL, node.state);
    expect_emergency(0x8130, 0x11);
    bench_send(0x720, 1, alive);
    bench_run_ms(10.0);
    expect_emergency(0, 0);
}

static void test_a_late_pdo_stops_the_drive(void)
{
    const int word[] = {ENABLED, 0};

    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1400, 5, 20, 2));
    bench_nmt(1, 0);
    bench_send(0x200 + BENCH_NODE, 2, word);
    bench_run_ms(15.0);
    TEST_ASSERT_EQUAL_HEX(ENABLED, registers.requested.objects.controlword);
    bench_run_ms(10.0);
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
    expect_emergency(0x8250, 0);
    TEST_ASSERT_EQUAL_INT(APP_CANOPEN_PRE_OPERATIONAL, node.state);
}

static void test_off_the_bus_the_drive_stops_and_says_so_later(void)
{
    bench_nmt(1, 0);
    enable_by_can();
    fake_board.can_state = BOARD_CAN_PASSIVE;
    bench_run(2);
    TEST_ASSERT_EQUAL_HEX(ENABLED, registers.requested.objects.controlword);
    expect_emergency(0x8120, 0x11);
    fake_board.can_state = BOARD_CAN_PASSIVE | BOARD_CAN_OFF;
    fake_board.can_room  = 0;
    bench_run(2);
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
    fake_board.can_state = 0;
    fake_board.can_room  = 100;
    bench_run(4);
    expect_emergency(0x8140, 0);
    expect_emergency(0, 0);
}

static void test_a_frame_without_room_is_told(void)
{
    fake_board.can_state = BOARD_CAN_LOST;
    bench_run(1);
    fake_board.can_state = 0;
    bench_run(2);
    expect_emergency(0x8110, 0x11);
}

static void test_faults_are_told_with_their_end_and_kept(void)
{
    uint32_t value = 0;

    registers.status.fault       = APP_FAULT_DRIVE;
    registers.status.drive_fault = DRIVE_FAULT_OVER_CURRENT;
    bench_run(3);
    expect_emergency(0x2310, 0x03);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_DRIVE, octets[3]);
    TEST_ASSERT_EQUAL_INT(DRIVE_FAULT_OVER_CURRENT, octets[4]);
    TEST_ASSERT_EQUAL_INT(-1, bench_take(EMERGENCY, octets));
    TEST_ASSERT_EQUAL_INT(1, bench_read(0x1001, 0, &value));
    TEST_ASSERT_EQUAL_HEX32(0x03, value);

    registers.status.fault       = APP_FAULT_NONE;
    registers.status.drive_fault = DRIVE_FAULT_NONE;
    bench_run(3);
    expect_emergency(0, 0);
    TEST_ASSERT_EQUAL_INT(1, bench_read(0x1003, 0, &value));
    TEST_ASSERT_EQUAL_UINT32(2, value);
    TEST_ASSERT_EQUAL_INT(4, bench_read(0x1003, 2, &value));
    TEST_ASSERT_EQUAL_HEX32(0x2310, value & 0xFFFFUL);
    TEST_ASSERT_EQUAL_INT(-1, bench_read(0x1003, 3, &value));
    TEST_ASSERT_EQUAL_HEX32(APP_CANOPEN_VALUE, bench_write(0x1003, 0, 1, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1003, 0, 0, 1));
    TEST_ASSERT_EQUAL_INT(1, bench_read(0x1003, 0, &value));
    TEST_ASSERT_EQUAL_UINT32(0, value);
}

static void test_many_faults_on_a_bus_without_room_keep_their_order(void)
{
    fake_board.can_room = 0;
    for (int n = 1; n <= 12; n++) {
        registers.status.fault = (app_fault_t)(((n % 2) == 1) ? APP_FAULT_BOARD : APP_FAULT_TICK);
        bench_run(1);
    }
    fake_board.can_room = 100;
    bench_run(20);
    for (int n = 5; n <= 12; n++) { /* the eight newest */
        expect_emergency(((n % 2) == 1) ? 0x5400 : 0x6100, 0x01);
    }
    TEST_ASSERT_EQUAL_INT(-1, bench_take(EMERGENCY, octets));
}

static void test_a_sender_that_ceased_is_started_again(void)
{
    const int before = fake_board.can_starts;

    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1017, 0, 10, 2));
    fake_board.can_room = 0;
    bench_run_ms(900.0);
    TEST_ASSERT_EQUAL_INT(before, fake_board.can_starts);
    bench_run_ms(200.0);
    TEST_ASSERT_EQUAL_INT(before + 1, fake_board.can_starts);
    fake_board.can_state = BOARD_CAN_PASSIVE; /* nobody answers: that is no fault of the sender */
    bench_run_ms(3000.0);
    TEST_ASSERT_EQUAL_INT(before + 1, fake_board.can_starts);
}

static void test_quiet_means_no_answer_waits(void)
{
    const int request[] = {0x40, 0x00, 0x10, 0, 0, 0, 0, 0};

    bench_run_ms(50.0);
    TEST_ASSERT_TRUE(app_canopen_is_quiet(&node, now));
    fake_board.can_room = 0;
    bench_send(0x600 + BENCH_NODE, 8, request);
    bench_run_ms(100.0);
    TEST_ASSERT_FALSE(app_canopen_is_quiet(&node, now));
    fake_board.can_room = 10;
    bench_run(1);
    TEST_ASSERT_TRUE(app_canopen_is_quiet(&node, now));
    TEST_ASSERT_EQUAL_INT(1, bench_count(0x580 + BENCH_NODE));
}

/* A bus under way is no reason to wait: parameters are stored, and images loaded, beside its SYNC. */
static void test_quiet_means_no_request_for_a_while(void)
{
    const int request[] = {0x40, 0x00, 0x10, 0, 0, 0, 0, 0};

    bench_run_ms(50.0);
    bench_send(0x600 + BENCH_NODE, 8, request);
    const uint32_t asked = now;
    for (int n = 0; n < 30; n++) {
        bench_send(0x80, 0, request);
        bench_run_ms(1.0);
        TEST_ASSERT_EQUAL_INT((now - asked) >= 100U, app_canopen_is_quiet(&node, now)); /* 20 ms */
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_start_is_told_once);
    RUN_TEST(test_the_start_waits_for_the_bus);
    RUN_TEST(test_commands_change_the_state);
    RUN_TEST(test_a_stopped_node_answers_no_request);
    RUN_TEST(test_the_heartbeat_has_its_period_and_the_state);
    RUN_TEST(test_a_new_number_and_rate_act_with_reset_communication);
    RUN_TEST(test_reset_node_restarts_the_drive_unless_modbus_runs_it);
    RUN_TEST(test_leaving_the_operational_state_stops_a_drive_that_can_commands);
    RUN_TEST(test_the_bus_that_wrote_the_control_word_last_commands);
    RUN_TEST(test_a_lost_heartbeat_stops_the_drive);
    RUN_TEST(test_a_late_pdo_stops_the_drive);
    RUN_TEST(test_off_the_bus_the_drive_stops_and_says_so_later);
    RUN_TEST(test_a_frame_without_room_is_told);
    RUN_TEST(test_faults_are_told_with_their_end_and_kept);
    RUN_TEST(test_many_faults_on_a_bus_without_room_keep_their_order);
    RUN_TEST(test_a_sender_that_ceased_is_started_again);
    RUN_TEST(test_quiet_means_no_answer_waits);
    RUN_TEST(test_quiet_means_no_request_for_a_while);
    return UNITY_END();
}
