/* SPDX-License-Identifier: MIT */
#include "drive_image.h"

#include <string.h>

#include "board_config.h"
#include "gain_tables.h"
#include "harmonic_tables.h"
#include "speed_tables.h"
#include "unity.h"

#define ROOM 8192U

#define PADDING 8U /* on a machine of 64 bits; half of an enumeration among them */

static drive_image_t image;
static drive_image_t back;
static uint16_t      words[ROOM];
static uint16_t      again[ROOM];

void setUp(void)
{
    memset(&image, 0xA5, sizeof image);
    memset(&back, 0x5A, sizeof back);
}

void tearDown(void) {}

static const drive_config_t *const drives[] = {&gain_tables_drive, &speed_tables_drive,
                                               &conventional_tables_drive, &harmonic_tables_drive};

static uint32_t written(const drive_config_t *drive)
{
    TEST_ASSERT_TRUE(drive_image_copy(&image, &board_config, drive, &board_identity));
    const uint32_t count = drive_image_write(&image, words, ROOM);
    TEST_ASSERT_GREATER_THAN_UINT32(0U, count);
    return count;
}

static void test_copy_is_what_was_compiled_in_and_points_into_itself(void)
{
    TEST_ASSERT_TRUE(drive_image_copy(&image, &board_config, &gain_tables_drive, &board_identity));

    TEST_ASSERT_TRUE(image.drive.constants == &image.constants);
    TEST_ASSERT_TRUE(image.drive.law == gain_tables_drive.law);
    TEST_ASSERT_TRUE(image.app.scale.ntc_degC == image.ntc_degC);
    TEST_ASSERT_EQUAL_MEMORY(gain_tables_drive.constants, &image.constants,
                             gain_tables_drive.law->constants_chars);
    TEST_ASSERT_EQUAL_MEMORY(board_config.scale.ntc_degC, image.ntc_degC,
                             board_config.scale.ntc_points * sizeof(float));
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&image.drive));
    TEST_ASSERT_EQUAL_STRING(board_config.drive_name, image.app.drive_name);
    TEST_ASSERT_EQUAL_STRING(board_config.digest, image.app.digest);
    TEST_ASSERT_TRUE(image.app.drive_name == image.name);
}

/* Every number counts: read back, the constants are the same words again and the same constants. */
static void test_what_was_written_is_read_for_every_law_at_hand(void)
{
    for (size_t n = 0; n < sizeof drives / sizeof drives[0]; n++) {
        const uint32_t count = written(drives[n]);

        TEST_ASSERT_EQUAL_INT(DRIVE_IMAGE_OK,
                              drive_image_read(&back, drives[n]->law, words, count));
        TEST_ASSERT_EQUAL_UINT32(count, drive_image_write(&back, again, ROOM));
        TEST_ASSERT_EQUAL_HEX16_ARRAY(words, again, count);
        TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&back.drive));
        TEST_ASSERT_TRUE(back.drive.constants == &back.constants);
        TEST_ASSERT_TRUE(back.app.scale.ntc_degC == back.ntc_degC);
    }
}

/* Padding apart, no octet of what a law reads is left out: each float of the constants is changed, and the words with it.
 * Integers are at places that floats do not take, so that a step of a float's size sees them too. */
static void test_no_constant_is_left_out(void)
{
    for (size_t n = 0; n < sizeof drives / sizeof drives[0]; n++) {
        const uint32_t count  = written(drives[n]);
        const size_t   octets = drives[n]->law->constants_chars;
        unsigned char *first  = (unsigned char *)&image.constants;
        for (size_t at = 0; at + sizeof(float) <= octets; at += sizeof(float)) {
            unsigned char      *octet = &first[at]; /* the low one: of a flag too */
            const unsigned char kept  = *octet;
            *octet                    = (unsigned char)(kept ^ 1U);
            TEST_ASSERT_EQUAL_UINT32(count, drive_image_write(&image, again, ROOM));
            TEST_ASSERT_TRUE_MESSAGE(memcmp(words, again, count * sizeof words[0]) != 0,
                                     "a constant does not reach the words");
            *octet = kept;
        }
    }
}

/* The same for application and board. Padding and the three pointers appear in no word: their size
 * on this machine is known, in units of 16 bits. One unit more is a member that fields_app.c
 * omits. */
