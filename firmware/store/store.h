/* SPDX-License-Identifier: MIT */
/**
 * @file store.h
 * @brief Power-fail-safe non-volatile memory: two flash sectors per kind of content.
 *
 * A write goes to the older sector. The newest content stays valid until the write is complete.
 *
 * A sector (a slot in board.h) begins with a head; 32-bit values have the high word first:
 *
 *     0        mark: STORE_MARK is written last; STORE_REPLACED when a newer content is complete
 *     1        kind of content, store_kind_t
 *     2, 3     number of content words; 0: the content was forgotten
 *     4, 5     sequence number from 1, wraps to 1; at most half the range ahead is the newest
 *     6, 7     CRC-32 of words 1 to 5 and of the content
 *     8 ..     the content
 *
 * A flash may write several words at once (BOARD_STORE_GRAIN). Then the mark has the first grain
 * and STORE_REPLACED the second. Words 1 to 7 above begin at the third, the content at the fifth.
 *
 * An erased flash word is 0xFFFF; writing clears bits, erasing sets all of them.
 *
 * | mark           | CRC   | the slot                                                    |
 * |----------------|-------|-------------------------------------------------------------|
 * | STORE_MARK     | right | is in force, if no other slot with this mark is newer       |
 * | STORE_MARK     | wrong | was in force and is damaged: the content is lost            |
 * | STORE_REPLACED | right | was in force before; alone, the content after it is lost    |
 * | STORE_REPLACED | wrong | counts for nothing; an erasure may have been interrupted    |
 * | any other      | any   | counts for nothing; a write was interrupted, or never began |
 *
 * A power cut leaves the old content or the new one, and loses none. A flipped bit changes nothing
 * or loses the content: each mark is still known with one bit wrong.
 */
#ifndef STORE_H
#define STORE_H

#include <stdbool.h>
#include <stdint.h>

#include "board_limits.h"

#define STORE_MARK       0x5D2EU /**< chosen: seven bits from an erased word, nine from zero */
#define STORE_REPLACED   0x0000U /**< follows STORE_MARK by clearing bits */
#define STORE_HEAD_WORDS ((BOARD_STORE_GRAIN == 1U) ? 8U : (4U * BOARD_STORE_GRAIN))

/** Kinds of content. Each kind has two slots: 2 kind - 2 and 2 kind - 1. */
typedef enum { STORE_IMAGE = 1, STORE_PARAMETERS } store_kind_t;

/** A write in progress, from store_begin() to store_commit(). */
typedef struct {
    store_kind_t kind;
    uint16_t     slot;
    uint32_t     count;  /**< words of the content */
    uint32_t     number; /**< sequence number */
} store_write_t;

/** Content in the flash. */
typedef struct {
    const uint16_t *words; /**< NULL: there is no valid content */
    uint32_t        count;
    uint32_t        number; /**< sequence number, from 1; wraps to 1 */
    bool            lost;   /**< store_newest(): not the content that was stored last */
} store_content_t;

/** Largest content [words]; 0: the board has no store. Context: any. */
uint32_t store_room(void);

/**
 * @brief Finds the newest content of a kind.
 *
 * If it is lost, this is what came before it, or nothing. Do not use that without a command.
 *
 * Context: init, or the loader.
 */
store_content_t store_newest(store_kind_t kind);

/** Sequence number of the last write, of a store_forget() too. Context: init, or the loader. */
uint32_t store_writes(store_kind_t kind);

/**
 * @brief Begins a write: erases the slot that does not hold the newest content, or the one before
 * it if that is all there is.
 *
 * @param count Words of the new content.
 * @return false: `count` exceeds store_room(), or the erasure failed.
 *
 * Context: loader. Takes seconds.
 */
bool store_begin(store_write_t *w, store_kind_t kind, uint32_t count);

/**
 * @brief Writes part of the content. Each word may be written once.
 *
 * @param offset Position of the first word in the content. With a BOARD_STORE_GRAIN above one, the
 *               calls follow each other from 0 on.
 * @return false: the words exceed the announced content, or programming failed.
 *
 * Context: loader.
 */
bool store_put(const store_write_t *w, uint32_t offset, const uint16_t *words, uint16_t count);

/** The content as the flash holds it now, for checks before store_commit(). Context: loader. */
store_content_t store_written(const store_write_t *w);

/** CRC-32 over the content and the head that store_commit() writes for it. */
uint32_t store_crc(store_kind_t kind, const store_content_t *content);

/**
 * @brief Completes a write: writes CRC and mark, and reads the content back.
 *
 * @return false: programming failed. The previous content stays valid.
 *
 * Context: loader.
 */
bool store_commit(const store_write_t *w);

/**
 * @brief Writes a content as a whole. It may be in the slot that is not in force.
 *
 * @return false: the flash failed. The previous content stays valid.
 *
 * Context: loader. Takes seconds.
 */
bool store_write(store_kind_t kind, const uint16_t *words, uint32_t count);

/** Stores that there is no content. @return false: the flash failed. Context: loader. */
bool store_forget(store_kind_t kind);

#endif /* STORE_H */
