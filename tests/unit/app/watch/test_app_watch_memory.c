/* SPDX-License-Identifier: MIT */
#include "app_watch_memory.h"

#include "unity.h"

static unsigned char      one[150];
static unsigned char      other[64];
static app_watch_memory_t watch;

void setUp(void)
{
    for (int n = 0; n < 150; n++) {
        one[n] = (unsigned char)(n * 7);
    }
    for (int n = 0; n < 64; n++) {
        other[n] = 0xFFU;
    }
    app_watch_memory_reset(&watch);
    app_watch_memory_add(&watch, one, 150U);
    app_watch_memory_add(&watch, other, 64U);
}

void tearDown(void) {}

/* Three passes for the one, one for the other. */
static bool all_passes(void)
{
    bool same = true;
    for (int n = 0; n < 4; n++) {
        same = app_watch_memory_pass(&watch) && same;
    }
    return same;
}

static void test_what_stays_is_good_for_ever(void)
{
    for (int n = 0; n < 100; n++) {
        TEST_ASSERT_TRUE(all_passes());
    }
}

static void test_every_flipped_bit_is_found(void)
{
    for (int bit = 0; bit < (150 + 64) * 8; bit++) {
        unsigned char *const at = ((bit / 8) < 150) ? &one[bit / 8] : &other[(bit / 8) - 150];
        *at                     = (unsigned char)(*at ^ (1U << (bit % 8)));
        TEST_ASSERT_FALSE(all_passes());
        *at = (unsigned char)(*at ^ (1U << (bit % 8)));
        TEST_ASSERT_TRUE(all_passes());
    }
}

/* At any place of the pass, which begins anew. */
static void test_a_renewed_block_is_good_and_watched(void)
{
    for (int before = 0; before < 4; before++) {
        for (int n = 0; n < before; n++) {
            TEST_ASSERT_TRUE(app_watch_memory_pass(&watch));
        }
        one[7] = (unsigned char)(one[7] + 1U);
        app_watch_memory_renew(&watch, one);
        for (int n = 0; n < 12; n++) {
            TEST_ASSERT_TRUE(app_watch_memory_pass(&watch));
        }
        one[100]  = (unsigned char)(one[100] ^ 4U);
        bool same = true;
        for (int n = 0; n < 8; n++) {
            same = app_watch_memory_pass(&watch) && same;
        }
        TEST_ASSERT_FALSE(same);
        one[100] = (unsigned char)(one[100] ^ 4U);
        setUp();
    }
}

static void test_a_block_that_is_not_watched_renews_nothing(void)
{
    one[7] = (unsigned char)(one[7] + 1U);
    app_watch_memory_renew(&watch, &one[1]);
    TEST_ASSERT_FALSE(all_passes() && all_passes());
}

static void test_swapped_characters_are_found(void)
{
    one[3] = 28U;
    one[4] = 21U;
    TEST_ASSERT_FALSE(all_passes());
}

static void test_without_blocks_all_is_good(void)
{
    app_watch_memory_reset(&watch);
    TEST_ASSERT_TRUE(app_watch_memory_pass(&watch));
}

static void test_blocks_beyond_the_last_are_left_out(void)
{
    for (int n = 0; n < APP_WATCH_MEMORY_BLOCKS; n++) {
        app_watch_memory_add(&watch, one, 1U);
    }
    TEST_ASSERT_EQUAL_UINT16(APP_WATCH_MEMORY_BLOCKS, watch.blocks);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_stays_is_good_for_ever);
    RUN_TEST(test_every_flipped_bit_is_found);
    RUN_TEST(test_a_renewed_block_is_good_and_watched);
    RUN_TEST(test_a_block_that_is_not_watched_renews_nothing);
    RUN_TEST(test_swapped_characters_are_found);
    RUN_TEST(test_without_blocks_all_is_good);
    RUN_TEST(test_blocks_beyond_the_last_are_left_out);
    return UNITY_END();
}
