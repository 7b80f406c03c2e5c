/* SPDX-License-Identifier: MIT */
#include "app_loader.h"

#include <string.h>

#include "app.h"
#include "app_modbus.h"
#include "board_config.h"
#include "crc32.h"
#include "fake_board.h"
#include "gain_tables.h"
#include "harmonic_tables.h"
#include "modbus_frame.h"
#include "start_race.h"
#include "unity.h"

#define ROOM 8192U

static drive_image_t other; /* what is loaded */
static uint16_t      words[ROOM];
static uint32_t      count;
static app_image_t   in_force;
static app_loader_t  loader;

static void use(const drive_config_t *drive, float speed_max_e_radps)
{
    TEST_ASSERT_TRUE(drive_image_copy(&other, &board_config, drive, &board_identity));
    other.drive.speed_max_e_radps = speed_max_e_radps;
    other.name[0]                 = 'x';
    count                         = drive_image_write(&other, words, ROOM);
    TEST_ASSERT_GREATER_THAN_UINT32(0U, count);
}

static void start_again(void)
{
    TEST_ASSERT_TRUE(
        app_image_choose(&in_force, &board_config, &gain_tables_drive, &board_identity));
    app_loader_init(&loader, &in_force);
}

void setUp(void)
{
    fake_board_reset();
    fake_board_erase_store();
    use(&gain_tables_drive, 500.0f);
    start_again();
}

void tearDown(void) {}

static app_loader_result_t tell(app_loader_command_t command, uint32_t number, uint32_t crc,
                                uint16_t used)
{
    const uint16_t            values[5] = {(uint16_t)command, (uint16_t)(number >> 16),
                                           (uint16_t)(number & 0xFFFFU), (uint16_t)(crc >> 16),
                                           (uint16_t)(crc & 0xFFFFU)};
    const app_loader_result_t result =
        app_loader_write(&loader, false, APP_LOADER_COMMAND, used, values);
    app_loader_work(&loader);
    return result;
}

static app_loader_result_t begin(void)
{
    return tell(APP_LOADER_BEGIN, count, 0U, 3U);
}

static app_loader_result_t commit(uint32_t crc)
{
    return tell(APP_LOADER_COMMIT, count, crc, 5U);
}

static app_loader_result_t put(uint32_t offset, uint16_t n)
{
    uint16_t values[2U + APP_LOADER_DATA] = {(uint16_t)(offset >> 16),
                                             (uint16_t)(offset & 0xFFFFU)};
    memcpy(&values[2], &words[offset], n * sizeof words[0]);
    return app_loader_write(&loader, false, APP_LOADER_OFFSET_HI, (uint16_t)(2U + n), values);
}

static void put_all(void)
{
    for (uint32_t at = 0U; at < count; at += APP_LOADER_DATA) {
        const uint32_t left = count - at;
        TEST_ASSERT_EQUAL_INT(
            APP_LOADER_OK, put(at, (uint16_t)((left < APP_LOADER_DATA) ? left : APP_LOADER_DATA)));
    }
}

static uint16_t input(uint16_t number)
{
    uint16_t value = 0U;
    TEST_ASSERT_TRUE(app_loader_read(&loader, number, 1U, &value));
    return value;
}

static void run_loader(void)
{
    loader.state = APP_LOADER_IDLE;
    loader.image = &in_force;
}

static void load(void)
{
    run_loader();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, begin());
    put_all();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, commit(crc32_words(CRC32_START, words, count)));
}

static void test_a_loaded_image_is_in_force_after_the_next_start(void)
{
    TEST_ASSERT_EQUAL_UINT16(0U, input(APP_LOADER_NUMBER_LO));
    load();
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_STORED, input(APP_LOADER_STATE));
    start_again();

    TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == 500.0f);
    TEST_ASSERT_EQUAL_UINT16(1U, input(APP_LOADER_NUMBER_LO));
    TEST_ASSERT_EQUAL_STRING("xpmsm_390w", in_force.image.app.drive_name);
    TEST_ASSERT_EQUAL_STRING(board_config.digest, in_force.image.app.digest);
    TEST_ASSERT_EQUAL_UINT16(gain_tables_drive.law->number, input(APP_LOADER_LAW));
}

