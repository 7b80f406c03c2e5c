/* SPDX-License-Identifier: MIT */
#include "app_parameters.h"

#include <string.h>

#include "app.h"
#include "app_modbus.h"
#include "app_registers.h"
#include "board_config.h"
#include "fake_board.h"
#include "gain_tables.h"
#include "modbus_frame.h"
#include "register_words.h"
#include "start_race.h"
#include "unity.h"

static app_registers_t  registers;
static app_parameters_t parameters;
static app_image_t      in_force;

/* The start of the drive, with what was asked for before it. */
static void start_again(void)
{
    const app_parameters_done_t done = app_parameters_work(&in_force);

    TEST_ASSERT_EQUAL_INT(CTL_OK,
                          app_registers_init(&registers, &board_config, &gain_tables_drive));
    app_parameters_take(&parameters, &registers, done);
}

static void power_on(void)
{
    (void)memset(board_kept(), 0xA5, BOARD_KEPT_WORDS * sizeof(uint16_t));
    start_again();
}

void setUp(void)
{
    fake_board_reset();
    fake_board_erase_store();
    TEST_ASSERT_TRUE(
        app_image_choose(&in_force, &board_config, &gain_tables_drive, &board_identity));
    power_on();
}

void tearDown(void) {}

static uint16_t input(int address)
{
    return register_words_input(&registers, address);
}

static uint16_t holding(int address)
{
    return register_words_holding(&registers, address);
}

static app_registers_result_t write_two(int address, int high, int low)
{
    const uint16_t words[2] = {(uint16_t)high, (uint16_t)low};
    return app_registers_write(&registers, (uint16_t)address, 2U, words);
}

static app_registers_result_t write(int address, int value)
{
    return register_words_write(&registers, address, value);
}

static app_registers_result_t ask_store(void)
{
    return write_two(APP_REGISTERS_STORE_PARAMETERS, 0x6576, 0x6173); /* "save", CiA 301 */
}

/* As app.c does it when the answer is out. */
static void restart(void)
{
    app_parameters_ask(&registers, (app_parameters_command_t)registers.requested.store_command);
    start_again();
}

static void store(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, ask_store());
    restart();
}

/* Addresses, high and low word of a value of each parameter that is not its default; docs/modbus.md. */
static const int other[][3] = {
    {7, 0, 123},     {9, 1, 5},      {11, 2, 3},          {13, -1, 6},    {14, -1, 1},
    {15, -1, 1},     {16, -1, 3},    {17, 0, 1500},       {19, -1, 77},   {22, -1, 1500},
    {64, -1, 42},    {65, -1, 700},  {66, 0, 19200},      {68, -1, 2},    {69, -1, 1},
    {162, 1, 77},    {164, 2, 5},    {166, -1, 9},        {167, 0, 3000}, {192, -1, 0},
    {226, -1, 1500}, {227, 0, 2500}, {258, -1, 25},       {261, 0, 900},  {263, -1, 40},
    {288, -1, 7},    {289, -1, 125}, {320, -1, 46},       {321, -1, 9},   {322, 0, 5000},
    {324, -1, 2},    {325, -1, 224}, {326, 65535, 65486}, {328, 1, 77},   {352, -1, 34},
    {353, 0, 900},   {355, 0, 50},   {357, 0, 4000},      {359, 0, 250},  {361, -1, 300},
    {362, -1, 5},    {363, -1, 2},   {384, -1, 1},        {385, -1, 250}, {386, -1, 77}};

#define OTHERS ((int)(sizeof other / sizeof other[0]))
#define ROOM   (2 + (3 * (OTHERS + 4))) /* words of a record, with some more parameters */

static void write_others(void)
{
    for (int n = 0; n < OTHERS; n++) {
        const int *o = other[n];
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                              (o[1] < 0) ? write(o[0], o[2]) : write_two(o[0], o[1], o[2]));
    }
}

