/* SPDX-License-Identifier: MIT */
#include "app_modbus.h"
#include "app_modbus_frame.h"

#include <string.h>

#include "board_config.h"
#include "fake_board.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define ADDRESS 17
#define GAP     10
#define TIMEOUT 2500

static app_config_t    config;
static app_modbus_t    modbus;
static app_registers_t registers;
static uint32_t        now;
static int             answer[300];
static int             answer_count;

void setUp(void)
{
    fake_board_reset();
    config                      = board_config;
    config.modbus_address       = ADDRESS;
    config.modbus_timeout_ticks = TIMEOUT;
    config.drive_name           = "a drive";
    config.digest               = "1234";
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_registers_init(&registers, &config, &gain_tables_drive));
    (void)memset(&modbus, 0xFF, sizeof modbus); /* init has to set everything */
    now = 0xFFFFFF00UL;                         /* wraps within every longer test */
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_modbus_init(&modbus, GAP));
    modbus.request_ticks = now;
}

void tearDown(void) {}

/* Oracle: CRC as remainder of the bit-reversed message times x^16, by long division, most significant bit first. */
static int oracle_crc(const int *octets, int count)
{
    unsigned long remainder = 0UL;
    for (int bit = 0; bit < (8 * count) + 16; bit++) {
        const int           octet = bit / 8;
        const unsigned long raw =
            (octet < count) ? (((unsigned long)octets[octet] >> (bit % 8)) & 1UL) : 0UL;
        const unsigned long in = (bit < 16) ? (raw ^ 1UL) : raw; /* starts with all ones */
        remainder              = (remainder << 1) | in;
        if ((remainder & 0x10000UL) != 0UL) {
            remainder ^= 0x18005UL;
        }
    }
    int reversed = 0;
    for (int bit = 0; bit < 16; bit++) {
        reversed |= (int)((remainder >> bit) & 1UL) << (15 - bit);
    }
    return reversed;
}

static void poll_ticks(int count)
{
    for (int n = 0; n < count; n++) {
        now++;
        app_modbus_poll(&modbus, &registers, now);
    }
}

static void take_answer(void)
{
    answer_count = 0;
    for (int octet = fake_board_sent(); octet >= 0; octet = fake_board_sent()) {
        answer[answer_count++] = octet;
    }
}

static void send_raw(const int *octets, int count)
{
    fake_board_receive(octets, count);
    poll_ticks((count / 16) + 1 + GAP + 1);
    take_answer();
}

/* Body without CRC. */
static void request(const int *body, int count)
{
    int       frame[300];
    const int crc = oracle_crc(body, count);
    for (int i = 0; i < count; i++) {
        frame[i] = body[i];
    }
    frame[count]     = crc & 0xFF;
    frame[count + 1] = crc >> 8;
    send_raw(frame, count + 2);
}

static void assert_answer(const int *body, int count)
{
    TEST_ASSERT_EQUAL_INT(count + 2, answer_count);
    for (int i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_HEX8(body[i], answer[i]);
    }
    const int crc = oracle_crc(body, count);
    TEST_ASSERT_EQUAL_HEX8(crc & 0xFF, answer[count]);
    TEST_ASSERT_EQUAL_HEX8(crc >> 8, answer[count + 1]);
}

#define REQUEST(...)                                                                               \
    do {                                                                                           \
        const int body_[] = {__VA_ARGS__};                                                         \
        request(body_, SUPPORT_COUNT(body_));                                                      \
    } while (0)
#define ASSERT_ANSWER(...)                                                                         \
    do {                                                                                           \
        const int body_[] = {__VA_ARGS__};                                                         \
        assert_answer(body_, SUPPORT_COUNT(body_));                                                \
    } while (0)

static bool enabled(void)
{
    return app_control_enables(registers.requested.objects.controlword);
}

