/* SPDX-License-Identifier: MIT */
/* The store on a flash of 64-bit words with an error-correcting code: four words at once, once. */
#include <stddef.h>
#include <string.h>

#include "board.h"
#include "store.h"
#include "unity.h"

#define ERASED 0xFFFFU
#define WORDS  11U /* no whole number of grains */
#define KINDS  2

static uint16_t flash[BOARD_STORE_SLOTS][BOARD_STORE_WORDS];
static bool     written[BOARD_STORE_SLOTS][BOARD_STORE_WORDS / BOARD_STORE_GRAIN];
static int      steps_left; /* erasures and grains until the power is cut; negative: never */
static int      misuses;

static bool step(void)
{
    const bool powered = steps_left != 0;

    steps_left -= (steps_left > 0) ? 1 : 0;
    return powered;
}

const uint16_t *board_store(uint16_t slot)
{
    return (slot < BOARD_STORE_SLOTS) ? flash[slot] : NULL;
}

bool board_store_erase(uint16_t slot)
{
    const bool powered = step();

    if (powered) {
        memset(flash[slot], 0xFF, sizeof flash[slot]);
        memset(written[slot], 0, sizeof written[slot]);
    }
    return powered;
}

bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count)
{
    bool powered = true;

    misuses += ((offset % BOARD_STORE_GRAIN) != 0U) ? 1 : 0;
    for (uint32_t n = 0U; powered && (n < count); n += BOARD_STORE_GRAIN) {
        bool *const grain = &written[slot][(offset + n) / BOARD_STORE_GRAIN];

        powered = step();
        if (powered) {
            misuses += *grain ? 1 : 0;
            *grain = true;
            for (uint32_t k = n; (k < count) && (k < (n + BOARD_STORE_GRAIN)); k++) {
                flash[slot][offset + k] = words[k];
            }
        }
    }
    return powered;
}

void setUp(void)
{
    memset(flash, 0xFF, sizeof flash);
    memset(written, 0, sizeof written);
    steps_left = -1;
    misuses    = 0;
}

void tearDown(void)
{
    TEST_ASSERT_EQUAL_INT(0, misuses);
}

static void content(uint16_t *words, uint16_t first)
{
    for (uint16_t n = 0U; n < WORDS; n++) {
        words[n] = (uint16_t)(first + n);
    }
}

static bool write(store_kind_t kind, uint16_t first)
{
    uint16_t words[WORDS];

    content(words, first);
    return store_write(kind, words, WORDS);
}

static void expect(store_kind_t kind, uint16_t first)
{
    uint16_t              words[WORDS];
    const store_content_t found = store_newest(kind);

    content(words, first);
    TEST_ASSERT_NOT_NULL(found.words);
    TEST_ASSERT_FALSE(found.lost);
    TEST_ASSERT_EQUAL_UINT32(WORDS, found.count);
    TEST_ASSERT_EQUAL_UINT16_ARRAY(words, found.words, WORDS);
}

static void test_contents_follow_each_other(void)
{
    for (uint16_t n = 1U; n < 8U; n++) {
        TEST_ASSERT_TRUE(write(STORE_IMAGE, (uint16_t)(100U * n)));
        TEST_ASSERT_TRUE(write(STORE_PARAMETERS, (uint16_t)(7000U + n)));
        expect(STORE_IMAGE, (uint16_t)(100U * n));
        expect(STORE_PARAMETERS, (uint16_t)(7000U + n));
    }
    TEST_ASSERT_TRUE(store_forget(STORE_IMAGE));
    TEST_ASSERT_NULL(store_newest(STORE_IMAGE).words);
    TEST_ASSERT_FALSE(store_newest(STORE_IMAGE).lost);
}

/* A master sends pieces of any length. */
static void test_pieces_need_no_grains(void)
{
    enum { LONG = 103 };
    uint16_t words[LONG];

    for (uint16_t n = 0U; n < LONG; n++) {
        words[n] = (uint16_t)(n * n);
    }
    for (uint16_t piece = 1U; piece <= LONG; piece++) {
        store_write_t w;

        TEST_ASSERT_TRUE(store_begin(&w, STORE_IMAGE, LONG));
        for (uint16_t at = 0U; at < LONG; at = (uint16_t)(at + piece)) {
            const uint16_t left = (uint16_t)(LONG - at);

            TEST_ASSERT_TRUE(store_put(&w, at, &words[at], (left < piece) ? left : piece));
        }
        TEST_ASSERT_EQUAL_UINT16_ARRAY(words, store_written(&w).words, LONG);
        TEST_ASSERT_TRUE(store_commit(&w));
        TEST_ASSERT_EQUAL_UINT16_ARRAY(words, store_newest(STORE_IMAGE).words, LONG);
    }
}

/* Each power cut leaves the content before or the new one, and loses none; the next write works. */
static void test_no_power_cut_loses_a_content(void)
{
    bool whole = false;

    for (int cut = 0; !whole; cut++) {
        setUp();
        TEST_ASSERT_TRUE(write(STORE_IMAGE, 100U));
        TEST_ASSERT_TRUE(write(STORE_IMAGE, 200U));
        steps_left = cut;
        whole      = write(STORE_IMAGE, 300U) && (steps_left > 0);
        steps_left = -1;

        const uint16_t found = store_newest(STORE_IMAGE).words[0];
        TEST_ASSERT_TRUE((found == 200U) || (found == 300U));
        expect(STORE_IMAGE, found);
        TEST_ASSERT_TRUE(write(STORE_IMAGE, 400U));
        expect(STORE_IMAGE, 400U);
    }
}

/* A content that is damaged is lost, and the one before it is what remains. */
static void test_damage_is_found(void)
{
    TEST_ASSERT_TRUE(write(STORE_IMAGE, 100U));
    TEST_ASSERT_TRUE(write(STORE_IMAGE, 200U));
    flash[1][STORE_HEAD_WORDS + 2U] ^= 0x0010U;

    const store_content_t found = store_newest(STORE_IMAGE);
    TEST_ASSERT_TRUE(found.lost);
    TEST_ASSERT_EQUAL_UINT16(100U, found.words[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_contents_follow_each_other);
    RUN_TEST(test_pieces_need_no_grains);
    RUN_TEST(test_no_power_cut_loses_a_content);
    RUN_TEST(test_damage_is_found);
    return UNITY_END();
}
