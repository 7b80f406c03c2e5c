/* SPDX-License-Identifier: MIT */
/* The firmware reads the store; only a programming tool writes it. TI's flash API for this device
 * is a COFF library, which an EABI image cannot link (docs/loading.md). */
#include <stddef.h>

#include "peripherals.h"

/* Sectors H to E, by the linker. */
extern const uint16_t board_store_memory[];

const uint16_t *board_store(uint16_t slot)
{
    return (slot < (uint16_t)BOARD_STORE_SLOTS)
               ? &board_store_memory[(uint32_t)slot * BOARD_STORE_WORDS]
               : NULL;
}

bool board_store_erase(uint16_t slot)
{
    (void)slot;
    return false;
}

bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count)
{
    (void)slot;
    (void)offset;
    (void)words;
    (void)count;
    return false;
}
