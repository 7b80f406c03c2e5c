/* SPDX-License-Identifier: MIT */
#include "store.h"

#include "crc32.h"
#include "fake_board.h"
#include "unity.h"

#define COUNT 20U

void setUp(void)
{
    fake_board_reset();
    fake_board_erase_store();
}

void tearDown(void) {}

/* Content number n: words that no other has. */
static uint16_t word_of(uint16_t n, uint32_t k)
{
    return (uint16_t)((1000U * n) + k);
}

static bool write_content(uint16_t n, uint32_t count)
{
    store_write_t w;
    if (!store_begin(&w, STORE_IMAGE, count)) {
        return false;
    }
    for (uint32_t k = 0U; k < count; k++) {
        const uint16_t word = word_of(n, k);
        if (!store_put(&w, k, &word, 1U)) {
            return false;
        }
    }
    return store_commit(&w);
}

/* Number of the content that is there, whole; 0: none. Fails when it is not whole. */
static uint16_t content(void)
{
    const store_content_t c = store_newest(STORE_IMAGE);
    if (c.words == NULL) {
        return 0U;
    }
    const uint16_t n = (uint16_t)(c.words[0] / 1000U);
    for (uint32_t k = 0U; k < c.count; k++) {
        TEST_ASSERT_EQUAL_UINT16(word_of(n, k), c.words[k]);
    }
    return n;
}

static void test_crc_is_the_usual_one(void)
{
    /* "12345678" gives 9AE0DAAF (zlib). */
    const uint16_t words[4] = {0x3132U, 0x3334U, 0x3536U, 0x3738U};
    TEST_ASSERT_EQUAL_HEX32(0x9AE0DAAFUL, crc32_words(CRC32_START, words, 4U));
    TEST_ASSERT_EQUAL_HEX32(0x9AE0DAAFUL,
                            crc32_words(crc32_words(CRC32_START, words, 1U), &words[1], 3U));
}

static void test_erased_store_holds_nothing(void)
{
    TEST_ASSERT_TRUE(store_newest(STORE_IMAGE).words == NULL);
    TEST_ASSERT_EQUAL_UINT32(BOARD_STORE_WORDS - STORE_HEAD_WORDS, store_room());
}

static void test_the_newest_of_many_is_there_and_slots_take_turns(void)
{
    const uint16_t *before = NULL;
    for (uint16_t n = 1U; n <= 6U; n++) {
        TEST_ASSERT_TRUE(write_content(n, COUNT));
        const store_content_t c = store_newest(STORE_IMAGE);
        TEST_ASSERT_EQUAL_UINT16(n, content());
        TEST_ASSERT_EQUAL_UINT32(n, c.number);
        TEST_ASSERT_EQUAL_UINT32(COUNT, c.count);
        TEST_ASSERT_TRUE(c.words != before);
        before = c.words;
    }
}

/* Writes content `n` under a sequence number of the test's choice. */
static void write_numbered(uint16_t n, uint32_t number)
{
    store_write_t w;
    TEST_ASSERT_TRUE(store_begin(&w, STORE_IMAGE, COUNT));
    w.number = number;
    for (uint32_t k = 0U; k < COUNT; k++) {
        const uint16_t word = word_of(n, k);
        TEST_ASSERT_TRUE(store_put(&w, k, &word, 1U));
    }
    TEST_ASSERT_TRUE(store_commit(&w));
}

static void test_the_newest_counts_from_every_number_on(void)
{
    const uint32_t starts[] = {1UL,          2UL,          0x7FFFFFFEUL, 0x7FFFFFFFUL,
                               0x80000000UL, 0x80000001UL, 0xFFFFFFFCUL, 0xFFFFFFFDUL,
                               0xFFFFFFFEUL, 0xFFFFFFFFUL};

    for (size_t i = 0U; i < (sizeof starts / sizeof starts[0]); i++) {
        fake_board_erase_store();
        write_numbered(1U, starts[i]);
        uint32_t number = starts[i];
        for (uint16_t n = 2U; n <= 6U; n++) {
            number = (number == 0xFFFFFFFFUL) ? 1UL : (number + 1UL);
            TEST_ASSERT_TRUE(write_content(n, COUNT));
            TEST_ASSERT_EQUAL_UINT16(n, content());
            TEST_ASSERT_EQUAL_UINT32(number, store_newest(STORE_IMAGE).number);
        }
    }
}

