/* SPDX-License-Identifier: MIT */
/* Blocks of registers and the identification, octet by octet as CiA 301 has their transfers. */
#include "canopen_bench.h"

#include <string.h>

#include "app_canopen_block.h"
#include "board_config.h"
#include "unity.h"

#define REQUEST (0x600 + BENCH_NODE)
#define ANSWER  (0x580 + BENCH_NODE)

#define MOST 128 /* octets of a block */

static const app_image_t image = {.board = &board_identity};
static app_loader_t      loader;

void setUp(void)
{
    bench_start();
    (void)memset(&loader, 0, sizeof loader);
    loader.in_force = &image;
}

void tearDown(void) {}

static uint32_t code_of(const int *a)
{
    return (uint32_t)a[4] | ((uint32_t)a[5] << 8) | ((uint32_t)a[6] << 16) | ((uint32_t)a[7] << 24);
}

static void exchange(const int *request, int *answer)
{
    bench_send(REQUEST, 8, request);
    TEST_ASSERT_EQUAL_INT(8, bench_take(ANSWER, answer));
}

/* Octets of an object; -1: aborted. */
static int upload(int index, int sub, int *octets, uint32_t *code)
{
    const int begin[] = {0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0};
    int       toggle  = 0;
    int       n       = 0;
    int       a[8];

    exchange(begin, a);
    if (a[0] == 0x80) {
        *code = code_of(a);
        return -1;
    }
    if ((a[0] & 2) != 0) {
        for (n = 0; n < 4 - ((a[0] >> 2) & 3); n++) {
            octets[n] = a[4 + n];
        }
        return n;
    }
    const int said = (int)code_of(a);
    bool      last = false;
    while (!last) {
        exchange((const int[]){0x60 | toggle, 0, 0, 0, 0, 0, 0, 0}, a);
        TEST_ASSERT_EQUAL_HEX(toggle, a[0] & 0xF0);
        for (int k = 0; k < 7 - ((a[0] >> 1) & 7); k++) {
            TEST_ASSERT_TRUE(n < MOST);
            octets[n++] = a[1 + k];
        }
        last   = (a[0] & 1) != 0;
        toggle = toggle ^ 0x10;
    }
    TEST_ASSERT_EQUAL_INT(said, n);
    return n;
}

/* Writes holding registers in segments. @return the abort code, or 0. */
static uint32_t download(int sub, const int *words, int count)
{
    const int octets  = 2 * count;
    const int begin[] = {0x21, 0x00, 0x5F, sub, octets, 0, 0, 0};
    int       a[8];

    exchange(begin, a);
    for (int at = 0; (at < octets) && (a[0] != 0x80); at += 7) {
        const int here = (octets - at < 7) ? octets - at : 7;
        int part[8]    = {((at / 7) & 1) << 4 | (7 - here) << 1 | ((at + here == octets) ? 1 : 0)};

        for (int k = 0; k < here; k++) {
            part[1 + k] = (words[(at + k) / 2] >> (8 * ((at + k) & 1))) & 0xFF;
        }
        exchange(part, a);
    }
    return (a[0] == 0x80) ? code_of(a) : 0U;
}

static uint32_t select(uint32_t first, uint32_t count)
{
    return bench_write(APP_CANOPEN_BLOCK, 1, (count << 16) | first, 4);
}

static void test_a_block_has_what_modbus_reads(void)
{
    static const uint16_t counts[] = {1, 2, 3, 7, 62};

    for (int k = 0; k < 5; k++) {
        uint16_t words[64];
        int      octets[MOST] = {0};
        uint32_t code         = 0;

        TEST_ASSERT_EQUAL_HEX32(0, select(0, counts[k]));
        TEST_ASSERT_EQUAL_INT(2 * counts[k], upload(APP_CANOPEN_BLOCK, 2, octets, &code));
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                              app_registers_read_input(&registers, 0, counts[k], words));
        for (int n = 0; n < counts[k]; n++) {
            TEST_ASSERT_EQUAL_HEX(words[n], octets[2 * n] | (octets[(2 * n) + 1] << 8));
        }
    }
}

static void test_registers_of_a_block_act_together(void)
{
    const int good[]    = {6, 3, 0, 1000};
    const int refused[] = {15, 100, 0, 2000}; /* the second one is out of range */
    int       octets[MOST];
    uint32_t  code = 0;

    TEST_ASSERT_EQUAL_HEX32(0, select(0, 4));
    TEST_ASSERT_FALSE(registers.by_can);
    TEST_ASSERT_EQUAL_HEX32(0, download(3, good, 4));
    TEST_ASSERT_TRUE(registers.by_can);
    TEST_ASSERT_EQUAL_HEX(6, registers.requested.objects.controlword);
    TEST_ASSERT_EQUAL_FLOAT(100.0F, registers.requested.objects.omega_e_radps);
    TEST_ASSERT_EQUAL_HEX32(0x06090030, download(3, refused, 4));
    TEST_ASSERT_EQUAL_HEX(6, registers.requested.objects.controlword);
    TEST_ASSERT_EQUAL_INT(8, upload(APP_CANOPEN_BLOCK, 3, octets, &code));
    TEST_ASSERT_EQUAL_HEX(1000 & 0xFF, octets[6]);
    TEST_ASSERT_EQUAL_HEX(1000 >> 8, octets[7]);
    TEST_ASSERT_EQUAL_HEX32(0x06020000, download(3, good, 3)); /* half of a value */
}