static void assert_others(bool are)
{
    for (int n = 0; n < OTHERS; n++) {
        const int *o    = other[n];
        const bool wide = o[1] >= 0;
        const bool same = (holding(o[0] + (wide ? 1 : 0)) == (uint16_t)o[2]) &&
                          (!wide || (holding(o[0]) == (uint16_t)o[1]));
        TEST_ASSERT_EQUAL_INT_MESSAGE(are, same, "parameter");
    }
}

static void assert_state(app_parameters_state_t state)
{
    const bool refused = (state == APP_PARAMETERS_OTHER_VERSION) ||
                         (state == APP_PARAMETERS_OUT_OF_RANGE) || (state == APP_PARAMETERS_PARTLY);
    const bool lost = state == APP_PARAMETERS_LOST;

    TEST_ASSERT_EQUAL_UINT16(state, input(APP_REGISTERS_PARAMETERS_STATE));
    TEST_ASSERT_EQUAL_UINT16((refused ? 1024U : 0U) | (lost ? 4096U : 0U),
                             input(APP_REGISTERS_CONDITIONS) & (1024U | 4096U));
}

static void test_the_test_knows_every_parameter(void)
{
    int saved = 0;
    for (int n = 0; n < (int)APP_REGISTERS_MAP_HOLDING; n++) {
        saved += (app_registers_map_holding[n].saved != 0U) ? 1 : 0;
    }
    TEST_ASSERT_EQUAL_INT(OTHERS, saved);
    write_others();
    assert_others(true);
}

static void test_without_anything_stored_there_are_defaults(void)
{
    assert_others(false);
    assert_state(APP_PARAMETERS_DEFAULT);
    TEST_ASSERT_EQUAL_UINT16(0U, input(APP_REGISTERS_PARAMETERS_DONE));
    TEST_ASSERT_FALSE(registers.changed);
}

static void test_what_is_stored_is_there_after_power_and_nothing_else(void)
{
    write_others();
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_two(APP_REGISTERS_SPEED, 0, 1000));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_COMMISSION_CURRENT, 100));
    store();

    for (int power = 0; power < 2; power++) {
        assert_others(true);
        assert_state(APP_PARAMETERS_STORED);
        TEST_ASSERT_EQUAL_UINT16((power == 0) ? APP_PARAMETERS_DONE : APP_PARAMETERS_NOT_ASKED,
                                 input(APP_REGISTERS_PARAMETERS_DONE));
        TEST_ASSERT_EQUAL_UINT16(1U, input(APP_REGISTERS_PARAMETERS_NUMBER + 1));
        TEST_ASSERT_EQUAL_UINT16(0U, holding(APP_REGISTERS_SPEED + 1));
        TEST_ASSERT_EQUAL_UINT16(0U, holding(APP_REGISTERS_COMMISSION_CURRENT));
        TEST_ASSERT_TRUE(registers.changed); /* the tick gets them */
        start_again();
    }
}

static void test_restoring_brings_the_defaults_back(void)
{
    write_others();
    store();
    store();
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          write_two(APP_REGISTERS_RESTORE_PARAMETERS, 0x6461, 0x6F6C)); /* "load" */
    restart();

    assert_others(false);
    assert_state(APP_PARAMETERS_DEFAULT);
    TEST_ASSERT_EQUAL_UINT16(APP_PARAMETERS_DONE, input(APP_REGISTERS_PARAMETERS_DONE));
}

static void test_a_stray_write_does_nothing(void)
{
    TEST_ASSERT_EQUAL_UINT16(1U, holding(APP_REGISTERS_STORE_PARAMETERS + 1));
    for (int bit = 0; bit < 32; bit++) {
        const uint32_t wrong = 0x65766173UL ^ (1UL << bit);
        TEST_ASSERT_EQUAL_INT(
            APP_REGISTERS_BAD_VALUE,
            write_two(APP_REGISTERS_STORE_PARAMETERS, (int)(wrong >> 16), (int)(wrong & 0xFFFFU)));
    }
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE,
                          write_two(APP_REGISTERS_STORE_PARAMETERS, 0x6461, 0x6F6C));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE,
                          write_two(APP_REGISTERS_RESTORE_PARAMETERS, 0x6576, 0x6173));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_ADDRESS, write(APP_REGISTERS_STORE_PARAMETERS, 0x6576));
    TEST_ASSERT_EQUAL_UINT16(APP_PARAMETERS_NO_COMMAND, registers.requested.store_command);
}

