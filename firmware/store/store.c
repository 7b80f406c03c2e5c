/* SPDX-License-Identifier: MIT */
#include "store.h"

#include <stddef.h>

#include "board.h"
#include "crc32.h"

/* Word offsets in the head. */
enum {
    HEAD_MARK     = 0,
    HEAD_REPLACED = (BOARD_STORE_GRAIN == 1U) ? 0 : (int)BOARD_STORE_GRAIN,
    HEAD_KIND     = (BOARD_STORE_GRAIN == 1U) ? 1 : (2 * (int)BOARD_STORE_GRAIN),
    HEAD_COUNT_HI,
    HEAD_COUNT_LO,
    HEAD_NUMBER_HI,
    HEAD_NUMBER_LO,
    HEAD_CRC_HI,
    HEAD_CRC_LO
};

#define SUMMED_WORDS ((uint32_t)(HEAD_CRC_HI - HEAD_KIND)) /* head words covered by the CRC */

/* A slot, by its mark and its CRC. */
typedef struct {
    store_content_t content; /* words NULL: not whole */
    bool            committed;
    bool            replaced;
} slot_t;

/* Both slots of a kind. */
typedef struct {
    store_content_t content; /* newest in force; without one, newest of those that were replaced */
    uint16_t        slot;    /* of the content; without any, the first */
    bool            in_force;
    bool            lost;
} slots_t;

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

/* A mark with one flipped bit is still that mark: no two of them differ in less than seven. */
static bool is_mark(uint16_t word, uint16_t mark)
{
    const uint16_t differs = (uint16_t)(word ^ mark);

    return (differs & (uint16_t)(differs - 1U)) == 0U;
}

static bool is_committed(const uint16_t *head)
{
    return is_mark(head[HEAD_MARK], STORE_MARK) && !is_mark(head[HEAD_REPLACED], STORE_REPLACED);
}

/* The content of a slot; words is NULL unless its CRC is right. */
static store_content_t whole(store_kind_t kind, uint16_t slot)
{
    const store_content_t nothing = {.words = NULL, .count = 0UL, .number = 0UL};
    const uint16_t *const head    = board_store(slot);
    const store_content_t found   = {.words  = &head[STORE_HEAD_WORDS],
                                     .count  = pair(&head[HEAD_COUNT_HI]),
                                     .number = pair(&head[HEAD_NUMBER_HI])};
    const bool ok = (head[HEAD_KIND] == (uint16_t)kind) && (found.count <= store_room()) &&
                    (store_crc(kind, &found) == pair(&head[HEAD_CRC_HI]));

    return ok ? found : nothing;
}

static slot_t look(store_kind_t kind, uint16_t slot)
{
    const slot_t          empty = {.committed = false, .replaced = false};
    const uint16_t *const head  = board_store(slot);
    slot_t                s     = empty;

    if (head != NULL) {
        s.committed = is_committed(head);
        s.replaced  = is_mark(head[HEAD_REPLACED], STORE_REPLACED);
        if (s.committed || s.replaced) {
            s.content = whole(kind, slot);
        }
    }
    return s;
}

/* Sequence numbers wrap (serial arithmetic): `b` is newer when it is at most half the range ahead
 * of `a`. Equal is not. */
static bool is_newer(uint32_t b, uint32_t a)
{
    return (uint32_t)(b - a - 1UL) < 0x7FFFFFFFUL;
}

/* 0 means that there is no content. */
static uint32_t next_number(uint32_t number)
{
    return (number == 0xFFFFFFFFUL) ? 1UL : (number + 1UL);
}

/* The newer content of the two, or of the one that is whole; the first if their numbers are
 * equal. */
static void take(slots_t *s, const slot_t *a, bool use_a, const slot_t *b, bool use_b)
{
    const bool b_wins = use_b && (!use_a || is_newer(b->content.number, a->content.number));

    if (use_a || use_b) {
        s->content = b_wins ? b->content : a->content;
        s->slot    = (uint16_t)(s->slot + (b_wins ? 1U : 0U));
    }
}

