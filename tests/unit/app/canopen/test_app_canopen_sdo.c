/* SPDX-License-Identifier: MIT */
/* Requests to the SDO server, octet by octet as CiA 301 has them, and every object. */
#include "canopen_bench.h"

#include <string.h>

#include "app_canopen_objects.h"
#include "unity.h"

#define REQUEST (0x600 + BENCH_NODE)
#define ANSWER  (0x580 + BENCH_NODE)

void setUp(void)
{
    bench_start();
}

void tearDown(void) {}

static void ask(const int *request, const int *wanted)
{
    int answer[8];

    bench_send(REQUEST, 8, request);
    TEST_ASSERT_EQUAL_INT(8, bench_take(ANSWER, answer));
    TEST_ASSERT_EQUAL_HEX_ARRAY(wanted, answer, 8);
    TEST_ASSERT_EQUAL_INT(-1, bench_take(ANSWER, answer));
}

static void test_a_short_object_comes_in_one_frame(void)
{
    ask((const int[]){0x40, 0x00, 0x10, 0, 0, 0, 0, 0},
        (const int[]){0x43, 0x00, 0x10, 0, 0x92, 0x01, 0x02, 0x00});
    ask((const int[]){0x40, 0x17, 0x10, 0, 0, 0, 0, 0},
        (const int[]){0x4B, 0x17, 0x10, 0, 0, 0, 0, 0});
    ask((const int[]){0x40, 0x18, 0x10, 0, 0, 0, 0, 0},
        (const int[]){0x4F, 0x18, 0x10, 0, 4, 0, 0, 0});
    ask((const int[]){0x40, 0xC2, 0x60, 2, 0, 0, 0, 0},
        (const int[]){0x4F, 0xC2, 0x60, 2, 0xFD, 0, 0, 0});
    ask((const int[]){0x40, 0x00, 0x12, 1, 0, 0, 0, 0},
        (const int[]){0x43, 0x00, 0x12, 1, 0x05, 0x06, 0, 0});
}

static void test_a_text_comes_in_segments(void)
{
    ask((const int[]){0x40, 0x08, 0x10, 0, 0, 0, 0, 0},
        (const int[]){0x41, 0x08, 0x10, 0, 10, 0, 0, 0});
    ask((const int[]){0x60, 0, 0, 0, 0, 0, 0, 0},
        (const int[]){0x00, 's', 'd', 'r', 'e', '-', 'd', 'r'});
    ask((const int[]){0x70, 0, 0, 0, 0, 0, 0, 0}, (const int[]){0x19, 'i', 'v', 'e', 0, 0, 0, 0});
    ask((const int[]){0x60, 0, 0, 0, 0, 0, 0, 0}, /* none is left */
        (const int[]){0x80, 0x08, 0x10, 0, 0x01, 0x00, 0x04, 0x05});
}

static void test_a_wrong_toggle_ends_the_transfer(void)
{
    ask((const int[]){0x40, 0x08, 0x10, 0, 0, 0, 0, 0},
        (const int[]){0x41, 0x08, 0x10, 0, 10, 0, 0, 0});
    ask((const int[]){0x70, 0, 0, 0, 0, 0, 0, 0},
        (const int[]){0x80, 0x08, 0x10, 0, 0x00, 0x00, 0x03, 0x05});
    ask((const int[]){0x60, 0, 0, 0, 0, 0, 0, 0},
        (const int[]){0x80, 0x08, 0x10, 0, 0x01, 0x00, 0x04, 0x05});
}

static void test_writes_in_one_frame_and_in_segments(void)
{
    ask((const int[]){0x2B, 0x40, 0x60, 0, 0x06, 0, 0, 0},
        (const int[]){0x60, 0x40, 0x60, 0, 0, 0, 0, 0});
    TEST_ASSERT_EQUAL_HEX(6, registers.requested.objects.controlword);
    ask((const int[]){0x22, 0x40, 0x60, 0, 0x0F, 0, 0xEE, 0xEE}, /* does not say how many */
        (const int[]){0x60, 0x40, 0x60, 0, 0, 0, 0, 0});
    TEST_ASSERT_EQUAL_HEX(0x0F, registers.requested.objects.controlword);
    ask((const int[]){0x21, 0xFF, 0x60, 0, 4, 0, 0, 0},
        (const int[]){0x60, 0xFF, 0x60, 0, 0, 0, 0, 0});
    ask((const int[]){0x07, 0xE8, 0x03, 0, 0, 0, 0, 0}, /* four octets, the last */
        (const int[]){0x20, 0, 0, 0, 0, 0, 0, 0});
    TEST_ASSERT_FLOAT_WITHIN(0.01F, 100.0F / registers.rpm_per_e_radps,
                             registers.requested.objects.omega_e_radps);
}

