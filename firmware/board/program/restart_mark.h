/* SPDX-License-Identifier: MIT */
/**
 * @file restart_mark.h
 * @brief Two words that survive a reset and ask for the loader.
 */
#ifndef RESTART_MARK_H
#define RESTART_MARK_H

#include <stdbool.h>
#include <stdint.h>

/* Chosen. Random memory after power-on holds this and its complement once in 2^64. */
#define RESTART_MARK_LOADER     0x10ADE401UL
#define RESTART_MARK_COMPLEMENT (RESTART_MARK_LOADER ^ 0xFFFFFFFFUL)

/** Asks for the loader, or for the program. Context: init, background. */
static inline void restart_mark_set(volatile uint32_t mark[2], bool loader)
{
    mark[0] = loader ? RESTART_MARK_LOADER : 0UL;
    mark[1] = loader ? RESTART_MARK_COMPLEMENT : 0UL;
}

/** True: the loader was asked for. The request is used up. Context: init. */
static inline bool restart_mark_take(volatile uint32_t mark[2])
{
    const bool first  = mark[0] == RESTART_MARK_LOADER;
    const bool second = mark[1] == RESTART_MARK_COMPLEMENT;

    restart_mark_set(mark, false);
    return first && second;
}

#endif /* RESTART_MARK_H */
