/* SPDX-License-Identifier: MIT */
/* Process data objects: mapping, transmission types, times. */
#include "canopen_bench.h"

#include "unity.h"

#define EMERGENCY   (0x80 + BENCH_NODE)
#define OPERATIONAL 1

static int octets[8];

void setUp(void)
{
    bench_start();
}

void tearDown(void) {}

static void sync(void)
{
    bench_send(0x80, 0, octets);
}

static int first_of(int id)
{
    return 0x100 * id + BENCH_NODE;
}

/* Gives a PDO one object, and a type. */
static void set_up(int settings, int mapping, uint32_t object, uint32_t type)
{
    uint32_t cob = 0;

    TEST_ASSERT_EQUAL_INT(4, bench_read(settings, 1, &cob));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(settings, 1, cob | 0x80000000UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(settings, 2, type, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(mapping, 0, 0, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(mapping, 1, object, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(mapping, 0, 1, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(settings, 1, cob, 4));
}

static void test_a_pdo_acts_in_the_operational_state_only(void)
{
    const int word[] = {0x06, 0x00};

    bench_send(first_of(2), 2, word);
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
    bench_nmt(OPERATIONAL, 0);
    bench_send(first_of(2), 2, word);
    TEST_ASSERT_EQUAL_HEX(6, registers.requested.objects.controlword);
    TEST_ASSERT_TRUE(registers.by_can);
    TEST_ASSERT_TRUE(registers.changed);
}

static void test_objects_of_a_pdo_are_written_in_order(void)
{
    const int target[] = {0x0F, 0x00, 0x18, 0xFC, 0xFF, 0xFF}; /* -1000 */
    const int speed[]  = {0x0F, 0x00, 0xE8, 0x03, 0x00, 0x00}; /* 100 r/min */
    const int mode[]   = {0x06, 0x00, 0x08 - 5};

    bench_nmt(OPERATIONAL, 0);
    bench_send(first_of(4), 6, target);
    TEST_ASSERT_EQUAL_INT(-1000, registers.requested.positions.target);
    TEST_ASSERT_EQUAL_HEX(0x0F, registers.requested.objects.controlword);
    bench_send(first_of(5), 6, speed);
    TEST_ASSERT_FLOAT_WITHIN(0.01F, 100.0F / registers.rpm_per_e_radps,
                             registers.requested.objects.omega_e_radps);
    bench_send(first_of(3), 3, mode);
    TEST_ASSERT_EQUAL_INT(3, registers.requested.objects.mode_of_operation);
    TEST_ASSERT_EQUAL_INT(0, bench_count(EMERGENCY));
}

static void test_types_up_to_240_wait_for_sync(void)
{
    const int one[] = {0x06, 0x00};
    const int two[] = {0x07, 0x00};

    set_up(0x1400, 0x1600, 0x60400010UL, 1);
    bench_nmt(OPERATIONAL, 0);
    bench_send(first_of(2), 2, one);
    bench_send(first_of(2), 2, two); /* the newest counts */
    bench_run_ms(20.0);
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
    sync();
    TEST_ASSERT_EQUAL_HEX(7, registers.requested.objects.controlword);
    registers.requested.objects.controlword = 0;
    sync(); /* once */
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
}

static void test_what_came_before_a_start_does_not_act_after_it(void)
{
    const int one[] = {0x06, 0x00};

    set_up(0x1400, 0x1600, 0x60400010UL, 1);
    bench_nmt(OPERATIONAL, 0);
    bench_send(first_of(2), 2, one);
    bench_nmt(128, 0);
    bench_nmt(OPERATIONAL, 0);
    sync();
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
}

static void test_short_and_refused_pdos_are_told(void)
{
    const int word[]    = {0x06};
    const int refused[] = {0x06, 0x00, 100};

    bench_nmt(OPERATIONAL, 0);
    bench_send(first_of(2), 1, word);
    bench_run(2);
    TEST_ASSERT_EQUAL_INT(8, bench_take(EMERGENCY, octets));
    TEST_ASSERT_EQUAL_HEX(0x8210, octets[0] | (octets[1] << 8));
    TEST_ASSERT_EQUAL_HEX(0, registers.requested.objects.controlword);
    bench_send(first_of(3), 3, refused);
    bench_run(2);
    TEST_ASSERT_EQUAL_INT(8, bench_take(EMERGENCY, octets));
    TEST_ASSERT_EQUAL_HEX(0x8200, octets[0] | (octets[1] << 8));
    TEST_ASSERT_EQUAL_INT(3, registers.requested.objects.mode_of_operation);
}

static void test_positions_and_speeds_leave_with_sync(void)
{
    registers.status.speed_e_radps = 100.0F / registers.rpm_per_e_radps;
    bench_nmt(OPERATIONAL, 0);
    bench_run_ms(20.0);
    (void)bench_count(0);
    bench_run_ms(100.0);
    TEST_ASSERT_EQUAL_INT(0, bench_count(0x480 + BENCH_NODE));
    sync();
    TEST_ASSERT_EQUAL_INT(6, bench_take(0x480 + BENCH_NODE, octets));
    TEST_ASSERT_EQUAL_INT(1000, octets[2] | (octets[3] << 8));
    TEST_ASSERT_EQUAL_INT(6, bench_take(0x380 + BENCH_NODE, octets));
    TEST_ASSERT_EQUAL_INT(-1, bench_take(0x380 + BENCH_NODE, octets));
}

static void test_every_nth_sync(void)
{
    set_up(0x1802, 0x1A02, 0x60640020UL, 3);
    bench_nmt(OPERATIONAL, 0);
    for (int n = 1; n <= 9; n++) {
        sync();
        TEST_ASSERT_EQUAL_INT(((n % 3) == 0) ? 1 : 0, bench_count(0x380 + BENCH_NODE));
    }
}

static void test_type_0_leaves_with_sync_after_a_change(void)
{
    set_up(0x1802, 0x1A02, 0x606C0020UL, 0);
    bench_nmt(OPERATIONAL, 0);
    sync(); /* the first state is news */
    TEST_ASSERT_EQUAL_INT(1, bench_count(0x380 + BENCH_NODE));
    sync();
    TEST_ASSERT_EQUAL_INT(0, bench_count(0x380 + BENCH_NODE));
    registers.status.speed_e_radps = 50.0F;
    bench_run_ms(10.0);
    TEST_ASSERT_EQUAL_INT(0, bench_count(0x380 + BENCH_NODE));
    sync();
    TEST_ASSERT_EQUAL_INT(1, bench_count(0x380 + BENCH_NODE));
}

static void test_a_change_is_an_event_that_the_inhibit_time_holds_back(void)
{
    bench_nmt(OPERATIONAL, 0);
    bench_run_ms(50.0);
    TEST_ASSERT_EQUAL_INT(1, bench_count(0x180 + BENCH_NODE)); /* the first state */
    bench_run_ms(1000.0);
    TEST_ASSERT_EQUAL_INT(0, bench_count(0x180 + BENCH_NODE));
    for (int n = 0; n < 500; n++) { /* changes every 0.2 ms, for 100 ms */
        registers.status.voltage_limited = !registers.status.voltage_limited;
        registers.status.gate_enable     = !registers.status.gate_enable;
        bench_run(1);
    }
    TEST_ASSERT_INT_WITHIN(1, 10, bench_count(0x180 + BENCH_NODE)); /* 10 ms between two */
}

static void test_the_event_timer_repeats(void)
{
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1800, 5, 50, 2));
    bench_nmt(OPERATIONAL, 0);
    bench_run_ms(1000.0);
    TEST_ASSERT_INT_WITHIN(1, 20, bench_count(0x180 + BENCH_NODE));
}

static void test_a_frame_that_the_bus_has_no_room_for_waits(void)
{
    bench_nmt(OPERATIONAL, 0);
    bench_run_ms(50.0);
    (void)bench_count(0);
    fake_board.can_room            = 0;
    registers.status.speed_e_radps = 10.0F;
    sync();
    registers.status.speed_e_radps = 99.0F; /* later than the SYNC */
    bench_run_ms(5.0);
    fake_board.can_room = 10;
    bench_run(1);
    TEST_ASSERT_EQUAL_INT(6, bench_take(0x480 + BENCH_NODE, octets));
    const float rpm = 0.1F * (float)(octets[2] | (octets[3] << 8));
    TEST_ASSERT_FLOAT_WITHIN(0.1F, 10.0F * registers.rpm_per_e_radps, rpm);
}

static void test_a_mapping_is_changed_while_the_pdo_is_off(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x08000022, bench_write(0x1A00, 0, 0, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1800, 1, 0x80000180UL + BENCH_NODE, 4));
    TEST_ASSERT_EQUAL_HEX32(0x08000022, bench_write(0x1A00, 1, 0x60640020UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1A00, 0, 0, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1A00, 1, 0x60640020UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06040041, bench_write(0x1A00, 2, 0x60640010UL, 4)); /* its length */
    TEST_ASSERT_EQUAL_HEX32(0x06040041, bench_write(0x1A00, 2, 0x10100120UL, 4)); /* a command */
    TEST_ASSERT_EQUAL_HEX32(0x06020000, bench_write(0x1A00, 2, 0x12340020UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06090011, bench_write(0x1A00, 2, 0x60410110UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1A00, 2, 0x606C0020UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1A00, 3, 0x60770010UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06040042, bench_write(0x1A00, 0, 3, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1A00, 3, 0, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06020000, bench_write(0x1A00, 0, 3, 1)); /* an empty place */
    TEST_ASSERT_EQUAL_HEX32(0x06040042, bench_write(0x1A00, 0, 9, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06090011, bench_write(0x1A00, 9, 0, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1A00, 0, 2, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1800, 1, 0x180UL + BENCH_NODE, 4));
    bench_nmt(OPERATIONAL, 0);
    bench_run_ms(20.0);
    TEST_ASSERT_EQUAL_INT(8, bench_take(0x180 + BENCH_NODE, octets));
}

static void test_received_objects_have_to_be_writable_or_nothing(void)
{
    const int both[] = {1, 2, 3, 4, 0x06, 0x00};

    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1400, 1, 0x80000200UL + BENCH_NODE, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1600, 0, 0, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06040041, bench_write(0x1600, 1, 0x60410010UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0,
                            bench_write(0x1600, 1, 0x00070020UL, 4)); /* four octets of nothing */
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1600, 2, 0x60400010UL, 4));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1600, 0, 2, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1400, 1, 0x321UL, 4));
    bench_nmt(OPERATIONAL, 0);
    bench_send(0x321, 6, both);
    TEST_ASSERT_EQUAL_HEX(6, registers.requested.objects.controlword);
}

static void test_identifiers_are_checked(void)
{
    static const uint32_t wrong[] = {0x0, 0x80, 0x180, 0x580, 0x601, 0x701, 0x20000321UL};

    TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x1400, 1, 0x322UL, 4)); /* while in use */
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1400, 1, 0x80000321UL, 4));
    for (size_t n = 0; n < sizeof wrong / sizeof wrong[0]; n++) {
        TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x1400, 1, wrong[n], 4));
    }
    TEST_ASSERT_EQUAL_INT(6, fake_board.can_id_count); /* NMT, SYNC, SDO, three PDOs */
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1400, 1, 0x321UL, 4));
    TEST_ASSERT_EQUAL_INT(7, fake_board.can_id_count);
    TEST_ASSERT_EQUAL_HEX(0x321, fake_board.can_ids[3]);
    TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x1400, 2, 241, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x1400, 2, 253, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x1400, 2, 240, 1));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_pdo_acts_in_the_operational_state_only);
    RUN_TEST(test_objects_of_a_pdo_are_written_in_order);
    RUN_TEST(test_types_up_to_240_wait_for_sync);
    RUN_TEST(test_what_came_before_a_start_does_not_act_after_it);
    RUN_TEST(test_short_and_refused_pdos_are_told);
    RUN_TEST(test_positions_and_speeds_leave_with_sync);
    RUN_TEST(test_every_nth_sync);
    RUN_TEST(test_type_0_leaves_with_sync_after_a_change);
    RUN_TEST(test_a_change_is_an_event_that_the_inhibit_time_holds_back);
    RUN_TEST(test_the_event_timer_repeats);
    RUN_TEST(test_a_frame_that_the_bus_has_no_room_for_waits);
    RUN_TEST(test_a_mapping_is_changed_while_the_pdo_is_off);
    RUN_TEST(test_received_objects_have_to_be_writable_or_nothing);
    RUN_TEST(test_identifiers_are_checked);
    return UNITY_END();
}