/* Puts a map of the disc behind the image. */
static void add_disc(uint32_t positions)
{
    words[count]      = APP_DISC_FORMAT;
    words[count + 1U] = (uint16_t)positions;
    for (uint32_t n = 0U; n < (positions + 1U) / 2U; n++) {
        words[count + 2U + n] = (uint16_t)(n * 40503U);
    }
    count += 2U + ((positions + 1U) / 2U);
}

static void test_a_map_of_the_disc_comes_with_its_image_and_goes_with_it(void)
{
    const uint32_t positions = gain_tables_drive.hardware.encoder_positions;
    const uint32_t before    = count;

    TEST_ASSERT_NULL(in_force.disc);
    add_disc(positions);
    load();
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_STORED, input(APP_LOADER_STATE));
    start_again();
    TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == 500.0f);
    TEST_ASSERT_NOT_NULL(in_force.disc);
    TEST_ASSERT_EQUAL_UINT16_ARRAY(&words[before], in_force.disc, count - before);

    use(&gain_tables_drive, 500.0f);
    load(); /* without a map */
    start_again();
    TEST_ASSERT_NULL(in_force.disc);
    TEST_ASSERT_EQUAL_UINT32(2U, in_force.number);

    add_disc(positions);
    load();
    start_again();
    TEST_ASSERT_NOT_NULL(in_force.disc);
    run_loader();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, tell(APP_LOADER_FORGET, 0U, 0U, 1U));
    start_again();
    TEST_ASSERT_NULL(in_force.disc);
}

static void test_a_map_of_another_encoder_is_refused(void)
{
    const uint32_t positions = gain_tables_drive.hardware.encoder_positions;

    add_disc(positions - 4U);
    load();
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_IMAGE, input(APP_LOADER_STATE));
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OTHER_DISC, input(APP_LOADER_REASON));
    start_again();
    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);

    for (uint32_t less = 1U; less < 5U; less++) { /* part of a map, or words of something else */
        use(&gain_tables_drive, 500.0f);
        add_disc(positions);
        count -= (less < 4U) ? less : ((positions / 2U) + 1U);
        load();
        TEST_ASSERT_EQUAL_UINT16(APP_LOADER_IMAGE, input(APP_LOADER_STATE));
        TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OTHER_DISC, input(APP_LOADER_REASON));
    }
}

static void test_forgetting_brings_the_compiled_ones_back(void)
{
    load();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, tell(APP_LOADER_FORGET, 0U, 0U, 1U));
    start_again();

    TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == gain_tables_drive.speed_max_e_radps);
    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
}

static void test_a_wrong_sum_is_refused_and_the_old_image_stays(void)
{
    load();
    start_again();
    use(&gain_tables_drive, 600.0f);
    run_loader();
    (void)begin();
    put_all();

    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, commit(crc32_words(CRC32_START, words, count) ^ 1U));
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_SUM, input(APP_LOADER_STATE));
    start_again();
    TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == 500.0f);
}

/* Reason of a refused image whose words are these. */
static uint16_t reason_of_load(void)
{
    start_again();
    load();
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_IMAGE, input(APP_LOADER_STATE));
    const uint16_t reason = input(APP_LOADER_REASON);
    start_again();
    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
    return reason;
}

static void test_images_that_cannot_run_are_refused_with_their_reason(void)
{
    use(&harmonic_tables_drive, 500.0f);
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OTHER_LAW, reason_of_load());
    use(&gain_tables_drive, 500.0f);
    words[0] = 77U;
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OTHER_SCHEMA, reason_of_load());
    use(&gain_tables_drive, 500.0f);
    count--;
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_DAMAGED, reason_of_load());
    use(&gain_tables_drive, -1.0f); /* drive_config_check() */
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_REFUSED, reason_of_load());
    use(&gain_tables_drive, 500.0f);
    fake_board.misfit = true; /* board_fits() */
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_REFUSED, reason_of_load());
    fake_board.misfit     = false;
    other.app.dead_time_s = 1e-6f; /* not that of the drive: app_config_check() */
    count                 = drive_image_write(&other, words, ROOM);
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_REFUSED, reason_of_load());
}