static void test_segments_of_a_write_are_checked(void)
{
    ask((const int[]){0x21, 0xFF, 0x60, 0, 4, 0, 0, 0},
        (const int[]){0x60, 0xFF, 0x60, 0, 0, 0, 0, 0});
    ask((const int[]){0x09, 1, 2, 3, 0, 0, 0, 0}, /* three where four were announced */
        (const int[]){0x80, 0xFF, 0x60, 0, 0x10, 0x00, 0x07, 0x06});
    ask((const int[]){0x21, 0xFF, 0x60, 0, 17, 0, 0, 0}, /* more than any object */
        (const int[]){0x80, 0xFF, 0x60, 0, 0x10, 0x00, 0x07, 0x06});
    ask((const int[]){0x20, 0xFF, 0x60, 0, 0, 0, 0, 0},
        (const int[]){0x60, 0xFF, 0x60, 0, 0, 0, 0, 0});
    ask((const int[]){0x00, 1, 2, 3, 4, 5, 6, 7}, (const int[]){0x20, 0, 0, 0, 0, 0, 0, 0});
    ask((const int[]){0x10, 1, 2, 3, 4, 5, 6, 7}, (const int[]){0x30, 0, 0, 0, 0, 0, 0, 0});
    ask((const int[]){0x00, 1, 2, 3, 4, 5, 6, 7},
        (const int[]){0x80, 0xFF, 0x60, 0, 0x10, 0x00, 0x07, 0x06});
    TEST_ASSERT_EQUAL_FLOAT(0.0F, registers.requested.objects.omega_e_radps);
}

static void test_refusals_say_why(void)
{
    uint32_t value = 0;

    TEST_ASSERT_EQUAL_INT(-1, bench_read(0x1234, 0, &value));
    TEST_ASSERT_EQUAL_HEX32(0x06020000, value);
    TEST_ASSERT_EQUAL_INT(-1, bench_read(0x6040, 1, &value));
    TEST_ASSERT_EQUAL_HEX32(0x06090011, value);
    TEST_ASSERT_EQUAL_HEX32(0x06010002, bench_write(0x6041, 0, 0, 2));
    TEST_ASSERT_EQUAL_HEX32(0x06010002, bench_write(0x1000, 0, 0, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06010002, bench_write(0x1001, 0, 0, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06010002, bench_write(0x1008, 0, 0, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06070010, bench_write(0x6040, 0, 6, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x6060, 0, 100, 1));
    TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x6067, 0, 65536, 4));
    TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x60C2, 2, 0xFE, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x60C2, 2, 0xFD, 1));
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x60C2, 1, 20, 1));
    TEST_ASSERT_FLOAT_WITHIN(1e-6F, 0.02F, registers.requested.objects.interpolation_s);
    TEST_ASSERT_EQUAL_HEX32(0x06090030, bench_write(0x2121, 0, 800, 2)); /* CAN_RATE */
    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x2121, 0, 250, 2));
    registers.status.gate_enable = true;
    TEST_ASSERT_EQUAL_HEX32(0x08000022, bench_write(0x2042, 0, 9600, 4)); /* BAUD_RATE */
    ask((const int[]){0xA0, 0x08, 0x10, 0, 0, 0, 0, 0},                   /* a block transfer */
        (const int[]){0x80, 0x08, 0x10, 0, 0x01, 0x00, 0x04, 0x05});
}

static void test_a_mode_of_one_octet_keeps_its_sign(void)
{
    uint32_t value = 0;

    TEST_ASSERT_EQUAL_HEX32(0, bench_write(0x6060, 0, 0xFF, 1));
    TEST_ASSERT_EQUAL_INT(-1, registers.requested.objects.mode_of_operation);
    TEST_ASSERT_EQUAL_INT(1, bench_read(0x6060, 0, &value));
    TEST_ASSERT_EQUAL_HEX32(0xFF, value);
}

