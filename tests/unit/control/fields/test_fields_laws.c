/* SPDX-License-Identifier: MIT */
/* The walks over the constants of the laws: words come back, and every number is told with a name. */
#include "fields.h"

#include <string.h>

#include "laws.h"
#include "unity.h"

#define MOST_WORDS ((uint32_t)sizeof(law_constants_t)) /* more than enough */

typedef union {
    law_constants_t of;
    float           numbers[sizeof(law_constants_t) / sizeof(float)];
} constants_t;

static const law_t *const laws[] = {&law_noc,  &law_noc_speed, &law_noc_h,  &law_conventional,
                                    &law_dobc, &law_pid,       &law_pi_foc, &law_ladrc};

#define LAWS ((int)(sizeof laws / sizeof laws[0]))

static constants_t first;
static constants_t second;
static uint16_t    words[MOST_WORDS];
static uint16_t    again[MOST_WORDS];
static uint32_t    numbers;
static int         depth;

void setUp(void)
{
    (void)memset(&first, 0, sizeof first);
    (void)memset(&second, 0, sizeof second);
    numbers = 0U;
    depth   = 0;
}

void tearDown(void) {}

static uint32_t count_of(const law_t *law)
{
    fields_t f = fields_writer(NULL, 0U);

    law->fields(&f, &first);
    return f.at;
}

static void test_words_of_every_law_come_back(void)
{
    for (int i = 0; i < LAWS; i++) {
        const uint32_t count = count_of(laws[i]);
        fields_t       read;
        fields_t       write;

        setUp();
        TEST_ASSERT_TRUE((count > 0U) && (count <= MOST_WORDS));
        for (uint32_t n = 0U; n < count; n++) { /* a flag takes 0 and 1 only */
            words[n] = (uint16_t)(n & 1U);
        }
        read = fields_reader(words, count);
        laws[i]->fields(&read, &second);
        write = fields_writer(again, count);
        laws[i]->fields(&write, &second);
        TEST_ASSERT_TRUE(fields_complete(&write));
        TEST_ASSERT_TRUE(fields_complete(&read));
        TEST_ASSERT_EQUAL_HEX16_ARRAY(words, again, count);
    }
}

static void test_a_word_less_is_noticed(void)
{
    for (int i = 0; i < LAWS; i++) {
        fields_t f = fields_writer(words, count_of(laws[i]) - 1U);

        laws[i]->fields(&f, &first);
        TEST_ASSERT_FALSE(fields_complete(&f));
    }
}

static void begin(void *self, const char *name)
{
    (void)self;
    TEST_ASSERT_TRUE((name != NULL) && (name[0] != '\0'));
    depth++;
}

static void end(void *self)
{
    (void)self;
    depth--;
}

static void number(void *self, const char *name, fields_kind_t kind, const void *x)
{
    (void)self;
    (void)kind;
    TEST_ASSERT_NOT_NULL(x);
    TEST_ASSERT_TRUE((name != NULL) || (depth > 0)); /* without one, of an array */
    numbers++;
}

static void test_every_number_is_told(void)
{
    static const fields_listener_t listener = {
        .self = NULL, .begin = begin, .end = end, .number = number};

    for (int i = 0; i < LAWS; i++) {
        fields_t f = fields_told(&listener);

        setUp();
        laws[i]->fields(&f, &first);
        TEST_ASSERT_EQUAL_INT(0, depth);
        TEST_ASSERT_TRUE((numbers > 0U) && (numbers <= f.at) && (f.at <= (2U * numbers)));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_words_of_every_law_come_back);
    RUN_TEST(test_a_word_less_is_noticed);
    RUN_TEST(test_every_number_is_told);
    return UNITY_END();
}