/* The loader's registers about a field. */
static void expect_field(uint16_t field, float image, float board)
{
    uint16_t    all[APP_LOADER_INPUT_COUNT];
    const char *name = board_field_name(field);

    TEST_ASSERT_TRUE(app_loader_read(&loader, 0U, APP_LOADER_INPUT_COUNT, all));
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OTHER_BOARD, all[APP_LOADER_REASON]);
    TEST_ASSERT_EQUAL_UINT16(field, all[APP_LOADER_FIELD]);
    const uint32_t bits[2] = {((uint32_t)all[APP_LOADER_IMAGE_HI] << 16) | all[APP_LOADER_IMAGE_LO],
                              ((uint32_t)all[APP_LOADER_BOARD_HI] << 16) |
                                  all[APP_LOADER_BOARD_LO]};
    TEST_ASSERT_EQUAL_MEMORY(&bits[0], &image, sizeof image);
    TEST_ASSERT_EQUAL_MEMORY(&bits[1], &board, sizeof board);
    for (uint16_t n = 0U; n < 2U * (uint16_t)APP_LOADER_NAME_WORDS; n++) {
        const uint16_t word  = all[APP_LOADER_FIELD_NAME + (n / 2U)];
        const uint16_t octet = (uint16_t)(((n & 1U) == 0U) ? (word >> 8) : (word & 0xFFU));
        TEST_ASSERT_EQUAL_UINT16((uint16_t)*name, octet);
        name += (*name != '\0') ? 1 : 0;
    }
    TEST_ASSERT_EQUAL_HEX32(board_identity.sum,
                            ((uint32_t)all[APP_LOADER_SUM_HI] << 16) | all[APP_LOADER_SUM_LO]);
}

/* Every field, each alone. The old image stays. */
static void test_an_image_of_another_board_is_refused_by_the_name_of_the_field(void)
{
    for (uint16_t n = 0U; n < (uint16_t)BOARD_FACT_COUNT; n++) {
        use(&gain_tables_drive, 500.0f);
        other.board.fact[n] = (2.0f * other.board.fact[n]) + 0.5f;
        count               = drive_image_write(&other, words, ROOM);
        start_again();
        load();
        TEST_ASSERT_EQUAL_UINT16(APP_LOADER_IMAGE, input(APP_LOADER_STATE));
        expect_field((uint16_t)(n + 1U), other.board.fact[n], board_identity.fact[n]);
        start_again();
        TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
    }
    use(&gain_tables_drive, 500.0f);
    other.board.name[0] = 'x';
    count               = drive_image_write(&other, words, ROOM);
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OTHER_BOARD, reason_of_load());
}

/* With right sums, and made for this board by its own words. */
static void test_constants_that_contradict_the_board_are_refused(void)
{
    other.app.board.dead_time_cnt    = 4U;
    other.app.dead_time_s            = 5e-8f;
    other.drive.hardware.dead_time_s = 5e-8f;
    count                            = drive_image_write(&other, words, ROOM);
    start_again();
    load();
    expect_field((uint16_t)BOARD_FACT_DEAD_TIME_MIN_s + 1U, 4.0f / 75e6f, 3e-6f);

    use(&gain_tables_drive, 500.0f);
    other.drive.trip_current_A = 9.2f;
    count                      = drive_image_write(&other, words, ROOM);
    load();
    expect_field((uint16_t)BOARD_FACT_TRIP_CURRENT_A + 1U, 9.2f, 9.0f);
    use(&gain_tables_drive, 500.0f);
    load();
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_STORED, input(APP_LOADER_STATE));
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OK, input(APP_LOADER_REASON));
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_NONE, input(APP_LOADER_FIELD));
}

static void start_on(const board_identity_t *board)
{
    TEST_ASSERT_TRUE(app_image_choose(&in_force, &board_config, &gain_tables_drive, board));
    app_loader_init(&loader, &in_force);
}

/* A newer firmware, for another board: the image in the store and what is compiled in. */
static void test_a_stored_image_of_another_board_is_not_used_and_is_told(void)
{
    load();
    board_identity_t edited                 = board_identity;
    edited.fact[BOARD_FACT_RATED_CURRENT_A] = 4.5f;
    edited.sum                              = board_identity_sum(&edited);
    start_on(&edited);
    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
    TEST_ASSERT_FALSE(in_force.other_board);
    TEST_ASSERT_EQUAL_UINT16(DRIVE_IMAGE_OTHER_BOARD, input(APP_LOADER_REASON));
    TEST_ASSERT_EQUAL_UINT16((uint16_t)BOARD_FACT_RATED_CURRENT_A + 1U, input(APP_LOADER_FIELD));
    (void)app_init(&in_force.image.app, &in_force.image.drive);
    app_tell_image(&in_force);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, app_status_read().fault);
}