static void test_nothing_is_stored_unless_the_motor_stands_still(void)
{
    registers.status.gate_enable = true;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_store());
    registers.status.gate_enable = false;
    registers.status.state       = APP_CONTROL_OPERATION_ENABLED;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_store());
    registers.status.state         = APP_CONTROL_SWITCHED;
    registers.status.speed_e_radps = -1.1f * board_config.stop.still_e_radps; /* it coasts */
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_store());
    registers.status.speed_e_radps = -0.9f * board_config.stop.still_e_radps;
    registers.parameters           = NULL; /* the loader, or a broadcast */
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_store());
    registers.parameters = &parameters;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, ask_store());
}

static void test_parameters_that_need_a_stop_are_refused_while_enabled(void)
{
    int refused                  = 0;
    registers.status.gate_enable = true;
    for (int n = 0; n < OTHERS; n++) {
        const int                   *o = other[n];
        const app_registers_result_t result =
            (o[1] < 0) ? write(o[0], o[2]) : write_two(o[0], o[1], o[2]);
        bool needs = false;
        for (int k = 0; k < (int)APP_REGISTERS_MAP_HOLDING; k++) {
            const app_registers_entry_t *e = &app_registers_map_holding[k];
            needs = needs || ((e->address == (uint16_t)o[0]) && e->stopped);
        }
        TEST_ASSERT_EQUAL_INT(needs ? APP_REGISTERS_BUSY : APP_REGISTERS_OK, result);
        refused += needs ? 1 : 0;
    }
    TEST_ASSERT_EQUAL_INT(9, refused); /* the line, units, and whether there is a brake */
    TEST_ASSERT_EQUAL_UINT32(115200UL, registers.requested.line.baud_Bd);
}

static void test_a_line_that_the_board_cannot_have_is_refused(void)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write_two(APP_REGISTERS_BAUD_RATE, 0, 9601));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write_two(APP_REGISTERS_BAUD_RATE, 0, 4800));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BAD_VALUE, write(APP_REGISTERS_LINE_FORMAT, 3));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write_two(APP_REGISTERS_BAUD_RATE, 0, 9600));
}

/* A record of these words, as a firmware would have written it. */
static void write_record(const uint16_t *words, uint16_t count)
{
    store_write_t w;
    TEST_ASSERT_TRUE(store_begin(&w, STORE_PARAMETERS, count));
    TEST_ASSERT_TRUE(store_put(&w, 0U, words, count));
    TEST_ASSERT_TRUE(store_commit(&w));
}

#define EACH  ((int)APP_REGISTERS_SAVED_EACH)
#define WORDS ((uint16_t)(2U + (APP_REGISTERS_SAVED * APP_REGISTERS_SAVED_EACH)))

/* The record of the other values. */
static uint16_t record(uint16_t *words)
{
    fake_board_erase_store();
    start_again();
    write_others();
    words[0] = 0x5041U;
    words[1] = 0x5232U;
    app_registers_saved_read(&registers, &words[2]);
    return WORDS;
}

static void test_another_order_changes_nothing(void)
{
    uint16_t words[ROOM];
    uint16_t turned[ROOM];

    (void)record(words);
    (void)memcpy(turned, words, sizeof turned);
    for (int n = 0; n < OTHERS; n++) {
        (void)memcpy(&turned[2 + (EACH * n)], &words[2 + (EACH * (OTHERS - 1 - n))],
                     (size_t)EACH * sizeof *words);
    }
    write_record(turned, WORDS);
    start_again();
    assert_others(true);
    assert_state(APP_PARAMETERS_STORED);
    TEST_ASSERT_EQUAL_UINT16(0U, input(APP_REGISTERS_PARAMETERS_DROPPED));
}

