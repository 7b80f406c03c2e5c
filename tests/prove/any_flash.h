/* SPDX-License-Identifier: MIT */
/**
 * @file any_flash.h
 * @brief A flash of any contents: erased or written it holds anything afterwards, and both may fail.
 */
#ifndef ANY_FLASH_H
#define ANY_FLASH_H

#include <stddef.h>

#include "any.h"
#include "board.h"

uint16_t flash[BOARD_STORE_SLOTS][BOARD_STORE_WORDS];

const uint16_t *board_store(uint16_t slot)
{
    return (slot < (uint16_t)BOARD_STORE_SLOTS) ? flash[slot] : NULL;
}

static void spoil(uint16_t slot)
{
    for (uint32_t n = 0U; n < BOARD_STORE_WORDS; n++) {
        flash[slot][n] = any_word;
    }
}

bool board_store_erase(uint16_t slot)
{
    //@ check known_to_erase: slot < 4;
    spoil(slot);
    return any_bool();
}

bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *from, uint16_t count)
{
    //@ check known_to_write: slot < 4;
    uint16_t read = 0U;

    for (uint16_t n = 0U; n < count; n++) {
        read |= from[n];
    }
    (void)offset;
    spoil(slot);
    return (read != 0U) || any_bool();
}

#endif /* ANY_FLASH_H */