static void test_compiled_constants_of_another_board_stay_in_fault(void)
{
    board_identity_t edited                 = board_identity;
    edited.fact[BOARD_FACT_CURRENT_RANGE_A] = 20.0f;
    edited.sum                              = board_identity_sum(&edited);
    for (int damaged = 0; damaged < 2; damaged++) {
        start_on(&edited);
        TEST_ASSERT_TRUE(in_force.other_board);
        TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&in_force.image.app, &in_force.image.drive));
        app_tell_image(&in_force);
        for (int n = 0; n < 2000; n++) {
            app_tick();
            app_background();
        }
        TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, app_status_read().mode);
        TEST_ASSERT_EQUAL_INT(APP_FAULT_CONFIG, app_status_read().fault);
        edited     = board_identity;
        edited.sum = edited.sum ^ 1U; /* the board's own identity is damaged */
    }
    TEST_ASSERT_EQUAL_UINT16(BOARD_FIELD_SUM, input(APP_LOADER_FIELD));
}

static void test_a_stored_image_that_the_board_refuses_is_not_used(void)
{
    load();
    fake_board.misfit = true; /* a newer firmware, another board */
    start_again();

    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
    TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == gain_tables_drive.speed_max_e_radps);
    TEST_ASSERT_TRUE(in_force.fallback);
}

/* Stores images with these speeds, one after the other. */
static void load_all(const float *speeds_e_radps, int images)
{
    for (int n = 0; n < images; n++) {
        use(&gain_tables_drive, speeds_e_radps[n]);
        start_again();
        load();
        TEST_ASSERT_EQUAL_UINT16(APP_LOADER_STORED, input(APP_LOADER_STATE));
    }
    start_again();
}

static const float speeds[] = {500.0f, 600.0f, 700.0f};

static void test_a_flipped_bit_changes_nothing_or_is_told(void)
{
    for (int images = 1; images <= 3; images += 2) {
        int told = 0;
        fake_board_erase_store();
        load_all(speeds, images);
        TEST_ASSERT_FALSE(in_force.fallback);
        for (uint16_t slot = 0U; slot < 2U; slot++) {
            for (uint32_t n = 0U; n < (STORE_HEAD_WORDS + count + 1U); n++) {
                const uint16_t bit = (uint16_t)(1U << (n % 16U));
                fake_board_store[slot][n] ^= bit;
                start_again();
                fake_board_store[slot][n] ^= bit;
                TEST_ASSERT_TRUE(in_force.fallback ||
                                 (in_force.image.drive.speed_max_e_radps == speeds[images - 1]));
                told += in_force.fallback ? 1 : 0;
            }
        }
        TEST_ASSERT_EQUAL_INT(STORE_HEAD_WORDS - 1U + count, told); /* all but the mark's */
    }
}

/* Damages the image in force. */
static void lose(int images)
{
    fake_board_erase_store();
    load_all(speeds, images);
    fake_board_store[(images - 1) % 2][STORE_HEAD_WORDS + 40U] ^= 8U;
    start_again();
    TEST_ASSERT_TRUE(in_force.fallback);
}

static void test_a_lost_image_leaves_the_one_before_or_the_compiled_one(void)
{
    lose(1);
    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
    TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == gain_tables_drive.speed_max_e_radps);
    lose(2);
    TEST_ASSERT_EQUAL_UINT32(1U, in_force.number);
    TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == 500.0f);
}

static void test_an_accepted_fallback_is_in_force_for_good(void)
{
    for (int images = 1; images <= 3; images++) {
        lose(images);
        TEST_ASSERT_TRUE(app_image_accept(&in_force));
        TEST_ASSERT_FALSE(in_force.fallback);
        const uint32_t number = in_force.number;
        const float    speed  = in_force.image.drive.speed_max_e_radps;
        start_again();
        TEST_ASSERT_FALSE(in_force.fallback);
        TEST_ASSERT_EQUAL_UINT32(number, in_force.number);
        TEST_ASSERT_EQUAL_UINT32((images == 1) ? 0U : (uint32_t)images, number);
        TEST_ASSERT_TRUE(in_force.image.drive.speed_max_e_radps == speed);
    }
}

