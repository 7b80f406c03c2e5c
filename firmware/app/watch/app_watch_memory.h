/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_memory.h
 * @brief Checks in the background that constants in RAM keep their start values.
 *
 * It forms Fletcher's two sums over the characters of each block, some characters in every pass.
 * Any single flipped bit changes the first sum. A character has 8 bits on a host and 16 on the
 * C28x.
 */
#ifndef APP_WATCH_MEMORY_H
#define APP_WATCH_MEMORY_H

#include "app_options.h"
#include "base.h"

#define APP_WATCH_MEMORY_BLOCKS (4 + APP_BELIEVE)
/** Characters per pass. Chosen: 64 take 10 us; the shipped drive's 700 words take a dozen
 * passes. */
#define APP_WATCH_MEMORY_CHARS 64UL

typedef struct {
    const unsigned char *first;
    uint32_t             chars;
    uint32_t             sums; /**< at the start */
} app_watch_memory_block_t;

typedef struct {
    app_watch_memory_block_t block[APP_WATCH_MEMORY_BLOCKS];
    uint16_t                 blocks;
    uint16_t                 now;  /**< block that is being summed */
    uint32_t                 next; /**< its next character */
    uint32_t                 sums; /**< so far */
} app_watch_memory_t;

/** Removes all blocks. Context: init. */
void app_watch_memory_reset(app_watch_memory_t *w);

/** Adds a block with its present content. Ignored above APP_WATCH_MEMORY_BLOCKS. Context: init. */
void app_watch_memory_add(app_watch_memory_t *w, const void *first, uint32_t chars);

/** Takes the present content of the block that begins at `first`. Context: its writer. */
void app_watch_memory_renew(app_watch_memory_t *w, const void *first);

/** Sums the next characters. @return false: a completed block has changed. Context: background. */
bool app_watch_memory_pass(app_watch_memory_t *w);

#endif /* APP_WATCH_MEMORY_H */
