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

#define MARK          0x9A7AU      /* chosen */
#define FORMAT        0x50415232UL /* chosen */
#define VERSION_WORDS 2U
#define RECORD_WORDS  (VERSION_WORDS + (APP_REGISTERS_SAVED * APP_REGISTERS_SAVED_EACH))
#define MOST_WORDS    (VERSION_WORDS + (64U * APP_REGISTERS_SAVED_EACH)) /* chosen */

#define KEPT_WRITES  (KEPT_RECORD + RECORD_WORDS) /* since power-on; then its complement */
#define KEPT_INVERSE (KEPT_WRITES + 1U)

#if (KEPT_INVERSE + 1U) > BOARD_KEPT_WORDS
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

/* Writes since power-on, which leaves any bits in these words. */
static uint16_t burst(void)
{
    const uint16_t *const kept = board_kept();

    return ((kept[KEPT_WRITES] ^ kept[KEPT_INVERSE]) == 0xFFFFU) ? kept[KEPT_WRITES] : 0U;
}

static void count_burst(void)
{
    uint16_t *const kept = board_kept();
    const uint16_t  now  = burst();

    kept[KEPT_WRITES]  = (uint16_t)(now + ((now < APP_PARAMETERS_BURST) ? 1U : 0U));
    kept[KEPT_INVERSE] = (uint16_t)(kept[KEPT_WRITES] ^ 0xFFFFU);
}

/* Parameters of a record of this format. */
static app_parameters_state_t take_each(app_registers_t *r, const uint16_t *words, uint16_t count,
                                        uint16_t *dropped)
{
    app_parameters_state_t state = APP_PARAMETERS_OUT_OF_RANGE;

    if (app_registers_saved_take(r, words, count, dropped)) {
        state = (*dropped > 0U) ? APP_PARAMETERS_PARTLY : APP_PARAMETERS_STORED;
    }
    return state;
}

static app_parameters_state_t take_record(app_registers_t *r, const store_content_t *stored,
                                          uint16_t *dropped)
{
    const uint32_t         words = stored->count;
    app_parameters_state_t state = APP_PARAMETERS_OTHER_VERSION;

    if (stored->words == NULL) {
        state = APP_PARAMETERS_DEFAULT;
    } else if ((words >= VERSION_WORDS) && (words <= MOST_WORDS) &&
               (two(stored->words) == FORMAT) &&
               (((words - VERSION_WORDS) % APP_REGISTERS_SAVED_EACH) == 0U)) {
        state = take_each(r, &stored->words[VERSION_WORDS],
                          (uint16_t)((words - VERSION_WORDS) / APP_REGISTERS_SAVED_EACH), dropped);
    } else {
        /* another format */
    }
    return state;
}

void app_parameters_take(app_parameters_t *p, app_registers_t *r, app_parameters_done_t done)
{
    const store_content_t        stored  = store_newest(STORE_PARAMETERS);
    uint16_t                     dropped = 0U;
    const app_parameters_state_t state   = take_record(r, &stored, &dropped);
    const bool in_use = (state == APP_PARAMETERS_STORED) || (state == APP_PARAMETERS_PARTLY);

    p->done       = done;
    p->number     = in_use ? stored.number : 0UL;
    p->dropped    = in_use ? dropped : 0U;
    p->state      = stored.lost ? APP_PARAMETERS_LOST : state;
    p->writes     = store_writes(STORE_PARAMETERS);
    p->rested     = burst() < APP_PARAMETERS_BURST;
    r->parameters = p;
}

void app_parameters_rest(app_parameters_t *p, float since_start_s)
{
    p->rested = p->rested || (since_start_s > APP_PARAMETERS_REST_s);
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
    put_two(&kept[KEPT_RECORD], FORMAT);
    app_registers_saved_read(r, &kept[KEPT_RECORD + VERSION_WORDS]);
    put_two(&kept[KEPT_CRC], kept_crc(kept));
    kept[KEPT_MARK] = MARK;
}

/* Stores the fall-backs as the last contents. */
static bool accept(app_image_t *in_force)
{
    const store_content_t stored = store_newest(STORE_PARAMETERS);
    const bool            image  = app_image_accept(in_force);

    return (!stored.lost || store_write(STORE_PARAMETERS, stored.words, stored.count)) && image;
}

app_parameters_done_t app_parameters_work(app_image_t *in_force)
{
    uint16_t *const kept  = board_kept();
    const bool      asked = (kept[KEPT_MARK] == MARK) && (two(&kept[KEPT_CRC]) == kept_crc(kept));
    bool            ok    = false;

    kept[KEPT_MARK] = 0U; /* executes only once */
    if (!asked) {
        return APP_PARAMETERS_NOT_ASKED;
    }
    count_burst();
    if (kept[KEPT_COMMAND] == (uint16_t)APP_PARAMETERS_STORE) {
        ok = store_write(STORE_PARAMETERS, &kept[KEPT_RECORD], RECORD_WORDS);
    } else if (kept[KEPT_COMMAND] == (uint16_t)APP_PARAMETERS_ACCEPT) {
        ok = accept(in_force);
    } else {
        ok = store_forget(STORE_PARAMETERS);
    }
    return ok ? APP_PARAMETERS_DONE : APP_PARAMETERS_FLASH;
}