static void test_crc_matches_long_division(void)
{
    support_random_t random = {.state = 5u};
    for (int n = 0; n < 300; n++) {
        int       octets[60];
        uint16_t  words[60];
        const int count = 2 + (n % 58);
        for (int i = 0; i < count; i++) {
            octets[i] = (int)support_uniform(&random, 0.0f, 255.9f);
            words[i]  = (uint16_t)octets[i];
        }
        TEST_ASSERT_EQUAL_HEX16(oracle_crc(octets, count), app_modbus_crc(words, (uint16_t)count));
    }
}

/* Check value of CRC-16/MODBUS, from the catalogue of CRCs: "123456789" gives 4B37. */
static void test_crc_has_the_catalogued_check_value(void)
{
    const uint16_t text[] = {0x31U, 0x32U, 0x33U, 0x34U, 0x35U, 0x36U, 0x37U, 0x38U, 0x39U};
    TEST_ASSERT_EQUAL_HEX16(0x4B37U, app_modbus_crc(text, 9U));
}

static void test_input_registers_are_read(void)
{
    registers.status.mode         = APP_MODE_RUN;
    registers.status.board_faults = 0xA5U;
    registers.status.ticks        = 0x01020304UL;
    REQUEST(ADDRESS, 4, 0, APP_REGISTERS_MODE, 0, 1);
    ASSERT_ANSWER(ADDRESS, 4, 2, 0, 4);
    REQUEST(ADDRESS, 4, 0, APP_REGISTERS_BOARD_FAULTS, 0, 1);
    ASSERT_ANSWER(ADDRESS, 4, 2, 0, 0xA5);
    REQUEST(ADDRESS, 4, 0, APP_REGISTERS_TICKS, 0, 2);
    ASSERT_ANSWER(ADDRESS, 4, 4, 1, 2, 3, 4);
    REQUEST(ADDRESS, 4, 0, 0, 0, 42);
    TEST_ASSERT_EQUAL_INT(5 + 84, answer_count);
}

static void test_holding_registers_are_written_and_read(void)
{
    REQUEST(ADDRESS, 6, 0, APP_REGISTERS_SPEED_RPM_16, 0xFC, 0x18); /* -1000 r/min, 2 pole pairs */
    ASSERT_ANSWER(ADDRESS, 6, 0, APP_REGISTERS_SPEED_RPM_16, 0xFC, 0x18);
    TEST_ASSERT_FLOAT_WITHIN(1.0e-3f, -209.43951f, registers.requested.objects.omega_e_radps);
    REQUEST(ADDRESS, 16, 0, 0, 0, 4, 8, 0, 15, 0, 3, 0, 0, 0x0B, 0xB8);
    ASSERT_ANSWER(ADDRESS, 16, 0, 0, 0, 4);
    TEST_ASSERT_TRUE(enabled() && (registers.requested.objects.omega_e_radps == 300.0f));
    REQUEST(ADDRESS, 3, 0, 0, 0, 4);
    ASSERT_ANSWER(ADDRESS, 3, 8, 0, 15, 0, 3, 0, 0, 0x0B, 0xB8);
}

