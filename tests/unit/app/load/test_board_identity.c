/* SPDX-License-Identifier: MIT */
#include "board_identity.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "board_config.h"
#include "crc32.h"
#include "unity.h"

#define FACTS ((uint16_t)BOARD_FACT_COUNT)

static board_identity_t image;
static board_identity_t board;

void setUp(void)
{
    image = board_identity;
    board = board_identity;
}

void tearDown(void) {}

static void test_one_identity_is_its_own(void)
{
    const board_difference_t d = board_identity_compare(&image, &board);

    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, d.field);
    TEST_ASSERT_EQUAL_STRING("", board_field_name(d.field));
}

/* The values of a changed fact; nextafterf() is the smallest change. */
static float changed(float x, int way)
{
    const float to[] = {nextafterf(x, INFINITY), nextafterf(x, -INFINITY), (2.0f * x) + 1.0f, NAN,
                        INFINITY};
    return to[way];
}

static void test_each_changed_fact_of_either_side_is_named(void)
{
    for (uint16_t n = 0U; n < FACTS; n++) {
        for (int way = 0; way < 5; way++) {
            setUp();
            image.fact[n]        = changed(image.fact[n], way);
            board_difference_t d = board_identity_compare(&image, &board);
            TEST_ASSERT_EQUAL_UINT16(n + 1U, d.field);
            TEST_ASSERT_EQUAL_MEMORY(&image.fact[n], &d.image, sizeof d.image);
            TEST_ASSERT_TRUE(d.board == board.fact[n]);

            setUp();
            board.fact[n] = changed(board.fact[n], way);
            board.sum     = board_identity_sum(&board);
            d             = board_identity_compare(&image, &board);
            TEST_ASSERT_EQUAL_UINT16(n + 1U, d.field);
        }
    }
}

static void test_each_character_of_the_name_counts_and_facts_go_first(void)
{
    for (size_t n = 0; n < (size_t)(2U * BOARD_NAME_WORDS); n++) {
        setUp();
        image.name[n] = (char)(image.name[n] ^ 1);
        TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NAME, board_identity_compare(&image, &board).field);
        image.fact[FACTS - 1U] += 1.0f;
        TEST_ASSERT_EQUAL_UINT16(FACTS, board_identity_compare(&image, &board).field);
    }
}

/* Every bit of the firmware's own identity, the sum included. */
static void test_a_flipped_bit_of_the_board_is_a_wrong_sum(void)
{
    uint16_t *const words[]  = {(uint16_t *)(void *)board.fact, (uint16_t *)(void *)&board.sum};
    const size_t    counts[] = {2U * FACTS, 2U};

    for (size_t part = 0; part < 2U; part++) {
        for (size_t n = 0; n < 16U * counts[part]; n++) {
            const uint16_t bit = (uint16_t)(1U << (n % 16U));
            words[part][n / 16U] ^= bit;
            image = board; /* nothing else tells the difference */
            TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_SUM, board_identity_compare(&image, &board).field);
            words[part][n / 16U] ^= bit;
        }
    }
    board.name[3] = (char)(board.name[3] ^ 4);
    image         = board;
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_SUM, board_identity_compare(&image, &board).field);
}

static void test_every_field_has_a_name_of_its_own_that_fits_the_registers(void)
{
    for (uint16_t n = 1U; n < (uint16_t)BOARD_FIELD_COUNT; n++) {
        const char *const name = board_field_name(n);
        TEST_ASSERT_NOT_NULL(name);
        TEST_ASSERT_TRUE((strlen(name) > 0U) && (strlen(name) <= 24U));
        for (uint16_t k = 0U; k < n; k++) {
            TEST_ASSERT_TRUE(strcmp(name, board_field_name(k)) != 0);
        }
    }
    TEST_ASSERT_EQUAL_STRING("", board_field_name((uint16_t)BOARD_FIELD_COUNT));
    TEST_ASSERT_EQUAL_STRING("", board_field_name(0xFFFFU));
}

static void test_the_walk_visits_name_and_facts_both_ways(void)
{
    uint16_t words[BOARD_IDENTITY_WORDS];
    fields_t f = fields_writer(words, BOARD_IDENTITY_WORDS);

    board_identity_fields(&f, &image);
    TEST_ASSERT_TRUE(f.ok && (f.at == BOARD_IDENTITY_WORDS));
    TEST_ASSERT_EQUAL_HEX32(crc32_words(CRC32_START, words, BOARD_IDENTITY_WORDS), board.sum);
    memset(&board, 0xA5, sizeof board);
    f = fields_reader(words, BOARD_IDENTITY_WORDS);
    board_identity_fields(&f, &board);
    TEST_ASSERT_TRUE(fields_complete(&f));
    TEST_ASSERT_EQUAL_STRING(image.name, board.name);
    TEST_ASSERT_EQUAL_MEMORY(image.fact, board.fact, sizeof image.fact);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_identity_is_its_own);
    RUN_TEST(test_each_changed_fact_of_either_side_is_named);
    RUN_TEST(test_each_character_of_the_name_counts_and_facts_go_first);
    RUN_TEST(test_a_flipped_bit_of_the_board_is_a_wrong_sum);
    RUN_TEST(test_every_field_has_a_name_of_its_own_that_fits_the_registers);
    RUN_TEST(test_the_walk_visits_name_and_facts_both_ways);
    return UNITY_END();
}