static void test_no_constant_of_the_application_is_left_out(void)
{
    if (sizeof(void *) != 8U) {
        TEST_IGNORE_MESSAGE("the padding is counted for a machine of 64 bits");
    }
    const uint32_t count  = written(&gain_tables_drive);
    const size_t   units  = sizeof(app_config_t) / sizeof(uint16_t);
    uint16_t      *first  = (uint16_t *)(void *)&image.app;
    size_t         unseen = 0;
    for (size_t n = 0; n < units; n++) {
        const uint16_t kept = first[n];
        first[n]            = (uint16_t)(kept ^ 1U);
        (void)drive_image_write(&image, again, ROOM);
        unseen += (memcmp(words, again, count * sizeof words[0]) == 0) ? 1U : 0U;
        first[n] = kept;
    }
    const size_t pointers = 3U * sizeof(void *) / sizeof(uint16_t);
    TEST_ASSERT_EQUAL_UINT32(PADDING, unseen - pointers);
}

static void test_a_long_name_is_cut_and_none_is_empty(void)
{
    app_config_t named = board_config;
    named.drive_name   = "a name with more than two and thirty characters";
    named.digest       = NULL;
    TEST_ASSERT_TRUE(drive_image_copy(&image, &named, &gain_tables_drive, &board_identity));

    TEST_ASSERT_EQUAL_STRING("a name with more than two and th", image.app.drive_name);
    TEST_ASSERT_EQUAL_STRING("", image.app.digest);
    const uint32_t count = drive_image_write(&image, words, ROOM);
    TEST_ASSERT_EQUAL_INT(DRIVE_IMAGE_OK,
                          drive_image_read(&back, gain_tables_drive.law, words, count));
    TEST_ASSERT_EQUAL_STRING("a name with more than two and th", back.app.drive_name);
}

static void test_every_length_but_the_right_one_is_damage(void)
{
    const uint32_t count = written(&gain_tables_drive);
    for (uint32_t n = 0U; n <= count + 3U; n++) {
        const drive_image_result_t result =
            drive_image_read(&back, gain_tables_drive.law, words, n);
        TEST_ASSERT_EQUAL_INT((n == count) ? DRIVE_IMAGE_OK : DRIVE_IMAGE_DAMAGED, result);
    }
    TEST_ASSERT_EQUAL_UINT32(0U, drive_image_write(&image, words, count - 1U));
    TEST_ASSERT_EQUAL_UINT32(count, drive_image_write(&image, NULL, 0U));
}

static void test_another_schema_or_law_is_named(void)
{
    const uint32_t count = written(&gain_tables_drive);

    TEST_ASSERT_EQUAL_INT(DRIVE_IMAGE_OTHER_LAW,
                          drive_image_read(&back, harmonic_tables_drive.law, words, count));
    words[0]++;
    TEST_ASSERT_EQUAL_INT(DRIVE_IMAGE_OTHER_SCHEMA,
                          drive_image_read(&back, gain_tables_drive.law, words, count));
}

static void test_more_temperatures_than_room_are_refused(void)
{
    app_config_t many     = board_config;
    many.scale.ntc_points = DRIVE_IMAGE_TEMPERATURES + 1U;
    const uint32_t count  = written(&gain_tables_drive);
    drive_config_t none   = gain_tables_drive;
    none.law              = NULL;

    TEST_ASSERT_FALSE(drive_image_copy(&back, &many, &gain_tables_drive, &board_identity));
    TEST_ASSERT_FALSE(drive_image_copy(&back, &board_config, &none, &board_identity));

    /* the same in the words: the number of points stands before the temperatures */
    uint32_t at = 0U;
    for (uint32_t n = 0U; n < count; n++) {
        if ((words[n] == board_config.scale.ntc_points) &&
            (words[n - 1U] == board_config.scale.ntc_step_cnt)) {
            at = n;
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(0U, at);
    words[at] = DRIVE_IMAGE_TEMPERATURES + 1U;
    TEST_ASSERT_EQUAL_INT(DRIVE_IMAGE_DAMAGED,
                          drive_image_read(&back, gain_tables_drive.law, words, count));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_copy_is_what_was_compiled_in_and_points_into_itself);
    RUN_TEST(test_what_was_written_is_read_for_every_law_at_hand);
    RUN_TEST(test_no_constant_is_left_out);
    RUN_TEST(test_no_constant_of_the_application_is_left_out);
    RUN_TEST(test_a_long_name_is_cut_and_none_is_empty);
    RUN_TEST(test_every_length_but_the_right_one_is_damage);
    RUN_TEST(test_another_schema_or_law_is_named);
    RUN_TEST(test_more_temperatures_than_room_are_refused);
    return UNITY_END();
}