/* Stored by a firmware without the n-th parameter: that one has its default, the others are kept. */
static void test_a_new_parameter_has_its_default(void)
{
    for (int n = 0; n < OTHERS; n++) {
        uint16_t words[ROOM];

        (void)record(words);
        (void)memmove(&words[2 + (EACH * n)], &words[2 + (EACH * (n + 1))],
                      (size_t)(EACH * (OTHERS - 1 - n)) * sizeof *words);
        write_record(words, (uint16_t)(WORDS - (uint16_t)EACH));
        start_again();
        assert_state(APP_PARAMETERS_STORED);
        for (int k = 0; k < OTHERS; k++) {
            const int low = other[k][0] + ((other[k][1] < 0) ? 0 : 1);
            TEST_ASSERT_EQUAL_INT(k != n, holding(low) == (uint16_t)other[k][2]);
        }
    }
}

/* Stored by a firmware that had some more parameters, or another unit for the first ones. */
static void test_parameters_that_are_gone_are_counted_and_the_others_kept(void)
{
    for (int more = 1; more <= 4; more++) {
        uint16_t words[ROOM];

        (void)record(words);
        for (int n = 0; n < more; n++) {
            words[WORDS + (EACH * n)]     = (uint16_t)(1U + (unsigned)n); /* no digest of ours */
            words[WORDS + (EACH * n) + 1] = 0xFFFFU;
            words[WORDS + (EACH * n) + 2] = 0xFFFFU;
        }
        write_record(words, (uint16_t)(WORDS + (uint16_t)(EACH * more)));
        start_again();
        assert_others(true);
        assert_state(APP_PARAMETERS_PARTLY);
        TEST_ASSERT_EQUAL_UINT16(more, input(APP_REGISTERS_PARAMETERS_DROPPED));
        TEST_ASSERT_EQUAL_UINT16(1U, input(APP_REGISTERS_PARAMETERS_NUMBER + 1));
        store(); /* and they are gone */
        assert_state(APP_PARAMETERS_STORED);
        assert_others(true);
    }
}

static void test_no_digest_is_one_of_the_test(void)
{
    for (int n = 0; n < (int)APP_REGISTERS_MAP_HOLDING; n++) {
        const uint16_t digest = app_registers_map_holding[n].saved;
        TEST_ASSERT_TRUE((digest == 0U) || (digest > 4U));
    }
}

static void test_a_record_of_another_format_gives_defaults_and_is_told(void)
{
    uint16_t words[ROOM];
    for (uint16_t wrong = 0U; wrong < 4U; wrong++) {
        uint16_t count = record(words);
        if (wrong < 2U) {
            words[wrong] ^= 1U;
        } else {
            count             = (uint16_t)(count + 5U - (2U * wrong)); /* one more, one less */
            words[count - 1U] = 0U;
        }
        write_record(words, count);
        start_again();
        assert_others(false);
        assert_state(APP_PARAMETERS_OTHER_VERSION);
        TEST_ASSERT_FALSE(registers.changed);
        write_others();
        store(); /* and it is gone */
        assert_state(APP_PARAMETERS_STORED);
    }
}

static void test_one_value_out_of_range_gives_defaults_for_all(void)
{
    /* word of the record and what it must not be: an option, the address, the baud rate, the format */
    static const int bad[][2] = {{13, 3}, {34, 0}, {34, 248}, {40, 9601}, {43, 3}, {46, 2}};
    uint16_t         words[ROOM];
    for (int n = 0; n < (int)(sizeof bad / sizeof bad[0]); n++) {
        const uint16_t count = record(words);
        words[bad[n][0]]     = (uint16_t)bad[n][1];
        write_record(words, count);
        start_again();
        assert_others(false);
        assert_state(APP_PARAMETERS_OUT_OF_RANGE);
        TEST_ASSERT_EQUAL_UINT16(0U, input(APP_REGISTERS_PARAMETERS_NUMBER + 1));
    }
    write_record(words, record(words));
    start_again();
    assert_others(true);
}