static void test_of_two_equal_numbers_the_first_slot_counts(void)
{
    write_numbered(1U, 7UL);
    write_numbered(2U, 7UL);
    TEST_ASSERT_EQUAL_UINT16(1U, content());
}

/* Each word where something ends or begins, some of those that are only erased. */
static int next_cut(int budget)
{
    const int slot = (int)BOARD_STORE_WORDS;
    const int near = 40;
    const int into = budget % slot;
    if ((into < near) || (into >= (slot - near))) {
        return budget + 1;
    }
    return ((into + 1001) < (slot - near)) ? (budget + 1001) : (budget - into + slot - near);
}

/* The board's words are changed one by one; the power fails at each of them in turn. */
static void cut_everywhere(uint16_t before, bool (*change)(void), uint16_t after)
{
    bool done = false;
    for (int budget = 0; !done; budget = next_cut(budget)) {
        fake_board_reset();
        fake_board_erase_store();
        for (uint16_t n = 1U; n <= before; n++) {
            TEST_ASSERT_TRUE(write_content(n, COUNT));
        }
        fake_board.store_budget = budget;
        done                    = change();
        fake_board.store_budget = -1;
        const uint16_t left     = content();
        TEST_ASSERT_TRUE_MESSAGE((left == before) || (left == after), "neither old nor new");
        if (done) {
            TEST_ASSERT_EQUAL_UINT16(after, left);
        }
        /* whatever is left, the next writing is good */
        TEST_ASSERT_TRUE(write_content(9U, COUNT));
        TEST_ASSERT_EQUAL_UINT16(9U, content());
    }
}

static bool third(void)
{
    return write_content(3U, COUNT);
}

static bool second(void)
{
    return write_content(2U, COUNT);
}

static bool forget(void)
{
    return store_forget(STORE_IMAGE);
}

static void test_a_power_cut_at_any_word_leaves_old_or_new(void)
{
    cut_everywhere(2U, third, 3U);
    cut_everywhere(1U, second, 2U);
}

static void test_a_power_cut_while_forgetting_leaves_the_newest_or_nothing(void)
{
    cut_everywhere(2U, forget, 0U);
    cut_everywhere(1U, forget, 0U);
}

static void test_every_flipped_bit_is_noticed(void)
{
    TEST_ASSERT_TRUE(write_content(1U, COUNT));
    const uint16_t *const words = store_newest(STORE_IMAGE).words;
    uint16_t *const       head  = &fake_board_store[0][0];
    TEST_ASSERT_TRUE(words == &head[STORE_HEAD_WORDS]);
    for (uint32_t n = 0U; n < (STORE_HEAD_WORDS + COUNT); n++) {
        for (uint16_t bit = 0U; bit < 16U; bit++) {
            head[n] = (uint16_t)(head[n] ^ (1U << bit));
            TEST_ASSERT_TRUE(store_newest(STORE_IMAGE).words == NULL);
            head[n] = (uint16_t)(head[n] ^ (1U << bit));
        }
    }
    TEST_ASSERT_EQUAL_UINT16(1U, content());
}

static void test_what_does_not_fit_is_refused(void)
{
    store_write_t  w;
    const uint16_t two[2]   = {1U, 2U};
    const uint16_t other[2] = {3U, 4U};
    TEST_ASSERT_FALSE(store_begin(&w, STORE_IMAGE, store_room() + 1U));
    TEST_ASSERT_TRUE(store_begin(&w, STORE_IMAGE, store_room()));
    TEST_ASSERT_FALSE(store_put(&w, store_room() - 1U, two, 2U));
    TEST_ASSERT_FALSE(store_put(&w, store_room() + 1U, two, 1U));
    TEST_ASSERT_TRUE(store_put(&w, store_room() - 2U, two, 2U));
    TEST_ASSERT_FALSE(store_put(&w, store_room() - 2U, other, 2U)); /* written already */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_crc_is_the_usual_one);
    RUN_TEST(test_erased_store_holds_nothing);
    RUN_TEST(test_the_newest_of_many_is_there_and_slots_take_turns);
    RUN_TEST(test_the_newest_counts_from_every_number_on);
    RUN_TEST(test_of_two_equal_numbers_the_first_slot_counts);
    RUN_TEST(test_a_power_cut_at_any_word_leaves_old_or_new);
    RUN_TEST(test_a_power_cut_while_forgetting_leaves_the_newest_or_nothing);
    RUN_TEST(test_every_flipped_bit_is_noticed);
    RUN_TEST(test_what_does_not_fit_is_refused);
    return UNITY_END();
}
