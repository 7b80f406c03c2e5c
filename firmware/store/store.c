/* SPDX-License-Identifier: MIT */
#include "store.h"

#include <stddef.h>

#include "board.h"
#include "crc32.h"

/* Word offsets in the head. */
enum {
    HEAD_MARK = 0,
    HEAD_KIND,
    HEAD_COUNT_HI,
    HEAD_COUNT_LO,
    HEAD_NUMBER_HI,
    HEAD_NUMBER_LO,
    HEAD_CRC_HI,
    HEAD_CRC_LO
};

#define SUMMED_WORDS ((uint32_t)(HEAD_CRC_HI - HEAD_KIND)) /* head words covered by the CRC */

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

static uint16_t first_slot(store_kind_t kind)
{
    return (uint16_t)((2U * (uint16_t)kind) - 2U);
}

static void make_head(uint16_t *head, store_kind_t kind, uint32_t count, uint32_t number)
{
    head[HEAD_MARK]      = STORE_MARK;
    head[HEAD_KIND]      = (uint16_t)kind;
    head[HEAD_COUNT_HI]  = high(count);
    head[HEAD_COUNT_LO]  = low(count);
    head[HEAD_NUMBER_HI] = high(number);
    head[HEAD_NUMBER_LO] = low(number);
}

uint32_t store_room(void)
{
    return (board_store(0U) == NULL) ? 0UL : (uint32_t)(BOARD_STORE_WORDS - STORE_HEAD_WORDS);
}

uint32_t store_crc(store_kind_t kind, const store_content_t *content)
{
    uint16_t head[STORE_HEAD_WORDS];

    make_head(head, kind, content->count, content->number);
    return crc32_words(crc32_words(CRC32_START, &head[HEAD_KIND], SUMMED_WORDS), content->words,
                       content->count);
}

static store_content_t look(store_kind_t kind, uint16_t slot)
{
    const store_content_t nothing = {.words = NULL, .count = 0UL, .number = 0UL};
    const uint16_t *const head    = board_store(slot);

    if ((head == NULL) || (head[HEAD_MARK] != STORE_MARK) || (head[HEAD_KIND] != (uint16_t)kind)) {
        return nothing;
    }
    const store_content_t found = {.words  = &head[STORE_HEAD_WORDS],
                                   .count  = pair(&head[HEAD_COUNT_HI]),
                                   .number = pair(&head[HEAD_NUMBER_HI])};
    if ((found.count > store_room()) || (store_crc(kind, &found) != pair(&head[HEAD_CRC_HI]))) {
        return nothing;
    }
    return found;
}

/* Sequence numbers wrap (serial arithmetic): `b` is newer when it is at most half the range ahead of `a`. Equal is not. */
static bool is_newer(uint32_t b, uint32_t a)
{
    return (uint32_t)(b - a - 1UL) < 0x7FFFFFFFUL;
}

/* 0 means that there is no content. */
static uint32_t next_number(uint32_t number)
{
    return (number == 0xFFFFFFFFUL) ? 1UL : (number + 1UL);
}

/* Newest valid content of a kind and its slot. Without any, words is NULL and slot is the first. */
static store_content_t find(store_kind_t kind, uint16_t *slot)
{
    const uint16_t        first = first_slot(kind);
    const store_content_t a     = look(kind, first);
    const store_content_t b     = look(kind, (uint16_t)(first + 1U));
    const bool use_b = (b.words != NULL) && ((a.words == NULL) || is_newer(b.number, a.number));

    *slot = use_b ? (uint16_t)(first + 1U) : first;
    return use_b ? b : a;
}

store_content_t store_newest(store_kind_t kind)
{
    uint16_t slot = 0U;

    return find(kind, &slot);
}

bool store_begin(store_write_t *w, store_kind_t kind, uint32_t count)
{
    uint16_t              slot   = 0U;
    const store_content_t newest = find(kind, &slot);

    w->kind   = kind;
    w->slot   = (newest.words == NULL) ? slot : (uint16_t)((2U * first_slot(kind)) + 1U - slot);
    w->count  = count;
    w->number = next_number(newest.number);
    return (count <= store_room()) && board_store_erase(w->slot);
}

bool store_put(const store_write_t *w, uint32_t offset, const uint16_t *words, uint16_t count)
{
    return (offset <= w->count) && ((uint32_t)count <= (w->count - offset)) &&
           board_store_program(w->slot, STORE_HEAD_WORDS + offset, words, count);
}

store_content_t store_written(const store_write_t *w)
{
    const store_content_t content = {
        .words = &board_store(w->slot)[STORE_HEAD_WORDS], .count = w->count, .number = w->number};
    return content;
}

bool store_commit(const store_write_t *w)
{
    const store_content_t content = store_written(w);
    const uint32_t        crc     = store_crc(w->kind, &content);
    uint16_t              head[STORE_HEAD_WORDS];

    make_head(head, w->kind, w->count, w->number);
    head[HEAD_CRC_HI] = high(crc);
    head[HEAD_CRC_LO] = low(crc);
    return board_store_program(w->slot, HEAD_KIND, &head[HEAD_KIND],
                               (uint16_t)(STORE_HEAD_WORDS - HEAD_KIND)) &&
           board_store_program(w->slot, HEAD_MARK, &head[HEAD_MARK], 1U) &&
           (look(w->kind, w->slot).words != NULL);
}

bool store_forget(store_kind_t kind)
{
    uint16_t              slot   = 0U;
    const store_content_t newest = find(kind, &slot);
    const uint16_t        other  = (uint16_t)((2U * first_slot(kind)) + 1U - slot);

    /* Erase the older slot first: a power cut between the two then leaves the newest content. */
    return board_store_erase(other) && ((newest.words == NULL) || board_store_erase(slot));
}