/* Each word where something ends or begins, some of those that are only erased. */
static int next_cut(int budget)
{
    const int slot = (int)BOARD_STORE_WORDS;
    const int near = 80; /* head and record have fewer */
    const int into = budget % slot;
    if ((into < near) || (into >= (slot - near))) {
        return budget + 1;
    }
    return ((into + 2003) < (slot - near)) ? (budget + 2003) : (budget - into + slot - near);
}

static void cut_everywhere(uint16_t before, bool restoring)
{
    bool done = false;
    for (int budget = 0; !done; budget = next_cut(budget)) {
        fake_board_erase_store();
        power_on();
        for (uint16_t n = 1U; n <= before; n++) {
            TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SPEED_WINDOW, 100 + n));
            store();
        }
        write_others();
        fake_board.store_budget = budget;
        if (restoring) {
            app_parameters_ask(&registers, APP_PARAMETERS_RESTORE);
            start_again();
        } else {
            store();
        }
        done = parameters.done == APP_PARAMETERS_DONE;
        TEST_ASSERT_TRUE(done || (parameters.done == APP_PARAMETERS_FLASH));
        fake_board.store_budget = -1;
        power_on();

        const uint16_t window = holding(APP_REGISTERS_SPEED_WINDOW);
        const uint16_t old    = (before > 0U) ? (uint16_t)(100U + before) : 50U;
        const uint16_t fresh  = restoring ? 50U : 77U;
        TEST_ASSERT_TRUE_MESSAGE((window == fresh) || (!done && (window == old)), "neither");
        if (!restoring) {
            assert_others(window == 77U);
        }
        TEST_ASSERT_TRUE(parameters.state <= APP_PARAMETERS_STORED);
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SPEED_WINDOW, 55));
        store(); /* whatever is left, the next one is good */
        TEST_ASSERT_EQUAL_UINT16(55U, holding(APP_REGISTERS_SPEED_WINDOW));
    }
}

static void test_a_power_cut_at_any_word_leaves_old_or_new(void)
{
    cut_everywhere(0U, false);
    cut_everywhere(1U, false);
    cut_everywhere(2U, false);
}

static void test_a_power_cut_while_restoring_leaves_the_newest_or_defaults(void)
{
    cut_everywhere(2U, true);
}

/* Flips every bit of both slots of the parameters, and starts. */
static void flip_everywhere(uint16_t window, uint32_t number, int *lost)
{
    for (uint16_t slot = 2U; slot < 4U; slot++) {
        for (uint32_t n = 0U; n < (STORE_HEAD_WORDS + 2U + WORDS); n++) {
            for (uint16_t bit = 0U; bit < 16U; bit++) {
                fake_board_store[slot][n] ^= (uint16_t)(1U << bit);
                power_on();
                if (parameters.state == APP_PARAMETERS_LOST) {
                    (*lost)++;
                    assert_state(APP_PARAMETERS_LOST);
                } else {
                    TEST_ASSERT_EQUAL_UINT16(window, holding(APP_REGISTERS_SPEED_WINDOW));
                    TEST_ASSERT_EQUAL_UINT32(number, parameters.number);
                }
                fake_board_store[slot][n] ^= (uint16_t)(1U << bit);
            }
        }
    }
}

static void store_window(int window)
{
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, write(APP_REGISTERS_SPEED_WINDOW, window));
    store();
}