static slots_t find(store_kind_t kind)
{
    const uint16_t first  = first_slot(kind);
    const slot_t   a      = look(kind, first);
    const slot_t   b      = look(kind, (uint16_t)(first + 1U));
    const bool     have_a = a.content.words != NULL;
    const bool     have_b = b.content.words != NULL;
    slots_t        s      = {.slot = first, .in_force = false, .lost = false};

    s.in_force = (have_a && a.committed) || (have_b && b.committed);
    if (s.in_force) {
        take(&s, &a, have_a && a.committed, &b, have_b && b.committed);
    } else {
        take(&s, &a, have_a, &b, have_b);
    }
    s.lost = (a.committed && !have_a) || (b.committed && !have_b) ||
             (!s.in_force && (s.content.words != NULL));
    return s;
}

store_content_t store_newest(store_kind_t kind)
{
    const slots_t   s     = find(kind);
    store_content_t found = s.content;

    if ((found.words == NULL) || (found.count == 0UL)) { /* none, or store_forget() */
        found.words = NULL;
        found.count = 0UL;
    }
    //@ split found.count == 0;
    found.lost = s.lost;
    return found;
}

uint32_t store_writes(store_kind_t kind)
{
    return find(kind).content.number;
}

/* Takes the mark of a slot that has one: its content counts no more. */
static bool retire(uint16_t slot)
{
    const uint16_t mark = STORE_REPLACED;

    return !is_committed(board_store(slot)) || board_store_program(slot, HEAD_REPLACED, &mark, 1U);
}

bool store_begin(store_write_t *w, store_kind_t kind, uint32_t count)
{
    const slots_t  s     = find(kind);
    const uint16_t other = (uint16_t)((2U * first_slot(kind)) + 1U - s.slot);

    w->kind   = kind;
    w->slot   = (s.content.words == NULL) ? s.slot : other;
    w->count  = (count <= store_room()) ? count : 0UL;
    w->number = next_number(s.content.number);
    return (count <= store_room()) && (store_room() > 0UL) && retire(w->slot) &&
           board_store_erase(w->slot);
}

#if BOARD_STORE_GRAIN == 1U

static bool put(const store_write_t *w, uint32_t offset, const uint16_t *words, uint16_t count)
{
    return board_store_program(w->slot, STORE_HEAD_WORDS + offset, words, count);
}

#else

/* Words of a grain that is not complete yet. */
static uint16_t grain[BOARD_STORE_GRAIN];

/* Writes a grain with its last word, or with that of the content. */
static bool put(const store_write_t *w, uint32_t offset, const uint16_t *words, uint16_t count)
{
    bool ok = true;

    for (uint16_t n = 0U; ok && (n < count); n++) {
        const uint32_t at = offset + n;
        const uint16_t in = (uint16_t)(at % BOARD_STORE_GRAIN);

        grain[in] = words[n];
        if (((in + 1U) == BOARD_STORE_GRAIN) || ((at + 1UL) == w->count)) {
            ok = board_store_program(w->slot, (STORE_HEAD_WORDS + at) - in, grain,
                                     (uint16_t)(in + 1U));
        }
    }
    return ok;
}

#endif

bool store_put(const store_write_t *w, uint32_t offset, const uint16_t *words, uint16_t count)
{
    return (offset <= w->count) && ((uint32_t)count <= (w->count - offset)) &&
           put(w, offset, words, count);
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
    const bool ok     = board_store_program(w->slot, HEAD_KIND, &head[HEAD_KIND],
                                            (uint16_t)(HEAD_CRC_LO - HEAD_KIND + 1)) &&
                    board_store_program(w->slot, HEAD_MARK, &head[HEAD_MARK], 1U) &&
                    (look(w->kind, w->slot).content.words != NULL);

    if (ok) { /* the newer number counts, even if this fails */
        (void)retire((uint16_t)((2U * first_slot(w->kind)) + 1U - w->slot));
    }
    return ok;
}

bool store_write(store_kind_t kind, const uint16_t *words, uint32_t count)
{
    store_write_t w;
    bool          ok = store_begin(&w, kind, count);

    for (uint32_t at = 0UL; ok && (at < count); at++) {
        const uint16_t word = words[at]; /* flash cannot be read while it is written */
        ok                  = store_put(&w, at, &word, 1U);
    }
    return ok && store_commit(&w);
}

bool store_forget(store_kind_t kind)
{
    const store_content_t newest = store_newest(kind);

    return ((newest.words == NULL) && !newest.lost) || store_write(kind, NULL, 0UL);
}
