/* SPDX-License-Identifier: MIT */
#include "app_loader.h"

#include <stddef.h>

#include "crc32.h"

static uint32_t pair(const uint16_t *words)
{
    return ((uint32_t)words[0] << 16) | words[1];
}

static void put_pair(uint16_t *words, uint32_t x)
{
    words[0] = (uint16_t)(x >> 16);
    words[1] = (uint16_t)(x & 0xFFFFUL);
}

static void put_float(uint16_t *words, float x)
{
    fields_t f = fields_writer(words, 2UL);

    fields_float(&f, &x);
}

/* The next character of a text, and zeros behind its end. */
static uint16_t next_octet(const char **text)
{
    const uint16_t octet = (uint16_t)((uint16_t) * *text & 0x7FU);

    if (octet != 0U) {
        *text = &(*text)[1];
    }
    return octet;
}

/* The registers from APP_LOADER_FIELD on. */
static void put_board(uint16_t *words, const app_image_t *image)
{
    const board_difference_t *const d    = &image->difference;
    const char                     *name = board_field_name(d->field);

    words[0] = d->field;
    put_float(&words[APP_LOADER_IMAGE_HI - APP_LOADER_FIELD], d->image);
    put_float(&words[APP_LOADER_BOARD_HI - APP_LOADER_FIELD], d->board);
    for (uint16_t n = 0U; n < (uint16_t)APP_LOADER_NAME_WORDS; n++) {
        const uint16_t high                                   = next_octet(&name);
        const uint16_t low                                    = next_octet(&name);
        words[(APP_LOADER_FIELD_NAME - APP_LOADER_FIELD) + n] = (uint16_t)((high << 8) | low);
    }
    put_pair(&words[APP_LOADER_SUM_HI - APP_LOADER_FIELD], image->board->sum);
}

void app_loader_init(app_loader_t *l, const app_image_t *in_force)
{
    const app_loader_t none = {.state = APP_LOADER_AWAY};

    *l          = none;
    l->in_force = in_force;
    l->fallback = in_force->fallback;
    l->number   = in_force->number;
    l->law      = in_force->image.drive.law->number;
}

static bool exist(uint16_t first, uint16_t count, uint16_t all)
{
    return (first < all) && (count <= (uint16_t)(all - first));
}

bool app_loader_read(const app_loader_t *l, uint16_t first, uint16_t count, uint16_t *values)
{
    uint16_t all[APP_LOADER_INPUT_COUNT];

    if (!exist(first, count, (uint16_t)APP_LOADER_INPUT_COUNT)) {
        return false;
    }
    all[APP_LOADER_STATE]  = (uint16_t)l->state;
    all[APP_LOADER_REASON] = (uint16_t)l->in_force->result;
    put_pair(&all[APP_LOADER_PUT_HI], l->put_words);
    put_pair(&all[APP_LOADER_ROOM_HI], store_room());
    all[APP_LOADER_LAW] = l->law;
    put_pair(&all[APP_LOADER_NUMBER_HI], l->number);
    put_board(&all[APP_LOADER_FIELD], l->in_force);
    for (uint16_t at = 0U; at < (uint16_t)APP_LOADER_INPUT_COUNT; at++) {
        const uint16_t n = (uint16_t)(at - first); /* below the first one: very large */
        if (n < count) {
            values[n] = all[at];
        }
    }
    return true;
}

bool app_loader_read_holding(uint16_t first, uint16_t count, uint16_t *values)
{
    if (!exist(first, count, (uint16_t)APP_LOADER_HOLDING_COUNT)) {
        return false;
    }
    for (uint16_t n = 0U; n < count; n++) {
        values[n] = 0U;
    }
    return true;
}

static void begin(app_loader_t *l)
{
    l->put_words     = 0UL;
    l->image->result = DRIVE_IMAGE_OK;
    l->state =
        store_begin(&l->write, STORE_IMAGE, l->count) ? APP_LOADER_WRITING : APP_LOADER_FLASH;
}

