/* SPDX-License-Identifier: MIT */
/**
 * @file store.h
 * @brief Words that outlast a power cut: two flash sectors in turn, so that the old ones stay until the new ones are whole.
 *
 * A sector (board.h calls it a slot) begins with a head:
 *
 *     0        STORE_MARK, written last: without it the slot is empty
 *     1        what the words are, store_kind_t; a reader looks for its own kind only
 *     2, 3     how many there are, high word first, as everywhere here
 *     4, 5     number of the writing; of two whole slots the higher one counts
 *     6, 7     CRC-32 of words 1 to 5 and of the content
 *     8 ..     the content
 *
 * A power cut at any moment leaves the newer slot without mark, or with a mark and whole. Flash is erased to ones and
 * written once; a sector in which an erasure was cut holds anything, which the CRC tells.
 */
#ifndef STORE_H
#define STORE_H

#include <stdbool.h>
#include <stdint.h>

#define STORE_MARK       0x5D2EU /**< chosen; neither erased nor all zero, which a cut erasure leaves */
#define STORE_HEAD_WORDS 8U

/** Kinds of content; each has two slots of its own, 2 kind - 2 and 2 kind - 1. */
typedef enum { STORE_IMAGE = 1, STORE_PARAMETERS } store_kind_t;

/** What is being written. */
typedef struct {
    store_kind_t kind;
    uint16_t     slot;
    uint32_t     count;  /**< words of the content */
    uint32_t     number; /**< of the writing */
} store_write_t;

typedef struct {
    const uint16_t *words; /**< NULL: nothing is there */
    uint32_t        count;
    uint32_t        number; /**< 1 and up */
} store_content_t;

/** Largest content, in words; 0 on a board without a store. */
uint32_t store_room(void);

/** The newest whole content. Context: init, or the loader. */
store_content_t store_newest(store_kind_t kind);

/** Erases the slot that does not hold the newest content. @return false: no room, or the board failed. Context: loader. */
bool store_begin(store_write_t *w, store_kind_t kind, uint32_t count);

/** Writes words of the content from `offset` on; each of them once. @return false: beyond it, or the board failed. */
bool store_put(const store_write_t *w, uint32_t offset, const uint16_t *words, uint16_t count);

/** The content as it is in the flash now, to be looked at before store_commit(). */
store_content_t store_written(const store_write_t *w);

/** CRC-32 of the head that store_commit() would write and of the content. */
uint32_t store_crc(store_kind_t kind, const store_content_t *content);

/** Makes the content the newest. @return false: the board failed; the old content stays in force. Context: loader. */
bool store_commit(const store_write_t *w);

/** Erases both slots. @return false: the board failed. Context: loader. */
bool store_forget(store_kind_t kind);

#endif /* STORE_H */
