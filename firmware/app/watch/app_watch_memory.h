/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_memory.h
 * @brief The background's look at constants in RAM: whether they are what they were at the start.
 *
 * Fletcher's two sums over the characters of each block, some characters in every pass; any one flipped bit changes the
 * first sum. A character has 8 bits on a host and 16 on the C28x.
 */
#ifndef APP_WATCH_MEMORY_H
#define APP_WATCH_MEMORY_H

#include "base.h"

#define APP_WATCH_MEMORY_BLOCKS 4
/** Characters per pass. Chosen: 64 take 10 us; the shipped drive's 700 words are through after a dozen passes. */
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

/** No blocks. Context: init. */
void app_watch_memory_reset(app_watch_memory_t *w);

/** Watch this one from now on, as it is now; beyond APP_WATCH_MEMORY_BLOCKS nothing happens. Context: init. */
void app_watch_memory_add(app_watch_memory_t *w, const void *first, uint32_t chars);

/** The next characters. @return false: a block that was finished now is not what it was. Context: background. */
bool app_watch_memory_pass(app_watch_memory_t *w);

#endif /* APP_WATCH_MEMORY_H */