static void test_short_frames_and_aborts_have_no_answer(void)
{
    const int request[] = {0x40, 0x00, 0x10, 0, 0, 0, 0, 0};
    const int stop[]    = {0x80, 0x08, 0x10, 0, 0, 0, 0, 0};

    bench_send(REQUEST, 7, request);
    bench_send(REQUEST, 8, stop);
    bench_run_ms(10.0);
    TEST_ASSERT_EQUAL_INT(0, bench_count(ANSWER));
}

/* Every index and the first sub-indices: an object answers with its value, and everything else with an abort. */
static void test_every_register_answers_with_the_value_that_modbus_has(void)
{
    int found = 0;

    for (int index = 0x2000; index < 0x3000; index++) {
        const bool input = index >= 0x2800;
        uint32_t   value = 0;
        const int  count = bench_read(index, 0, &value);
        uint16_t   words[2];

        if (count > 0) {
            const uint16_t first = (uint16_t)(index - (input ? 0x2800 : 0x2000));
            const uint16_t n     = (uint16_t)(count / 2);

            TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                                  input ? app_registers_read_input(&registers, first, n, words)
                                        : app_registers_read_holding(&registers, first, n, words));
            const uint32_t wanted = (n == 2U) ? (((uint32_t)words[0] << 16) | words[1]) : words[0];
            TEST_ASSERT_EQUAL_HEX32(wanted, value);
            found++;
        } else {
            TEST_ASSERT_EQUAL_HEX32(0x06020000, value);
        }
    }
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_MAP_HOLDING + APP_REGISTERS_MAP_INPUT, found);
}

static void test_every_standard_object_has_the_value_of_its_register(void)
{
    for (uint16_t k = 0; k < APP_CANOPEN_OBJECTS; k++) {
        const app_canopen_object_t *o     = &app_canopen_map[k];
        uint32_t                    value = 0;
        uint32_t                    other = o->value;

        TEST_ASSERT_EQUAL_INT(o->octets, bench_read(o->index, o->sub, &value));
        if (o->entry != NULL) {
            const bool input = (o->entry >= app_registers_map_input) &&
                               (o->entry < app_registers_map_input + APP_REGISTERS_MAP_INPUT);
            TEST_ASSERT_EQUAL_INT(!o->writable, input);
            TEST_ASSERT_TRUE(bench_read((input ? 0x2800 : 0x2000) + o->entry->address, 0, &other) >
                             0);
        }
        const uint32_t mask =
            (o->octets < 4U) ? ((uint32_t)((uint32_t)1U << (8U * o->octets)) - 1U) : 0xFFFFFFFFU;
        TEST_ASSERT_EQUAL_HEX32(other & mask, value);
        if (k > 0) {
            const app_canopen_object_t *b = o - 1;
            TEST_ASSERT_TRUE((b->index < o->index) ||
                             ((b->index == o->index) && (b->sub < o->sub)));
        }
    }
}

static void test_any_request_has_one_answer(void)
{
    uint32_t seed = 1;

    for (int n = 0; n < 200000; n++) {
        int request[8];

        for (int k = 0; k < 8; k++) {
            seed       = (seed * 1664525U) + 1013904223U;
            request[k] = (int)(seed >> 24);
        }
        if ((n % 3) == 0) { /* near real objects */
            request[1] &= 0x07;
            request[2] = ((n % 2) == 0) ? 0x10 : 0x14 + (request[2] & 0x0F);
            request[3] &= 0x07;
        }
        node.watched = 0;
        bench_send(REQUEST, 8, request);
        TEST_ASSERT_EQUAL_INT(((request[0] >> 5) == 4) ? 0 : 1, bench_count(ANSWER));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_short_object_comes_in_one_frame);
    RUN_TEST(test_a_text_comes_in_segments);
    RUN_TEST(test_a_wrong_toggle_ends_the_transfer);
    RUN_TEST(test_writes_in_one_frame_and_in_segments);
    RUN_TEST(test_segments_of_a_write_are_checked);
    RUN_TEST(test_refusals_say_why);
    RUN_TEST(test_a_mode_of_one_octet_keeps_its_sign);
    RUN_TEST(test_short_frames_and_aborts_have_no_answer);
    RUN_TEST(test_every_register_answers_with_the_value_that_modbus_has);
    RUN_TEST(test_every_standard_object_has_the_value_of_its_register);
    RUN_TEST(test_any_request_has_one_answer);
    return UNITY_END();
}
