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

/* A power cut between the new mark and the end of the old one leaves two. A number counts as newer up to half the
 * range ahead. */
static void test_of_two_in_force_the_one_ahead_counts(void)
{
    const uint32_t starts[] = {1UL, 0x7FFFFFFFUL, 0x80000000UL, 0xC0000000UL, 0xFFFFFFFFUL};
    const uint32_t ahead[]  = {1UL, 2UL, 0x7FFFFFFFUL, 0x80000000UL, 0x80000001UL, 0xFFFFFFFFUL};

    for (size_t i = 0U; i < (sizeof starts / sizeof starts[0]); i++) {
        for (size_t k = 0U; k < (sizeof ahead / sizeof ahead[0]); k++) {
            fake_board_erase_store();
            write_numbered(1U, starts[i]);
            write_numbered(2U, starts[i] + ahead[k]);
            fake_board_store[0][0] = STORE_MARK;
            TEST_ASSERT_EQUAL_UINT16((ahead[k] < 0x80000000UL) ? 2U : 1U, content());
        }
    }
}

static void test_of_two_equal_numbers_the_first_slot_counts(void)
{
    write_numbered(1U, 7UL);
    write_numbered(2U, 7UL);
    TEST_ASSERT_EQUAL_UINT16(2U, content()); /* it has replaced the first */
    fake_board_store[0][0] = STORE_MARK;
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
        TEST_ASSERT_FALSE_MESSAGE(store_newest(STORE_IMAGE).lost, "lost by a power cut");
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

/* Flips one bit: the content is the same, or lost. */
static bool flip_is_told(uint16_t slot, uint32_t n, uint16_t bit, const store_content_t *before)
{
    uint16_t *const word = &fake_board_store[slot][n];

    *word                       = (uint16_t)(*word ^ (1U << bit));
    const store_content_t after = store_newest(STORE_IMAGE);
    *word                       = (uint16_t)(*word ^ (1U << bit));
    if (!after.lost) {
        TEST_ASSERT_TRUE((after.words == before->words) && (after.count == before->count) &&
                         (after.number == before->number));
    }
    return after.lost;
}

/* Flips every bit of the first words of each slot. @return how many lose the content. */
static int flip_first(uint32_t words)
{
    const store_content_t before = store_newest(STORE_IMAGE);
    int                   lost   = 0;

    TEST_ASSERT_FALSE(before.lost);
    for (uint16_t slot = 0U; slot < BOARD_STORE_SLOTS; slot++) {
        for (uint32_t n = 0U; n < words; n++) {
            for (uint16_t bit = 0U; bit < 16U; bit++) {
                lost += flip_is_told(slot, n, bit, &before) ? 1 : 0;
            }
        }
    }
    return lost;
}

static int flip_everywhere(void)
{
    return flip_first(STORE_HEAD_WORDS + COUNT + 2U);
}

/* All bits of head and content but those of the mark. */
#define SUMMED_BITS(count) (16 * ((int)STORE_HEAD_WORDS - 1 + (int)(count)))

static void test_no_flipped_bit_of_the_whole_store_changes_the_content(void)
{
    TEST_ASSERT_EQUAL_INT(0, flip_everywhere()); /* never loaded */
    for (uint16_t n = 1U; n <= 3U; n++) {
        TEST_ASSERT_TRUE(write_content(n, COUNT));
        TEST_ASSERT_EQUAL_INT(SUMMED_BITS(COUNT), flip_everywhere());
    }
    TEST_ASSERT_EQUAL_INT(SUMMED_BITS(COUNT), flip_first(BOARD_STORE_WORDS));
    TEST_ASSERT_TRUE(store_forget(STORE_IMAGE));
    TEST_ASSERT_EQUAL_INT(SUMMED_BITS(0), flip_everywhere());
}

static void test_no_flipped_bit_after_a_power_cut_changes_the_content(void)
{
    const int ends[] = {1, (int)BOARD_STORE_WORDS, (int)BOARD_STORE_WORDS + 10,
                        (int)BOARD_STORE_WORDS + 27};

    for (size_t i = 0U; i < (sizeof ends / sizeof ends[0]); i++) {
        fake_board_erase_store();
        TEST_ASSERT_TRUE(write_content(1U, COUNT));
        TEST_ASSERT_TRUE(write_content(2U, COUNT));
        fake_board.store_budget = ends[i];
        TEST_ASSERT_FALSE(write_content(3U, COUNT));
        fake_board.store_budget = -1;
        TEST_ASSERT_EQUAL_UINT16(2U, content());
        TEST_ASSERT_EQUAL_INT(SUMMED_BITS(COUNT), flip_everywhere());
    }
    /* complete, and not yet taken from the one before */
    fake_board_erase_store();
    TEST_ASSERT_TRUE(write_content(1U, COUNT));
    TEST_ASSERT_TRUE(write_content(2U, COUNT));
    fake_board_store[0][0] = STORE_MARK;
    TEST_ASSERT_EQUAL_UINT16(2U, content());
    TEST_ASSERT_EQUAL_INT(2 * SUMMED_BITS(COUNT), flip_everywhere());
}

/* The newest content is lost: what is left, and what a new one or none makes of it. */
static void assert_lost(uint16_t left)
{
    const store_content_t c = store_newest(STORE_IMAGE);

    TEST_ASSERT_TRUE(c.lost);
    TEST_ASSERT_EQUAL_UINT16(left, content());
}

static void test_a_lost_sector_is_told_until_something_is_written(void)
{
    for (int how = 0; how < 4; how++) {
        for (uint16_t writes = 1U; writes <= 4U; writes++) {
            fake_board_erase_store();
            for (uint16_t n = 1U; n <= writes; n++) {
                TEST_ASSERT_TRUE(write_content(n, COUNT));
            }
            uint16_t *const newest = fake_board_store[(writes - 1U) % 2U];
            if (how == 3) {
                for (uint32_t n = 0U; n < BOARD_STORE_WORDS; n++) {
                    newest[n] = 0xFFFFU; /* erased by a tool */
                }
            } else {
                newest[STORE_HEAD_WORDS + 3U] ^= 0x0101U;
            }
            if ((how == 3) && (writes == 1U)) {
                TEST_ASSERT_FALSE(
                    store_newest(STORE_IMAGE).lost); /* as if nothing had been stored */
                continue;
            }
            assert_lost((uint16_t)(writes - 1U));
            if (how == 0) {
                TEST_ASSERT_TRUE(write_content(7U, COUNT));
                TEST_ASSERT_EQUAL_UINT16(7U, content());
                TEST_ASSERT_EQUAL_UINT32(writes, store_writes(STORE_IMAGE));
            } else if (how == 1) {
                TEST_ASSERT_TRUE(store_forget(STORE_IMAGE));
                TEST_ASSERT_EQUAL_UINT16(0U, content());
            } else {
                const store_content_t c = store_newest(STORE_IMAGE);
                TEST_ASSERT_TRUE(store_write(STORE_IMAGE, c.words, c.count));
                TEST_ASSERT_EQUAL_UINT16(writes - 1U, content());
            }
            TEST_ASSERT_FALSE(store_newest(STORE_IMAGE).lost);
        }
    }
}

static void test_both_sectors_damaged_is_told(void)
{
    for (int begin = 0; begin < 2; begin++) {
        fake_board_erase_store();
        TEST_ASSERT_TRUE(write_content(1U, COUNT));
        TEST_ASSERT_TRUE(write_content(2U, COUNT));
        fake_board_store[0][STORE_HEAD_WORDS] ^= 1U;
        fake_board_store[1][STORE_HEAD_WORDS] ^= 1U;
        assert_lost(0U);
        if (begin == 1) { /* the first slot, and then the damaged one counts no more */
            TEST_ASSERT_TRUE(write_content(3U, COUNT));
        } else {
            TEST_ASSERT_TRUE(store_forget(STORE_IMAGE));
        }
        TEST_ASSERT_FALSE(store_newest(STORE_IMAGE).lost);
    }
}

static void test_nothing_is_written_to_forget_nothing(void)
{
    fake_board.store_budget = 0;
    TEST_ASSERT_TRUE(store_forget(STORE_IMAGE));
    fake_board.store_budget = -1;
    TEST_ASSERT_TRUE(write_content(1U, COUNT));
    TEST_ASSERT_TRUE(store_forget(STORE_IMAGE));
    TEST_ASSERT_EQUAL_UINT32(2U, store_writes(STORE_IMAGE));
    TEST_ASSERT_TRUE(store_forget(STORE_IMAGE));
    TEST_ASSERT_EQUAL_UINT32(2U, store_writes(STORE_IMAGE));
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
    RUN_TEST(test_of_two_in_force_the_one_ahead_counts);
    RUN_TEST(test_of_two_equal_numbers_the_first_slot_counts);
    RUN_TEST(test_a_power_cut_at_any_word_leaves_old_or_new);
    RUN_TEST(test_a_power_cut_while_forgetting_leaves_the_newest_or_nothing);
    RUN_TEST(test_no_flipped_bit_of_the_whole_store_changes_the_content);
    RUN_TEST(test_no_flipped_bit_after_a_power_cut_changes_the_content);
    RUN_TEST(test_a_lost_sector_is_told_until_something_is_written);
    RUN_TEST(test_both_sectors_damaged_is_told);
    RUN_TEST(test_nothing_is_written_to_forget_nothing);
    RUN_TEST(test_what_does_not_fit_is_refused);
    return UNITY_END();
}