static void test_a_flipped_bit_changes_nothing_or_is_told(void)
{
    /* kind, count, number, CRC and the record, of the slot in force; the mark is known with one bit wrong */
    const int each = 16 * (int)(STORE_HEAD_WORDS - 1U + WORDS);
    int       lost = 0;

    flip_everywhere(50U, 0U, &lost);
    TEST_ASSERT_EQUAL_INT(0, lost);
    for (int n = 1; n <= 3; n++) {
        lost = 0;
        store_window(100 + n);
        flip_everywhere((uint16_t)(100 + n), (uint32_t)n, &lost);
        TEST_ASSERT_EQUAL_INT(each, lost);
    }
    lost = 0;
    app_parameters_ask(&registers, APP_PARAMETERS_RESTORE);
    start_again();
    flip_everywhere(50U, 0U, &lost);
    TEST_ASSERT_EQUAL_INT(16 * (int)(STORE_HEAD_WORDS - 1U), lost);
}

static app_registers_result_t ask_accept(void)
{
    return write_two(APP_REGISTERS_ACCEPT_FALLBACK, 0x656B, 0x6174); /* "take" */
}

/* Damages the record in force after `writes` writes. */
static void lose(int writes)
{
    for (int n = 1; n <= writes; n++) {
        store_window(100 + n);
    }
    fake_board_store[2 + ((writes - 1) % 2)][STORE_HEAD_WORDS + 5U] ^= 0x0400U;
    start_again();
    assert_state(APP_PARAMETERS_LOST);
}

static void test_what_is_lost_is_replaced_on_command_only(void)
{
    static const struct {
        int      writes;
        uint16_t window; /* of the fall-back */
        uint32_t writes_after;
    } cases[] = {{1, 50U, 1UL}, {2, 101U, 2UL}, {3, 102U, 3UL}};

    for (size_t i = 0U; i < (sizeof cases / sizeof cases[0]); i++) {
        setUp();
        lose(cases[i].writes);
        TEST_ASSERT_EQUAL_UINT16(cases[i].window, holding(APP_REGISTERS_SPEED_WINDOW));
        TEST_ASSERT_EQUAL_UINT16(128U, input(APP_REGISTERS_STATUSWORD) & 128U);
        power_on();
        assert_state(APP_PARAMETERS_LOST); /* another start does not help */

        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, ask_accept());
        restart();
        TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_DONE, parameters.done);
        assert_state((cases[i].writes == 1) ? APP_PARAMETERS_DEFAULT : APP_PARAMETERS_STORED);
        TEST_ASSERT_EQUAL_UINT16(cases[i].window, holding(APP_REGISTERS_SPEED_WINDOW));
        TEST_ASSERT_EQUAL_UINT32(cases[i].writes_after, parameters.writes);
        TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_accept()); /* nothing is lost */
    }
    for (int restoring = 0; restoring < 2; restoring++) { /* another writing helps too */
        setUp();
        lose(2);
        app_parameters_ask(&registers,
                           (restoring != 0) ? APP_PARAMETERS_RESTORE : APP_PARAMETERS_STORE);
        start_again();
        assert_state((restoring != 0) ? APP_PARAMETERS_DEFAULT : APP_PARAMETERS_STORED);
    }
}

static void test_a_power_cut_while_accepting_leaves_lost_or_accepted(void)
{
    bool done = false;
    for (int budget = 0; !done; budget = next_cut(budget)) {
        setUp();
        lose(2);
        app_parameters_ask(&registers, APP_PARAMETERS_ACCEPT);
        fake_board.store_budget = budget;
        start_again();
        done                    = parameters.done == APP_PARAMETERS_DONE;
        fake_board.store_budget = -1;
        power_on();
        TEST_ASSERT_TRUE((parameters.state == APP_PARAMETERS_STORED) ||
                         (!done && (parameters.state == APP_PARAMETERS_LOST)));
        TEST_ASSERT_EQUAL_UINT16(101U, holding(APP_REGISTERS_SPEED_WINDOW));
    }
}