static void test_accepting_touches_nothing_else_and_tells_a_flash_that_fails(void)
{
    load_all(speeds, 2);
    fake_board.store_budget = 0;
    TEST_ASSERT_TRUE(app_image_accept(&in_force)); /* nothing to do */
    TEST_ASSERT_EQUAL_UINT32(2U, in_force.number);
    fake_board.store_budget = -1;
    lose(2);
    fake_board.store_budget = 100;
    TEST_ASSERT_FALSE(app_image_accept(&in_force));
    TEST_ASSERT_TRUE(in_force.fallback);
    fake_board.store_budget = -1;

    load(); /* another image ends it too */
    start_again();
    TEST_ASSERT_FALSE(in_force.fallback);
    load();
    fake_board.misfit = true; /* a whole image that is refused */
    start_again();
    TEST_ASSERT_TRUE(app_image_accept(&in_force));
    start_again();
    TEST_ASSERT_FALSE(in_force.fallback);
    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
}

static void test_words_come_in_turn_and_once(void)
{
    run_loader();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, put(0U, 5U)); /* before BEGIN */
    (void)begin();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, put(5U, 5U));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, put(0U, 5U));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, put(0U, 5U));
    TEST_ASSERT_EQUAL_UINT16(5U, input(APP_LOADER_PUT_LO));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, put(5U, 1U));
}

static void test_commands_have_their_place_and_their_length(void)
{
    /* the application */
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, begin());
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, tell(APP_LOADER_LEAVE, 0U, 0U, 1U));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, tell(APP_LOADER_FORGET, 0U, 0U, 1U));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, tell(APP_LOADER_ENTER, 0U, 0U, 2U));
    const uint16_t enter = APP_LOADER_ENTER;
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, app_loader_write(&loader, true, 0U, 1U, &enter));
    TEST_ASSERT_FALSE(loader.restart);
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, tell(APP_LOADER_ENTER, 0U, 0U, 1U));
    TEST_ASSERT_TRUE(loader.restart && loader.enter);
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, tell(APP_LOADER_ENTER, 0U, 0U, 1U)); /* once */

    /* the loader */
    start_again();
    run_loader();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, tell(APP_LOADER_ENTER, 0U, 0U, 1U));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, commit(0U)); /* nothing begun */
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, tell((app_loader_command_t)9, 0U, 0U, 1U));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, tell(APP_LOADER_LEAVE, 0U, 0U, 1U));
    TEST_ASSERT_TRUE(loader.restart && !loader.enter);
}

static void test_a_task_is_done_after_its_answer_and_nothing_else_meanwhile(void)
{
    const uint16_t forget = APP_LOADER_FORGET;
    const uint16_t leave  = APP_LOADER_LEAVE;
    run_loader();
    TEST_ASSERT_EQUAL_INT(APP_LOADER_OK, app_loader_write(&loader, false, 0U, 1U, &forget));
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_BUSY, input(APP_LOADER_STATE));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, app_loader_write(&loader, false, 0U, 1U, &leave));
    app_loader_work(&loader);
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_STORED, input(APP_LOADER_STATE));
}

static void test_registers_end_where_they_end(void)
{
    uint16_t values[APP_LOADER_HOLDING_COUNT + 1] = {0U};
    TEST_ASSERT_TRUE(app_loader_read(&loader, 0U, APP_LOADER_INPUT_COUNT, values));
    TEST_ASSERT_FALSE(app_loader_read(&loader, 1U, APP_LOADER_INPUT_COUNT, values));
    TEST_ASSERT_FALSE(app_loader_read(&loader, APP_LOADER_INPUT_COUNT, 1U, values));
    TEST_ASSERT_TRUE(app_loader_read_holding(0U, APP_LOADER_HOLDING_COUNT, values));
    TEST_ASSERT_FALSE(app_loader_read_holding(1U, APP_LOADER_HOLDING_COUNT, values));
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_ADDRESS,
                          app_loader_write(&loader, false, 1U, APP_LOADER_HOLDING_COUNT, values));
    for (uint16_t first = 1U; first < (uint16_t)APP_LOADER_HOLDING_COUNT; first++) {
        TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE,
                              app_loader_write(&loader, false, first, 1U, values));
    }
}