static void commit(app_loader_t *l)
{
    const store_content_t content = store_written(&l->write);

    if (crc32_words(CRC32_START, content.words, content.count) != l->crc) {
        l->state = APP_LOADER_SUM;
        return;
    }
    app_image_take(l->image, l->image->image.drive.law, &content);
    if (l->image->result != DRIVE_IMAGE_OK) {
        l->state = APP_LOADER_IMAGE;
        return;
    }
    l->state = store_commit(&l->write) ? APP_LOADER_STORED : APP_LOADER_FLASH;
}

void app_loader_work(app_loader_t *l)
{
    if (l->state != APP_LOADER_BUSY) {
        return;
    }
    if (l->task == APP_LOADER_BEGIN) {
        begin(l);
    } else if (l->task == APP_LOADER_COMMIT) {
        commit(l);
    } else {
        l->state = store_forget(STORE_IMAGE) ? APP_LOADER_STORED : APP_LOADER_FLASH;
    }
}

static void plan(app_loader_t *l, app_loader_command_t task)
{
    l->task  = task;
    l->state = APP_LOADER_BUSY;
}

static void restart(app_loader_t *l, bool into_loader)
{
    l->restart = true;
    l->enter   = into_loader;
}

/* Takes a command with the registers of its arguments. */
static app_loader_result_t command(app_loader_t *l, const uint16_t *values, uint16_t count)
{
    const bool     runs = l->image != NULL; /* the loader, not the application */
    const uint16_t what = values[APP_LOADER_COMMAND];

    if (!runs && (what == (uint16_t)APP_LOADER_ENTER) && (count == 1U)) {
        restart(l, true);
    } else if (runs && (what == (uint16_t)APP_LOADER_BEGIN) && (count == 3U)) {
        l->count = pair(&values[APP_LOADER_COUNT_HI]);
        plan(l, APP_LOADER_BEGIN);
    } else if (runs && (what == (uint16_t)APP_LOADER_COMMIT) && (count == 5U) &&
               (l->state == APP_LOADER_WRITING)) {
        l->crc = pair(&values[APP_LOADER_CRC_HI]);
        plan(l, APP_LOADER_COMMIT);
    } else if (runs && (what == (uint16_t)APP_LOADER_FORGET) && (count == 1U)) {
        plan(l, APP_LOADER_FORGET);
    } else if (runs && (what == (uint16_t)APP_LOADER_LEAVE) && (count == 1U)) {
        restart(l, false);
    } else {
        return APP_LOADER_BAD_VALUE;
    }
    return APP_LOADER_OK;
}

static app_loader_result_t content(app_loader_t *l, const uint16_t *values, uint16_t count)
{
    const uint16_t words = (uint16_t)(count - 2U);

    if ((l->state != APP_LOADER_WRITING) || (pair(values) != l->put_words)) {
        return APP_LOADER_BAD_VALUE; /* ascending, each once: a flash word is written once */
    }
    if (!store_put(&l->write, l->put_words, &values[2], words)) {
        l->state = APP_LOADER_FLASH;
        return APP_LOADER_BAD_VALUE;
    }
    l->put_words += words;
    return APP_LOADER_OK;
}

app_loader_result_t app_loader_write(app_loader_t *l, bool gate_enable, uint16_t first,
                                     uint16_t count, const uint16_t *values)
{
    if (!exist(first, count, (uint16_t)APP_LOADER_HOLDING_COUNT)) {
        return APP_LOADER_BAD_ADDRESS;
    }
    if (gate_enable || l->restart || (l->state == APP_LOADER_BUSY)) {
        return APP_LOADER_BAD_VALUE;
    }
    if (first == (uint16_t)APP_LOADER_COMMAND) {
        return command(l, values, count);
    }
    if ((first == (uint16_t)APP_LOADER_OFFSET_HI) && (count > 2U)) {
        return content(l, values, count);
    }
    return APP_LOADER_BAD_VALUE;
}