static void test_writes_are_counted_and_need_a_rest(void)
{
    for (uint32_t n = 1U; n <= 8U; n++) {
        store();
        TEST_ASSERT_EQUAL_UINT16(n, input(APP_REGISTERS_PARAMETERS_WRITES + 1));
    }
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_store());
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY,
                          write_two(APP_REGISTERS_RESTORE_PARAMETERS, 0x6461, 0x6F6C));
    app_parameters_rest(&parameters, 3599.9f);
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_store());
    app_parameters_rest(&parameters, 3600.1f);
    app_parameters_rest(&parameters, 0.0f); /* the count of ticks wraps */
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, ask_store());
    restart();
    TEST_ASSERT_EQUAL_UINT16(9U, input(APP_REGISTERS_PARAMETERS_WRITES + 1));
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_BUSY, ask_store());
    power_on();
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK, ask_store());

    app_parameters_ask(&registers, APP_PARAMETERS_RESTORE); /* forgetting is a write */
    start_again();
    TEST_ASSERT_EQUAL_UINT16(10U, input(APP_REGISTERS_PARAMETERS_WRITES + 1));
    TEST_ASSERT_EQUAL_UINT16(0U, input(APP_REGISTERS_PARAMETERS_NUMBER + 1));
}

static void test_a_request_is_done_once_and_only_whole(void)
{
    write_others();
    app_parameters_ask(&registers, APP_PARAMETERS_STORE);
    TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_DONE, app_parameters_work(&in_force));
    TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_NOT_ASKED, app_parameters_work(&in_force));
    for (uint16_t n = 0U; n < (uint16_t)(4U + WORDS); n++) {
        app_parameters_ask(&registers, APP_PARAMETERS_STORE);
        board_kept()[n] ^= 0x0100U;
        TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_NOT_ASKED, app_parameters_work(&in_force));
    }
}

/* A request of function 16 with two registers, and passes until its answer is out and a while beyond. */
static void request(int unit, int address, int high, int low)
{
    const int body[11] = {unit, 16,        address >> 8, address & 0xFF, 0,         2,
                          4,    high >> 8, high & 0xFF,  low >> 8,       low & 0xFF};
    modbus_frame_receive(body, 11);
    for (int n = 0; n < 200; n++) {
        app_tick();
        app_background();
    }
}

static void run_application(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&board_config, &gain_tables_drive));
    app_take_parameters(app_parameters_work(&in_force));
}

static void test_the_application_restarts_to_store_and_takes_its_line(void)
{
    (void)write_two(APP_REGISTERS_BAUD_RATE, 0, 9600);
    (void)write(APP_REGISTERS_LINE_FORMAT, 1);
    (void)write(APP_REGISTERS_MODBUS_ADDRESS, 5);
    store();
    run_application();
    TEST_ASSERT_EQUAL_UINT32(9600UL, fake_board.line.baud_Bd);
    TEST_ASSERT_EQUAL_UINT16(BOARD_LINE_ODD, fake_board.line.format);

    request(0, APP_REGISTERS_STORE_PARAMETERS, 0x6576, 0x6173); /* to all: nobody */
    TEST_ASSERT_EQUAL_INT(0, fake_board.restarts);
    request(5, APP_REGISTERS_SPEED, 0, 0);
    TEST_ASSERT_EQUAL_INT(5, fake_board_sent()); /* the stored address */
    TEST_ASSERT_EQUAL_INT(0, fake_board.restarts);
    request(5, APP_REGISTERS_STORE_PARAMETERS, 0x6576, 0x6173);
    TEST_ASSERT_GREATER_THAN_INT(0, fake_board.restarts);
    TEST_ASSERT_TRUE(fake_board.restart_loader);
    TEST_ASSERT_EQUAL_INT(APP_PARAMETERS_DONE, app_parameters_work(&in_force));
}

