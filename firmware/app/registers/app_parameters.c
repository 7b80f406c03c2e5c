/* SPDX-License-Identifier: MIT */
#include "app_parameters.h"

#include <stddef.h>

#include "app_registers.h"
#include "crc32.h"

/* Layout of the words that survive the restart. */
#define KEPT_MARK    0U
#define KEPT_COMMAND 1U
#define KEPT_CRC     2U /* two words */
#define KEPT_RECORD  4U

#define MARK          0x9A7AU /* chosen */
#define VERSION_WORDS 2U
#define RECORD_WORDS  (VERSION_WORDS + APP_REGISTERS_SAVED_WORDS)

#if (KEPT_RECORD + VERSION_WORDS + APP_REGISTERS_SAVED_WORDS) > BOARD_KEPT_WORDS
#error "the parameters do not fit the words that outlast a restart"
#endif

static void put_two(uint16_t *words, uint32_t x)
{
    words[0] = (uint16_t)(x >> 16);
    words[1] = (uint16_t)(x & 0xFFFFUL);
}

static uint32_t two(const uint16_t *words)
{
    return ((uint32_t)words[0] << 16) | words[1];
}

void app_parameters_take(app_parameters_t *p, app_registers_t *r, app_parameters_done_t done)
{
    const store_content_t stored = store_newest(STORE_PARAMETERS);

    p->done   = done;
    p->number = 0UL;
    if (stored.words == NULL) {
        p->state = APP_PARAMETERS_DEFAULT;
    } else if ((stored.count != RECORD_WORDS) ||
               (two(stored.words) != APP_REGISTERS_SAVED_VERSION)) {
        p->state = APP_PARAMETERS_OTHER_VERSION;
    } else if (!app_registers_saved_take(r, &stored.words[VERSION_WORDS])) {
        p->state = APP_PARAMETERS_OUT_OF_RANGE;
    } else {
        p->state  = APP_PARAMETERS_STORED;
        p->number = stored.number;
    }
    r->parameters = p;
}

/* CRC of command and record. */
static uint32_t kept_crc(const uint16_t *kept)
{
    return crc32_words(crc32_words(CRC32_START, &kept[KEPT_COMMAND], 1UL), &kept[KEPT_RECORD],
                       RECORD_WORDS);
}

void app_parameters_ask(const app_registers_t *r, app_parameters_command_t command)
{
    uint16_t *const kept = board_kept();

    kept[KEPT_COMMAND] = (uint16_t)command;
    put_two(&kept[KEPT_RECORD], APP_REGISTERS_SAVED_VERSION);
    app_registers_saved_read(r, &kept[KEPT_RECORD + VERSION_WORDS]);
    put_two(&kept[KEPT_CRC], kept_crc(kept));
    kept[KEPT_MARK] = MARK;
}

static bool store_record(const uint16_t *record)
{
    const uint16_t count = RECORD_WORDS;
    store_write_t  w;

    return store_begin(&w, STORE_PARAMETERS, count) && store_put(&w, 0UL, record, count) &&
           store_commit(&w);
}

app_parameters_done_t app_parameters_work(void)
{
    uint16_t *const kept  = board_kept();
    const bool      asked = (kept[KEPT_MARK] == MARK) && (two(&kept[KEPT_CRC]) == kept_crc(kept));
    bool            ok    = false;

    kept[KEPT_MARK] = 0U; /* executes only once */
    if (asked && (kept[KEPT_COMMAND] == (uint16_t)APP_PARAMETERS_STORE)) {
        ok = store_record(&kept[KEPT_RECORD]);
    } else if (asked) {
        ok = store_forget(STORE_PARAMETERS);
    } else {
        /* nothing to do */
    }
    const app_parameters_done_t done = ok ? APP_PARAMETERS_DONE : APP_PARAMETERS_FLASH;
    return asked ? done : APP_PARAMETERS_NOT_ASKED;
}