static void test_a_flash_that_fails_is_told(void)
{
    run_loader();
    fake_board.store_budget = 100;
    (void)begin();
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_FLASH, input(APP_LOADER_STATE));

    fake_board.store_budget = -1;
    (void)begin();
    fake_board.store_budget = 3;
    TEST_ASSERT_EQUAL_INT(APP_LOADER_BAD_VALUE, put(0U, 5U));
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_FLASH, input(APP_LOADER_STATE));

    fake_board.store_budget = -1;
    (void)begin();
    put_all();
    fake_board.store_budget = 3;
    (void)commit(crc32_words(CRC32_START, words, count));
    TEST_ASSERT_EQUAL_UINT16(APP_LOADER_FLASH, input(APP_LOADER_STATE));
    fake_board.store_budget = -1;
    start_again();
    TEST_ASSERT_EQUAL_UINT32(0U, in_force.number);
}

/* A request of function 6 to unit 1, and passes until its answer is out and a while beyond. */
static void ask(uint16_t number, uint16_t value, void (*pass)(void))
{
    const int octets[6] = {1, 6, number >> 8, number & 0xFF, value >> 8, value & 0xFF};

    modbus_frame_receive(octets, 6);
    for (int n = 0; n < 400; n++) {
        fake_board.cycles += board_config.board.pwm_cycles / 2U;
        pass();
    }
}

static void test_the_loader_answers_without_ticks_and_leaves_after_its_answer(void)
{
    app_loader_start(&in_force);
    ask(APP_LOADER_FIRST, APP_LOADER_LEAVE, app_loader_pass);

    TEST_ASSERT_EQUAL_INT(1, fake_board_sent());
    TEST_ASSERT_EQUAL_INT(6, fake_board_sent());
    TEST_ASSERT_GREATER_THAN_INT(0, fake_board.restarts);
    TEST_ASSERT_FALSE(fake_board.restart_loader);
    TEST_ASSERT_EQUAL_INT(0, fake_board.served);
}

static void tick_and_pass(void)
{
    app_tick();
    app_background();
}

static void test_the_application_enters_the_loader_and_not_by_broadcast(void)
{
    (void)app_init(&in_force.image.app, &in_force.image.drive);
    ask(APP_LOADER_FIRST, APP_LOADER_ENTER, tick_and_pass);
    TEST_ASSERT_EQUAL_INT(0, fake_board.restarts); /* nobody has told what is in force */

    app_tell_image(&in_force);
    const int broadcast[6] = {
        0, 6, APP_LOADER_FIRST >> 8, APP_LOADER_FIRST & 0xFFU, 0, APP_LOADER_ENTER};
    modbus_frame_receive(broadcast, 6);
    for (int n = 0; n < 200; n++) {
        tick_and_pass();
    }
    TEST_ASSERT_EQUAL_INT(0, fake_board.restarts);

    ask(APP_LOADER_FIRST, APP_LOADER_ENTER, tick_and_pass);
    TEST_ASSERT_GREATER_THAN_INT(0, fake_board.restarts);
    TEST_ASSERT_TRUE(fake_board.restart_loader);
}

/* A run that begins before the answer is out cancels the restart, for good. */
static void test_a_bridge_that_comes_on_cancels_the_restart(void)
{
    int ends[3] = {0};

    for (int from = 0; from < 60; from++) {
        const int enter[6] = {
            1, 6, APP_LOADER_FIRST >> 8, APP_LOADER_FIRST & 0xFF, 0, APP_LOADER_ENTER};
        setUp();
        (void)app_init(&in_force.image.app, &in_force.image.drive);
        app_tell_image(&in_force);
        start_race_ready(&in_force.image.drive);
        modbus_frame_receive(enter, 6);
        ends[start_race(&in_force.image.drive, from) + 1]++;
    }
    TEST_ASSERT_GREATER_THAN_INT(0, ends[1]);
    TEST_ASSERT_GREATER_THAN_INT(0, ends[2]);
}

