/* SPDX-License-Identifier: MIT */
#include "app_watch_memory.h"

#define LOW_SUM 0xFFFFUL

/* Both sums modulo 2^16, the second one in the upper half. */
static uint32_t summed(uint32_t sums, const unsigned char *from, uint32_t chars)
{
    uint32_t first  = sums & LOW_SUM;
    uint32_t second = sums >> 16;

    for (uint32_t n = 0UL; n < chars; n++) {
        first  = (first + (uint32_t)from[n]) & LOW_SUM;
        second = (second + first) & LOW_SUM;
    }
    return (second << 16) | first;
}

void app_watch_memory_reset(app_watch_memory_t *w)
{
    w->blocks = 0U;
    w->now    = 0U;
    w->next   = 0UL;
    w->sums   = 0UL;
}

void app_watch_memory_add(app_watch_memory_t *w, const void *first, uint32_t chars)
{
    if (w->blocks < (uint16_t)APP_WATCH_MEMORY_BLOCKS) {
        app_watch_memory_block_t *b = &w->block[w->blocks];

        b->first  = first;
        b->chars  = chars;
        b->sums   = summed(0UL, b->first, chars);
        w->blocks = (uint16_t)(w->blocks + 1U);
    }
}

void app_watch_memory_renew(app_watch_memory_t *w, const void *first)
{
    for (uint16_t n = 0U; n < w->blocks; n++) {
        app_watch_memory_block_t *b = &w->block[n];

        if (b->first == first) {
            b->sums = summed(0UL, b->first, b->chars);
        }
    }
    w->next = 0UL; /* the pass through the present block begins anew */
    w->sums = 0UL;
}

bool app_watch_memory_pass(app_watch_memory_t *w)
{
    if (w->now >= w->blocks) {
        return true;
    }
    const app_watch_memory_block_t *b    = &w->block[w->now];
    const uint32_t                  left = (w->next < b->chars) ? (b->chars - w->next) : 0UL;
    const uint32_t chars = (left < APP_WATCH_MEMORY_CHARS) ? left : APP_WATCH_MEMORY_CHARS;

    w->sums = summed(w->sums, &b->first[w->next], chars);
    w->next += chars;
    if (w->next < b->chars) {
        return true;
    }
    const bool same = w->sums == b->sums;
    w->sums         = 0UL;
    w->next         = 0UL;
    w->now          = ((w->now + 1U) < w->blocks) ? (uint16_t)(w->now + 1U) : 0U;
    return same;
}
