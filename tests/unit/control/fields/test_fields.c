/* SPDX-License-Identifier: MIT */
#include "fields.h"

#include <string.h>

#include "unity.h"

void setUp(void) {}

void tearDown(void) {}

typedef struct {
    uint16_t u16;
    int16_t  i16;
    uint32_t u32;
    bool     flag;
    float    x;
    float    row[3];
} all_t;

static void walk(fields_t *f, all_t *a)
{
    fields_u16(f, &a->u16);
    fields_i16(f, &a->i16);
    fields_u32(f, &a->u32);
    fields_flag(f, &a->flag);
    fields_float(f, &a->x);
    fields_floats(f, a->row, 3U);
}

#define WORDS 13U

static const all_t example = {.u16  = 0xFFFEU,
                              .i16  = -2,
                              .u32  = 0x12345678UL,
                              .flag = true,
                              .x    = -1.5f,
                              .row  = {1.0f, 2.0f, 1e-30f}};

static void write_example(uint16_t words[WORDS])
{
    all_t    a = example;
    fields_t f = fields_writer(words, WORDS);
    walk(&f, &a);
    TEST_ASSERT_TRUE(fields_complete(&f));
}

static void test_words_are_those_of_the_description(void)
{
    uint16_t words[WORDS];
    write_example(words);
    /* -1.5 is sign 1, exponent 127, mantissa 0.5; 1.0 is exponent 127. */
    const uint16_t wanted[9] = {0xFFFEU, 0xFFFEU, 0x1234U, 0x5678U, 1U, 0xBFC0U, 0U, 0x3F80U, 0U};
    TEST_ASSERT_EQUAL_HEX16_ARRAY(wanted, words, 9);
}

static void test_what_was_written_is_read(void)
{
    uint16_t words[WORDS];
    all_t    a;
    write_example(words);
    memset(&a, 0x55, sizeof a);
    a.flag     = false;
    fields_t f = fields_reader(words, WORDS);
    walk(&f, &a);

    TEST_ASSERT_TRUE(fields_complete(&f));
    TEST_ASSERT_EQUAL_HEX16(example.u16, a.u16);
    TEST_ASSERT_EQUAL_INT16(example.i16, a.i16);
    TEST_ASSERT_EQUAL_HEX32(example.u32, a.u32);
    TEST_ASSERT_TRUE(a.flag);
    TEST_ASSERT_TRUE(example.x == a.x);
    for (int n = 0; n < 3; n++) {
        TEST_ASSERT_TRUE(example.row[n] == a.row[n]);
    }
}

static void test_every_signed_number_comes_back(void)
{
    for (int32_t n = -32768; n <= 32767; n++) {
        int16_t  x    = (int16_t)n;
        int16_t  y    = 0;
        uint16_t word = 0U;
        fields_t w    = fields_writer(&word, 1U);
        fields_i16(&w, &x);
        fields_t r = fields_reader(&word, 1U);
        fields_i16(&r, &y);
        TEST_ASSERT_EQUAL_INT16(x, y);
    }
}

static void test_counting_needs_no_words(void)
{
    all_t    a = example;
    fields_t f = fields_writer(NULL, 0U);
    walk(&f, &a);

    TEST_ASSERT_TRUE(f.ok);
    TEST_ASSERT_EQUAL_UINT32(WORDS, f.at);
    TEST_ASSERT_EQUAL_INT16(example.i16, a.i16);
}

static void test_a_missing_word_is_noticed_wherever_the_row_ends(void)
{
    uint16_t words[WORDS];
    write_example(words);
    for (uint32_t count = 0U; count < WORDS; count++) {
        all_t    a = example;
        fields_t r = fields_reader(words, count);
        walk(&r, &a);
        TEST_ASSERT_FALSE(r.ok);
        TEST_ASSERT_FALSE(fields_complete(&r));

        uint16_t out[WORDS + 1U];
        for (uint32_t n = 0U; n <= WORDS; n++) {
            out[n] = 0xA5A5U;
        }
        fields_t w = fields_writer(out, count);
        walk(&w, &a);
        TEST_ASSERT_FALSE(w.ok);
        TEST_ASSERT_EQUAL_HEX16(0xA5A5U, out[count]);
    }
}

static void test_words_left_over_are_noticed(void)
{
    uint16_t words[WORDS + 1U] = {0U};
    all_t    a                 = example;
    fields_t f                 = fields_reader(words, WORDS + 1U);
    walk(&f, &a);

    TEST_ASSERT_TRUE(f.ok);
    TEST_ASSERT_FALSE(fields_complete(&f));
}

static void test_a_flag_is_0_or_1(void)
{
    const uint16_t word = 2U;
    bool           flag = true;
    fields_t       f    = fields_reader(&word, 1U);
    fields_flag(&f, &flag);

    TEST_ASSERT_FALSE(f.ok);
    TEST_ASSERT_FALSE(flag);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_words_are_those_of_the_description);
    RUN_TEST(test_what_was_written_is_read);
    RUN_TEST(test_every_signed_number_comes_back);
    RUN_TEST(test_counting_needs_no_words);
    RUN_TEST(test_a_missing_word_is_noticed_wherever_the_row_ends);
    RUN_TEST(test_words_left_over_are_noticed);
    RUN_TEST(test_a_flag_is_0_or_1);
    return UNITY_END();
}