/* True if the mode is left towards a run, an alignment or a commissioning. */
static bool starts(int16_t mode_of_operation)
{
    app_objects_t o     = app_control_default(&in_force.image.drive);
    bool          begun = false;

    o.mode_of_operation    = mode_of_operation;
    o.bounds.current_A     = 1.0f;
    o.bounds.speed_m_radps = 10.0f;
    (void)app_init(&in_force.image.app, &in_force.image.drive);
    app_tell_image(&in_force);
    app_take_parameters(APP_PARAMETERS_NOT_ASKED);
    for (int n = 0; n < 20000; n++) {
        o.controlword =
            (uint16_t)((n < 15000) ? APP_CONTROL_SHUT_DOWN : APP_CONTROL_ENABLE_OPERATION);
        (void)app_command_write(&o);
        tick_and_pass();
        begun = begun || (app_status_read().mode == APP_MODE_ALIGN) ||
                (app_status_read().mode == APP_MODE_COMMISSION) || app_status_read().gate_enable;
    }
    return begun;
}

static uint16_t conditions(void)
{
    const int octets[6] = {1, 4, 0, APP_REGISTERS_CONDITIONS, 0, 1};

    while (fake_board_sent() >= 0) {
    }
    modbus_frame_receive(octets, 6);
    for (int n = 0; n < 200; n++) {
        tick_and_pass();
    }
    for (int n = 0; n < 3; n++) {
        (void)fake_board_sent();
    }
    const int high = fake_board_sent();
    return (uint16_t)((high << 8) | fake_board_sent());
}

static void test_nothing_starts_with_a_fallback_until_it_is_accepted(void)
{
    static const int16_t modes[] = {APP_CONTROL_PROFILE_VELOCITY, APP_CONTROL_HOMING,
                                    APP_CONTROL_COMMISSIONING, APP_CONTROL_FIND_ANGLE};

    for (size_t i = 0U; i < (sizeof modes / sizeof modes[0]); i++) {
        lose(2);
        TEST_ASSERT_FALSE(starts(modes[i]));
        TEST_ASSERT_EQUAL_UINT16(APP_REGISTERS_IMAGE_LOST, conditions() & 0x1C00U);
        TEST_ASSERT_TRUE(app_image_accept(&in_force));
        TEST_ASSERT_TRUE(starts(modes[i]));
        TEST_ASSERT_EQUAL_UINT16(0U, conditions() & 0x1C00U);
    }
    fake_board_store[2][0] = STORE_MARK; /* a record of parameters that is not whole */
    TEST_ASSERT_FALSE(starts(APP_CONTROL_PROFILE_VELOCITY));
    TEST_ASSERT_EQUAL_UINT16(APP_REGISTERS_RECORD_LOST, conditions() & 0x1C00U);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_loaded_image_is_in_force_after_the_next_start);
    RUN_TEST(test_a_map_of_the_disc_comes_with_its_image_and_goes_with_it);
    RUN_TEST(test_a_map_of_another_encoder_is_refused);
    RUN_TEST(test_forgetting_brings_the_compiled_ones_back);
    RUN_TEST(test_a_wrong_sum_is_refused_and_the_old_image_stays);
    RUN_TEST(test_images_that_cannot_run_are_refused_with_their_reason);
    RUN_TEST(test_an_image_of_another_board_is_refused_by_the_name_of_the_field);
    RUN_TEST(test_constants_that_contradict_the_board_are_refused);
    RUN_TEST(test_a_stored_image_of_another_board_is_not_used_and_is_told);
    RUN_TEST(test_compiled_constants_of_another_board_stay_in_fault);
    RUN_TEST(test_a_stored_image_that_the_board_refuses_is_not_used);
    RUN_TEST(test_a_flipped_bit_changes_nothing_or_is_told);
    RUN_TEST(test_a_lost_image_leaves_the_one_before_or_the_compiled_one);
    RUN_TEST(test_an_accepted_fallback_is_in_force_for_good);
    RUN_TEST(test_accepting_touches_nothing_else_and_tells_a_flash_that_fails);
    RUN_TEST(test_nothing_starts_with_a_fallback_until_it_is_accepted);
    RUN_TEST(test_words_come_in_turn_and_once);
    RUN_TEST(test_commands_have_their_place_and_their_length);
    RUN_TEST(test_a_task_is_done_after_its_answer_and_nothing_else_meanwhile);
    RUN_TEST(test_registers_end_where_they_end);
    RUN_TEST(test_a_flash_that_fails_is_told);
    RUN_TEST(test_the_loader_answers_without_ticks_and_leaves_after_its_answer);
    RUN_TEST(test_the_application_enters_the_loader_and_not_by_broadcast);
    RUN_TEST(test_a_bridge_that_comes_on_cancels_the_restart);
    return UNITY_END();
}