/* First to read, how many; first to write, how many, octets, values. */
static void test_an_exchange_writes_and_then_reads(void)
{
    REQUEST(ADDRESS, 23, 0, 0, 0, 4, 0, 2, 0, 2, 4, 0xFF, 0xFF, 0xF4, 0x48);
    ASSERT_ANSWER(ADDRESS, 23, 8, 0, 0, 0, 3, 0xFF, 0xFF, 0xF4, 0x48);
    TEST_ASSERT_TRUE(registers.requested.objects.omega_e_radps == -300.0f);
    REQUEST(ADDRESS, 23, 0, 0, 0, 126, 0, 2, 0, 2, 4, 0, 0, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x97, 3);
    REQUEST(ADDRESS, 23, 0, 0, 0, 0, 0, 2, 0, 2, 4, 0, 0, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x97, 3);
    REQUEST(ADDRESS, 23, 0, 60, 0, 1, 0, 2, 0, 2, 4, 0, 0, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x97, 2);
    REQUEST(ADDRESS, 23, 0, 0, 0, 1, 0, 60, 0, 2, 4, 0, 0, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x97, 2);
    REQUEST(ADDRESS, 23, 0, 0, 0, 1, 0, 2, 0, 1, 4, 0, 0, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x97, 3);
    REQUEST(ADDRESS, 23, 0, 0, 0, 1, 0, 2, 0, 2, 4, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    TEST_ASSERT_TRUE(registers.requested.objects.omega_e_radps == -300.0f);
    int longest[11 + 242] = {ADDRESS, 23, 0, 0, 0, 1, 0, 0, 0, 121, 242};
    request(longest, 11 + 242);
    ASSERT_ANSWER(ADDRESS, 0x97, 2);
    REQUEST(0, 23, 0, 0, 0, 1, 0, 2, 0, 2, 4, 0, 0, 0, 10);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    TEST_ASSERT_TRUE(registers.requested.objects.omega_e_radps == 1.0f);
}

static int count_of(int which)
{
    REQUEST(ADDRESS, 8, 0, which, 0, 0);
    TEST_ASSERT_EQUAL_INT(8, answer_count);
    TEST_ASSERT_EQUAL_INT(which, answer[3]);
    return (answer[4] << 8) | answer[5];
}

static void test_diagnostics_loop_back_and_count(void)
{
    REQUEST(ADDRESS, 8, 0, 0, 0x12, 0x34);
    ASSERT_ANSWER(ADDRESS, 8, 0, 0, 0x12, 0x34);
    REQUEST(ADDRESS, 8, 0, 0, 1, 2, 3, 4, 5);
    ASSERT_ANSWER(ADDRESS, 8, 0, 0, 1, 2, 3, 4, 5);
    REQUEST(ADDRESS, 8, 0, 10, 0, 0);
    ASSERT_ANSWER(ADDRESS, 8, 0, 10, 0, 0);

    REQUEST(ADDRESS + 1, 6, 0, 0, 0, 1); /* for another: a frame all the same */
    REQUEST(ADDRESS, 99);                /* an exception */
    REQUEST(0, 6, 0, 0, 0, 0);           /* not answered */
    const int noise[] = {ADDRESS, 4, 0, 0, 0, 1, 0, 0};
    send_raw(noise, 8);
    int too_long[300] = {0};
    send_raw(too_long, 300);

    TEST_ASSERT_EQUAL_INT(
        4 + 0, count_of(11)); /* this request is counted too; the clearing one was before */
    TEST_ASSERT_EQUAL_INT(1, count_of(12));
    TEST_ASSERT_EQUAL_INT(1, count_of(13));
    TEST_ASSERT_EQUAL_INT(6, count_of(14));
    TEST_ASSERT_EQUAL_INT(1, count_of(15));
    TEST_ASSERT_EQUAL_INT(1, count_of(18));
    REQUEST(ADDRESS, 8, 0, 10, 0, 0);
    TEST_ASSERT_EQUAL_INT(0, count_of(12));
    TEST_ASSERT_EQUAL_INT(2, count_of(14));

    REQUEST(ADDRESS, 8, 0, 1, 0, 0);
    ASSERT_ANSWER(ADDRESS, 0x88, 1);
    REQUEST(ADDRESS, 8, 0, 11, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x88, 3);
    REQUEST(ADDRESS, 8, 0);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
}

/* Objects of the last answer: finds one. */
static const int *object(int id)
{
    int at = 8;
    for (int k = 0; k < answer[7]; k++) {
        if (answer[at] == id) {
            return &answer[at + 1];
        }
        at += 2 + answer[at + 1];
    }
    return NULL;
}

static void assert_object(int id, const char *text)
{
    const int *found = object(id);
    TEST_ASSERT_NOT_NULL(found);
    TEST_ASSERT_EQUAL_INT((int)strlen(text), found[0]);
    for (int n = 0; n < found[0]; n++) {
        TEST_ASSERT_EQUAL_INT(text[n], found[1 + n]);
    }
}

static void test_identification_tells_firmware_drive_and_digests(void)
{
    REQUEST(ADDRESS, 43, 14, 1, 0);
    TEST_ASSERT_EQUAL_INT(0x83, answer[4]);
    TEST_ASSERT_EQUAL_INT(0, answer[5]); /* nothing follows */
    TEST_ASSERT_EQUAL_INT(3, answer[7]);
    assert_object(0, "sdre-drive");
    assert_object(2, APP_REGISTERS_VERSION);
    REQUEST(ADDRESS, 43, 14, 2, 0);
    TEST_ASSERT_EQUAL_INT(4, answer[7]);
    REQUEST(ADDRESS, 43, 14, 3, 0);
    TEST_ASSERT_EQUAL_INT(8, answer[7]);
    assert_object(0x80, "a drive");
    assert_object(0x81, "1234");
    assert_object(0x82, APP_REGISTERS_DIGEST);
    assert_object(0x83, ""); /* nobody has told of a board */
    const app_image_t   image  = {.board = &board_identity};
    app_loader_t        loader = {.in_force = &image};
    app_loader_t *const kept   = registers.loader;
    registers.loader           = &loader;
    REQUEST(ADDRESS, 43, 14, 4, 0x83);
    assert_object(0x83, "board_390w");
    registers.loader = kept;
    REQUEST(ADDRESS, 43, 14, 3, 0x81);
    TEST_ASSERT_EQUAL_INT(3, answer[7]);
    REQUEST(ADDRESS, 43, 14, 3, 77); /* unknown: from the beginning, by the protocol */
    TEST_ASSERT_EQUAL_INT(8, answer[7]);
    REQUEST(ADDRESS, 43, 14, 4, 0x80);
    TEST_ASSERT_EQUAL_INT(1, answer[7]);
    assert_object(0x80, "a drive");
    REQUEST(ADDRESS, 43, 14, 4, 77);
    ASSERT_ANSWER(ADDRESS, 0xAB, 2);
    REQUEST(ADDRESS, 43, 14, 0, 0);
    ASSERT_ANSWER(ADDRESS, 0xAB, 3);
    REQUEST(ADDRESS, 43, 14, 5, 0);
    ASSERT_ANSWER(ADDRESS, 0xAB, 3);
    REQUEST(ADDRESS, 43, 13, 1, 0);
    ASSERT_ANSWER(ADDRESS, 0xAB, 1);
    REQUEST(ADDRESS, 43, 14, 1);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    config.drive_name = "a name that is longer than any name of a drive has to be";
    REQUEST(ADDRESS, 43, 14, 4, 0x80);
    TEST_ASSERT_EQUAL_INT(24, answer[9]);
}

static void test_address_and_time_out_are_registers(void)
{
    REQUEST(ADDRESS, 6, 0, APP_REGISTERS_MODBUS_ADDRESS, 0, 33);
    ASSERT_ANSWER(ADDRESS, 6, 0, APP_REGISTERS_MODBUS_ADDRESS, 0, 33);
    REQUEST(ADDRESS, 3, 0, 0, 0, 1);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(33, 6, 0, APP_REGISTERS_MODBUS_TIMEOUT, 0x03, 0xE8); /* 1 s, 5000 ticks */
    ASSERT_ANSWER(33, 6, 0, APP_REGISTERS_MODBUS_TIMEOUT, 0x03, 0xE8);
    REQUEST(33, 6, 0, 0, 0, 15);
    poll_ticks(4980);
    TEST_ASSERT_TRUE(enabled());
    poll_ticks(40);
    TEST_ASSERT_FALSE(enabled());
    REQUEST(33, 6, 0, APP_REGISTERS_MODBUS_ADDRESS, 0, 248);
    ASSERT_ANSWER(33, 0x86, 3);
    REQUEST(33, 6, 0, APP_REGISTERS_MODBUS_TIMEOUT, 0, 9);
    ASSERT_ANSWER(33, 0x86, 3);
}

static void test_unknown_functions_are_refused(void)
{
    static const int functions[] = {1, 2, 5, 7, 15, 17, 22, 24, 42, 100};
    for (int i = 0; i < SUPPORT_COUNT(functions); i++) {
        REQUEST(ADDRESS, functions[i], 0, 0, 0, 1);
        ASSERT_ANSWER(ADDRESS, functions[i] | 0x80, 1);
    }
    REQUEST(ADDRESS, 7); /* the shortest frame there is */
    ASSERT_ANSWER(ADDRESS, 0x87, 1);
}

static void test_registers_that_do_not_exist_are_refused(void)
{
    REQUEST(ADDRESS, 3, 0, APP_REGISTERS_COMMAND_END, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x83, 2);
    REQUEST(ADDRESS, 4, 0, APP_REGISTERS_LIVE_END - 1, 0, 2);
    ASSERT_ANSWER(ADDRESS, 0x84, 2);
    REQUEST(ADDRESS, 4, 2, 0, 0, 1); /* high octet of the address */
    ASSERT_ANSWER(ADDRESS, 0x84, 2);
    REQUEST(ADDRESS, 6, 0, APP_REGISTERS_COMMAND_END, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x86, 2);
    REQUEST(ADDRESS, 16, 0, APP_REGISTERS_COMMAND_END - 1, 0, 2, 4, 0, 1, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x90, 2);
    REQUEST(ADDRESS, 6, 0, APP_REGISTERS_SPEED, 0, 1); /* half of a value */
    ASSERT_ANSWER(ADDRESS, 0x86, 2);
    TEST_ASSERT_FALSE(registers.changed);
}

static void test_bad_values_and_quantities_are_refused(void)
{
    REQUEST(ADDRESS, 3, 0, 0, 0, 0);
    ASSERT_ANSWER(ADDRESS, 0x83, 3);
    REQUEST(ADDRESS, 4, 0, 0, 0, 126);
    ASSERT_ANSWER(ADDRESS, 0x84, 3);
    REQUEST(ADDRESS, 4, 0, 0, 0, 125);
    ASSERT_ANSWER(ADDRESS, 0x84, 2);
    REQUEST(ADDRESS, 6, 0, APP_REGISTERS_MODE_OF_OPERATION, 0, 2);
    ASSERT_ANSWER(ADDRESS, 0x86, 3);
    REQUEST(ADDRESS, 16, 0, 0, 0, 2, 2, 0, 1); /* says two, brings one */
    ASSERT_ANSWER(ADDRESS, 0x90, 3);
    REQUEST(ADDRESS, 16, 0, 0, 0, 0, 2, 0, 1);
    ASSERT_ANSWER(ADDRESS, 0x90, 3);
    REQUEST(ADDRESS, 16, 0, 0, 0, 0, 0);
    ASSERT_ANSWER(ADDRESS, 0x90, 3);
    TEST_ASSERT_FALSE(registers.changed);
}

static void test_longest_write_is_understood(void)
{
    int body[7 + 246] = {ADDRESS, 16, 0, 0, 0, 123, 246};
    request(body, 7 + 246);
    ASSERT_ANSWER(ADDRESS, 0x90, 2);
}

static void test_broadcast_writes_are_done_and_not_answered(void)
{
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    TEST_ASSERT_TRUE(enabled());
    REQUEST(0, 6, 0, 0, 0, 15);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    TEST_ASSERT_TRUE(enabled());
    REQUEST(0, 16, 0, 2, 0, 2, 4, 0, 0, 0, 10);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    TEST_ASSERT_TRUE(registers.requested.objects.omega_e_radps == 1.0f);
    REQUEST(0, 3, 0, 0, 0, 1);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(0, 99, 0, 0, 0, 1);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
}

static void test_a_broadcast_stops_every_motor_and_starts_none(void)
{
    REQUEST(0, 6, 0, 0, 0, 15);
    TEST_ASSERT_FALSE(enabled());
    REQUEST(0, 16, 0, 0, 0, 4, 8, 0, 15, 0, 3, 0, 0, 0, 10);
    TEST_ASSERT_FALSE(enabled());
    TEST_ASSERT_TRUE(registers.requested.objects.omega_e_radps == 1.0f);
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    REQUEST(0, 6, 0, 0, 0, 0);
    TEST_ASSERT_FALSE(enabled());
}

static void test_frames_for_others_are_left_alone(void)
{
    for (int to = 1; to < 256; to++) {
        if (to != ADDRESS) {
            REQUEST(to, 6, 0, 0, 0, 15);
            TEST_ASSERT_EQUAL_INT(0, answer_count);
        }
    }
    TEST_ASSERT_FALSE(registers.changed);
}

static void test_every_single_bit_error_is_noticed(void)
{
    const int body[] = {ADDRESS, 6, 0, 0, 0, 15};
    const int crc    = oracle_crc(body, 6);
    for (int bit = 0; bit < 64; bit++) {
        int frame[8] = {ADDRESS, 6, 0, 0, 0, 15, crc & 0xFF, crc >> 8};
        frame[bit / 8] ^= 1 << (bit % 8);
        send_raw(frame, 8);
        TEST_ASSERT_EQUAL_INT(0, answer_count);
        TEST_ASSERT_FALSE(registers.changed);
    }
}

static void test_length_that_does_not_fit_the_function_is_ignored(void)
{
    REQUEST(ADDRESS, 3, 0, 0, 0, 1, 0);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(ADDRESS, 3, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(ADDRESS, 6, 0, 0, 0, 1, 0);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(ADDRESS, 16, 0, 0, 0, 1, 2, 0);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(ADDRESS, 16, 0, 0, 0, 1, 2, 0, 1, 0);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(ADDRESS, 16);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(ADDRESS);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    TEST_ASSERT_FALSE(registers.changed);
}

static void put(const int *octets, int count)
{
    fake_board_receive(octets, count);
    poll_ticks(1);
}

static void test_gap_ends_a_frame_and_nothing_shorter(void)
{
    const int body[]   = {ADDRESS, 6, 0, 0, 0, 15};
    const int crc      = oracle_crc(body, 6);
    const int frame[8] = {ADDRESS, 6, 0, 0, 0, 15, crc & 0xFF, crc >> 8};
    put(frame, 3);
    poll_ticks(GAP - 1);
    put(&frame[3], 5);
    poll_ticks(GAP - 1);
    take_answer();
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    poll_ticks(2);
    take_answer();
    TEST_ASSERT_EQUAL_INT(8, answer_count);

    put(frame, 3);
    poll_ticks(GAP);
    put(&frame[3], 5);
    poll_ticks(GAP + 1);
    take_answer();
    TEST_ASSERT_EQUAL_INT(0, answer_count);

    send_raw(frame, 8);
    TEST_ASSERT_EQUAL_INT(8, answer_count);
}

static void test_octets_one_by_one_make_a_frame(void)
{
    const int body[]   = {ADDRESS, 6, 0, 0, 0, 15};
    const int crc      = oracle_crc(body, 6);
    const int frame[8] = {ADDRESS, 6, 0, 0, 0, 15, crc & 0xFF, crc >> 8};
    for (int i = 0; i < 8; i++) {
        put(&frame[i], 1);
        poll_ticks(GAP / 2);
    }
    poll_ticks(GAP);
    take_answer();
    TEST_ASSERT_EQUAL_INT(8, answer_count);
}

static void test_single_octet_of_noise_is_forgotten(void)
{
    const int noise = 0xFF;
    put(&noise, 1);
    poll_ticks(GAP);
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    TEST_ASSERT_EQUAL_INT(8, answer_count);
}

static void test_noise_longer_than_a_frame_is_forgotten(void)
{
    int noise[700];
    for (int i = 0; i < 700; i++) {
        noise[i] = i & 0xFF;
    }
    send_raw(noise, 700);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    TEST_ASSERT_EQUAL_INT(8, answer_count);
}

/* A valid request at the start of what is too long for a frame. */
static void test_frame_that_is_too_long_is_not_taken_for_its_start(void)
{
    int body[262] = {ADDRESS, 16, 0, 0, 0, 123, 247};
    request(body, 254);
    TEST_ASSERT_EQUAL_INT(8 - 3, answer_count); /* exactly 256: refused by its quantity */
    request(body, 255);
    TEST_ASSERT_EQUAL_INT(0, answer_count);

    int       frame[257];
    const int crc = oracle_crc(body, 254);
    for (int i = 0; i < 254; i++) {
        frame[i] = body[i];
    }
    frame[254] = crc & 0xFF;
    frame[255] = crc >> 8;
    frame[256] = 0; /* one more than a valid frame of 256 */
    send_raw(frame, 257);
    TEST_ASSERT_EQUAL_INT(0, answer_count);
}

static void test_full_transmitter_is_waited_for(void)
{
    fake_board.serial_room = 3;
    REQUEST(ADDRESS, 4, 0, 0, 0, 4);
    TEST_ASSERT_EQUAL_INT(3, answer_count);
    int more = 0;
    for (int n = 0; n < 10; n++) {
        fake_board.serial_room = 1;
        poll_ticks(1);
        while (fake_board_sent() >= 0) {
            more++;
        }
    }
    TEST_ASSERT_EQUAL_INT(13 - 3, more);
}

static void test_what_comes_while_answering_is_dropped(void)
{
    fake_board.serial_room = 0;
    REQUEST(ADDRESS, 4, 0, 0, 0, 4);
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    TEST_ASSERT_FALSE(registers.changed);
    fake_board.serial_room = 100;
    poll_ticks(GAP + 2);
    take_answer();
    TEST_ASSERT_EQUAL_INT(13, answer_count);
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    TEST_ASSERT_EQUAL_INT(8, answer_count);
}

static void test_one_poll_takes_a_bounded_number_of_octets(void)
{
    int noise[100] = {0};
    fake_board_receive(noise, 100);
    poll_ticks(1);
    TEST_ASSERT_EQUAL_INT(84, fake_board.rx.count);
}

static void test_octets_are_eight_bits_wide(void)
{
    registers.status.mode = APP_MODE_RUN;
    const int body[]      = {ADDRESS, 4, 0, APP_REGISTERS_MODE, 0, 1};
    const int crc         = oracle_crc(body, 6);
    const int frame[8]    = {ADDRESS | 0x300, 4,       0, 0x100 | APP_REGISTERS_MODE, 0, 1,
                             crc & 0xFF,      crc >> 8};
    send_raw(frame, 8);
    ASSERT_ANSWER(ADDRESS, 4, 2, 0, 4);
}

static void test_silence_withdraws_run_after_its_time(void)
{
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    const uint32_t heard = modbus.request_ticks;
    while ((uint32_t)(now - heard) < (uint32_t)TIMEOUT) {
        poll_ticks(1);
        TEST_ASSERT_TRUE(enabled());
    }
    poll_ticks(1);
    TEST_ASSERT_TRUE(!enabled() && registers.silent);
}

static void test_any_request_for_us_keeps_the_run_alive_and_noise_does_not(void)
{
    REQUEST(ADDRESS, 6, 0, 0, 0, 15);
    for (int n = 0; n < 5; n++) {
        poll_ticks(TIMEOUT - 100);
        REQUEST(ADDRESS, 4, 0, 0, 0, 1);
        TEST_ASSERT_TRUE(enabled());
    }
    const int noise[] = {ADDRESS, 4, 0, 0, 0, 1, 0, 0};
    for (int n = 0; n < 5; n++) {
        send_raw(noise, 8);
        REQUEST(ADDRESS + 1, 4, 0, 0, 0, 1);
        poll_ticks(TIMEOUT / 5);
    }
    TEST_ASSERT_FALSE(enabled());
}

/* No answer is as long: the guard is for a state that memory has lost. */
static void test_an_answer_ends_with_its_frame(void)
{
    app_modbus_t       m;
    const app_modbus_t before = {.values = {0x5AU}};

    m = before;
    for (uint16_t n = 0U; n < (APP_MODBUS_FRAME_MAX + 10U); n++) {
        app_modbus_frame_octet(&m, n);
    }
    TEST_ASSERT_EQUAL_UINT(APP_MODBUS_FRAME_MAX, m.tx_count);
    TEST_ASSERT_EQUAL_UINT(255U, m.tx_octets[255]);
    TEST_ASSERT_EQUAL_UINT(0x5AU, m.values[0]);
    m.tx_count = UINT16_MAX;
    app_modbus_frame_word(&m, 0x1234U);
    TEST_ASSERT_EQUAL_UINT(UINT16_MAX, m.tx_count);
}

static void test_arguments_out_of_range_are_refused(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_modbus_init(&modbus, 0U));
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_modbus_init(&modbus, 1U));
    static const int bad[][2] = {{0, TIMEOUT}, {248, TIMEOUT}, {1, 0}};
    for (int i = 0; i < SUPPORT_COUNT(bad); i++) {
        config.modbus_address       = (uint16_t)bad[i][0];
        config.modbus_timeout_ticks = (uint16_t)bad[i][1];
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                              app_registers_init(&registers, &config, &gain_tables_drive));
    }
    config.modbus_address       = 247U;
    config.modbus_timeout_ticks = 1U;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_registers_init(&registers, &config, &gain_tables_drive));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_crc_matches_long_division);
    RUN_TEST(test_crc_has_the_catalogued_check_value);
    RUN_TEST(test_input_registers_are_read);
    RUN_TEST(test_holding_registers_are_written_and_read);
    RUN_TEST(test_an_exchange_writes_and_then_reads);
    RUN_TEST(test_diagnostics_loop_back_and_count);
    RUN_TEST(test_identification_tells_firmware_drive_and_digests);
    RUN_TEST(test_address_and_time_out_are_registers);
    RUN_TEST(test_unknown_functions_are_refused);
    RUN_TEST(test_registers_that_do_not_exist_are_refused);
    RUN_TEST(test_bad_values_and_quantities_are_refused);
    RUN_TEST(test_longest_write_is_understood);
    RUN_TEST(test_broadcast_writes_are_done_and_not_answered);
    RUN_TEST(test_a_broadcast_stops_every_motor_and_starts_none);
    RUN_TEST(test_frames_for_others_are_left_alone);
    RUN_TEST(test_every_single_bit_error_is_noticed);
    RUN_TEST(test_length_that_does_not_fit_the_function_is_ignored);
    RUN_TEST(test_gap_ends_a_frame_and_nothing_shorter);
    RUN_TEST(test_octets_one_by_one_make_a_frame);
    RUN_TEST(test_single_octet_of_noise_is_forgotten);
    RUN_TEST(test_noise_longer_than_a_frame_is_forgotten);
    RUN_TEST(test_frame_that_is_too_long_is_not_taken_for_its_start);
    RUN_TEST(test_full_transmitter_is_waited_for);
    RUN_TEST(test_what_comes_while_answering_is_dropped);
    RUN_TEST(test_one_poll_takes_a_bounded_number_of_octets);
    RUN_TEST(test_octets_are_eight_bits_wide);
    RUN_TEST(test_silence_withdraws_run_after_its_time);
    RUN_TEST(test_any_request_for_us_keeps_the_run_alive_and_noise_does_not);
    RUN_TEST(test_an_answer_ends_with_its_frame);
    RUN_TEST(test_arguments_out_of_range_are_refused);
    return UNITY_END();
}
