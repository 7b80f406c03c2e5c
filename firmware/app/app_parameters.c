/* SPDX-License-Identifier: MIT */
#include "app_parameters.h"

#include <stddef.h>

#include "app_registers.h"
#include "crc32.h"

/* The words that outlast the restart. */
enum { KEPT_MARK = 0, KEPT_COMMAND, KEPT_CRC_HI, KEPT_CRC_LO, KEPT_RECORD };

#define MARK          0x9A7AU /* chosen */
#define VERSION_WORDS 2U
#define RECORD_WORDS  (VERSION_WORDS + APP_REGISTERS_SAVED_WORDS)

#if (4U + 2U + APP_REGISTERS_SAVED_WORDS) > BOARD_KEPT_WORDS
#error "the parameters do not fit the words that outlast a restart"
#endif

static uint16_t high(uint32_t x)
{
    return (uint16_t)(x >> 16);
}

static uint16_t low(uint32_t x)
{
    return (uint16_t)(x & 0xFFFFUL);
}

static uint32_t pair(const uint16_t *words)
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
               (pair(stored.words) != APP_REGISTERS_SAVED_VERSION)) {
        p->state = APP_PARAMETERS_OTHER_VERSION;
    } else if (!app_registers_saved_take(r, &stored.words[VERSION_WORDS])) {
        p->state = APP_PARAMETERS_OUT_OF_RANGE;
    } else {
        p->state  = APP_PARAMETERS_STORED;
        p->number = stored.number;
    }
    r->parameters = p;
}

/* Of command and record. */
static uint32_t crc_of(const uint16_t *kept)
{
    return crc32_words(crc32_words(CRC32_START, &kept[KEPT_COMMAND], 1UL), &kept[KEPT_RECORD],
                       RECORD_WORDS);
}

void app_parameters_ask(const app_registers_t *r, app_parameters_command_t command)
{
    uint16_t *const kept = board_kept();

    kept[KEPT_COMMAND]     = (uint16_t)command;
    kept[KEPT_RECORD]      = high(APP_REGISTERS_SAVED_VERSION);
    kept[KEPT_RECORD + 1U] = low(APP_REGISTERS_SAVED_VERSION);
    app_registers_saved_read(r, &kept[KEPT_RECORD + VERSION_WORDS]);
    const uint32_t crc = crc_of(kept);
    kept[KEPT_CRC_HI]  = high(crc);
    kept[KEPT_CRC_LO]  = low(crc);
    kept[KEPT_MARK]    = MARK;
}

static bool write(const uint16_t *record)
{
    store_write_t w;

    return store_begin(&w, STORE_PARAMETERS, RECORD_WORDS) &&
           store_put(&w, 0UL, record, (uint16_t)RECORD_WORDS) && store_commit(&w);
}

app_parameters_done_t app_parameters_work(void)
{
    uint16_t *const kept  = board_kept();
    const bool      asked = (kept[KEPT_MARK] == MARK) && (pair(&kept[KEPT_CRC_HI]) == crc_of(kept));
    bool            ok    = false;

    kept[KEPT_MARK] = 0U; /* once */
    if (!asked) {
        return APP_PARAMETERS_NOT_ASKED;
    }
    if (kept[KEPT_COMMAND] == (uint16_t)APP_PARAMETERS_STORE) {
        ok = write(&kept[KEPT_RECORD]);
    } else {
        ok = store_forget(STORE_PARAMETERS);
    }
    return ok ? APP_PARAMETERS_DONE : APP_PARAMETERS_FLASH;
}