/* The same of the restart that stores: what was asked before a run is not stored after it. */
static void test_a_bridge_that_comes_on_cancels_the_storing(void)
{
    int ends[3] = {0};

    for (int from = 0; from < 60; from++) {
        const int store_all[11] = {1,
                                   16,
                                   APP_REGISTERS_STORE_PARAMETERS >> 8,
                                   APP_REGISTERS_STORE_PARAMETERS & 0xFF,
                                   0,
                                   2,
                                   4,
                                   0x65,
                                   0x76,
                                   0x61,
                                   0x73};
        setUp();
        run_application();
        start_race_ready(&gain_tables_drive);
        modbus_frame_receive(store_all, 11);
        const int end = start_race(&gain_tables_drive, from);
        TEST_ASSERT_EQUAL_INT((end == 1) ? APP_PARAMETERS_DONE : APP_PARAMETERS_NOT_ASKED,
                              app_parameters_work(&in_force));
        ends[end + 1]++;
    }
    TEST_ASSERT_GREATER_THAN_INT(0, ends[1]);
    TEST_ASSERT_GREATER_THAN_INT(0, ends[2]);
}

static void test_the_loader_has_the_stored_line_and_address_and_stores_nothing(void)
{
    (void)write_two(APP_REGISTERS_BAUD_RATE, 0, 19200);
    store();
    TEST_ASSERT_TRUE(
        app_image_choose(&in_force, &board_config, &gain_tables_drive, &board_identity));
    app_loader_start(&in_force);
    TEST_ASSERT_EQUAL_UINT32(19200UL, fake_board.line.baud_Bd);
}

static void test_silence_follows_the_baud_rate(void)
{
    static const struct {
        uint32_t baud_Bd;
        uint16_t ticks; /* of 200 us: 3.5 octets of 11 bits or 1.75 ms, rounded up, and one */
    } want[] = {{9600UL, 22U}, {19200UL, 12U}, {38400UL, 10U}, {115200UL, 10U}};
    app_modbus_t m;
    for (int n = 0; n < (int)(sizeof want / sizeof want[0]); n++) {
        const board_line_t line = {.baud_Bd = want[n].baud_Bd};
        app_modbus_follow(&m, &line, 200e-6f, 10U);
        TEST_ASSERT_EQUAL_UINT16(want[n].ticks, m.gap_ticks);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_test_knows_every_parameter);
    RUN_TEST(test_without_anything_stored_there_are_defaults);
    RUN_TEST(test_what_is_stored_is_there_after_power_and_nothing_else);
    RUN_TEST(test_restoring_brings_the_defaults_back);
    RUN_TEST(test_a_stray_write_does_nothing);
    RUN_TEST(test_nothing_is_stored_unless_the_motor_stands_still);
    RUN_TEST(test_parameters_that_need_a_stop_are_refused_while_enabled);
    RUN_TEST(test_a_line_that_the_board_cannot_have_is_refused);
    RUN_TEST(test_another_order_changes_nothing);
    RUN_TEST(test_a_new_parameter_has_its_default);
    RUN_TEST(test_parameters_that_are_gone_are_counted_and_the_others_kept);
    RUN_TEST(test_no_digest_is_one_of_the_test);
    RUN_TEST(test_a_record_of_another_format_gives_defaults_and_is_told);
    RUN_TEST(test_one_value_out_of_range_gives_defaults_for_all);
    RUN_TEST(test_a_power_cut_at_any_word_leaves_old_or_new);
    RUN_TEST(test_a_power_cut_while_restoring_leaves_the_newest_or_defaults);
    RUN_TEST(test_a_flipped_bit_changes_nothing_or_is_told);
    RUN_TEST(test_what_is_lost_is_replaced_on_command_only);
    RUN_TEST(test_a_power_cut_while_accepting_leaves_lost_or_accepted);
    RUN_TEST(test_writes_are_counted_and_need_a_rest);
    RUN_TEST(test_a_request_is_done_once_and_only_whole);
    RUN_TEST(test_the_application_restarts_to_store_and_takes_its_line);
    RUN_TEST(test_a_bridge_that_comes_on_cancels_the_storing);
    RUN_TEST(test_the_loader_has_the_stored_line_and_address_and_stores_nothing);
    RUN_TEST(test_silence_follows_the_baud_rate);
    return UNITY_END();
}