static void test_what_cannot_be_a_block_is_refused(void)
{
    const int one[] = {1};
    int       octets[MOST];
    uint32_t  code = 0;

    TEST_ASSERT_EQUAL_HEX32(0x06090030, select(0, 0));
    TEST_ASSERT_EQUAL_HEX32(0x06090030, select(0, 65));
    TEST_ASSERT_EQUAL_HEX32(0, select(60, 64)); /* beyond the last register of a group */
    TEST_ASSERT_EQUAL_INT(-1, upload(APP_CANOPEN_BLOCK, 2, octets, &code));
    TEST_ASSERT_EQUAL_HEX32(0x06020000, code);
    TEST_ASSERT_EQUAL_INT(-1, upload(APP_CANOPEN_BLOCK, 4, octets, &code));
    TEST_ASSERT_EQUAL_HEX32(0x06090011, code);
    TEST_ASSERT_EQUAL_HEX32(0x06010002, download(2, one, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06010002, bench_write(APP_CANOPEN_BLOCK, 0, 1, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06070010,
                            bench_write(APP_CANOPEN_BLOCK, 3, 1, 3)); /* 1.5 registers */
}

static void test_the_loader_is_entered_by_a_block(void)
{
    const int enter[] = {APP_LOADER_ENTER};
    const int leave[] = {APP_LOADER_LEAVE};
    int       octets[MOST];
    uint32_t  code = 0;

    registers.loader = &loader;
    TEST_ASSERT_EQUAL_HEX32(0, select(APP_LOADER_FIRST, 4));
    TEST_ASSERT_EQUAL_INT(8, upload(APP_CANOPEN_BLOCK, 2, octets, &code));
    TEST_ASSERT_EQUAL_HEX32(0x06090030, download(3, leave, 1)); /* it is not there */
    TEST_ASSERT_FALSE(loader.restart);
    TEST_ASSERT_EQUAL_HEX32(0, download(3, enter, 1));
    TEST_ASSERT_TRUE(loader.restart);
    TEST_ASSERT_TRUE(loader.enter);
}

static void test_a_block_is_as_large_as_its_room(void)
{
    int words[65] = {0};

    TEST_ASSERT_EQUAL_HEX32(0, select(0, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06070010, download(3, words, 65));
    TEST_ASSERT_EQUAL_HEX32(0x06020000, download(3, words, 64)); /* it arrives; no such registers */
}

static void text_is(int sub, const char *wanted)
{
    int      octets[MOST] = {0};
    uint32_t code         = 0;

    TEST_ASSERT_EQUAL_INT((int)strlen(wanted), upload(APP_CANOPEN_IDENTITY, sub, octets, &code));
    for (size_t n = 0; n < strlen(wanted); n++) {
        TEST_ASSERT_EQUAL_INT(wanted[n], octets[n]);
    }
}

static void test_the_drive_identifies_itself(void)
{
    int      octets[MOST];
    uint32_t code = 0;

    registers.loader = &loader;
    text_is(1, registers.config->drive_name);
    text_is(2, registers.config->digest);
    text_is(3, APP_REGISTERS_DIGEST);
    text_is(4, board_identity.name);
    TEST_ASSERT_EQUAL_INT(1, upload(APP_CANOPEN_IDENTITY, 0, octets, &code));
    TEST_ASSERT_EQUAL_INT(4, octets[0]);
    TEST_ASSERT_EQUAL_INT(-1, upload(APP_CANOPEN_IDENTITY, 5, octets, &code));
    TEST_ASSERT_EQUAL_HEX32(0x06090011, code);
    TEST_ASSERT_EQUAL_HEX32(0x06010002, bench_write(APP_CANOPEN_IDENTITY, 0, 4, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06010002, bench_write(APP_CANOPEN_IDENTITY, 1, 4, 4));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_block_has_what_modbus_reads);
    RUN_TEST(test_registers_of_a_block_act_together);
    RUN_TEST(test_what_cannot_be_a_block_is_refused);
    RUN_TEST(test_the_loader_is_entered_by_a_block);
    RUN_TEST(test_a_block_is_as_large_as_its_room);
    RUN_TEST(test_the_drive_identifies_itself);
    return UNITY_END();
}
