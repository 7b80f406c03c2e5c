/* SPDX-License-Identifier: MIT */
/* The build places this file in RAM, with TI's flash API: the flash cannot be read while it is written. Without that
 * library (SDRE_FLASH_API) the store can be read, and written by a programming tool only. */
#include <stddef.h>

#include "DSP28x_Project.h"
#include "peripherals.h"

#ifdef SDRE_FLASH_API
#include "Flash2833x_API_Library.h"

#define NANOSECONDS 6.667f /* of a processor cycle, 150 MHz */

static const uint16_t sectors[BOARD_STORE_SLOTS] = {SECTORH, SECTORG, SECTORF, SECTORE};

/* The API's own unit: 200 ns are 2^20. */
static void set_up(void)
{
    Flash_CPUScaleFactor = (Uint32)((1048576.0f * 200.0f) / NANOSECONDS);
    Flash_CallbackPtr    = NULL; /* the loader has no watchdog to serve */
}
#endif

/* Sectors H to E, by the linker. */
extern uint16_t board_store_memory[];

static uint16_t *word_of(uint16_t slot, uint32_t offset)
{
    return &board_store_memory[((uint32_t)slot * BOARD_STORE_WORDS) + offset];
}

const uint16_t *board_store(uint16_t slot)
{
    return (slot < (uint16_t)BOARD_STORE_SLOTS) ? word_of(slot, 0UL) : NULL;
}

bool board_store_erase(uint16_t slot)
{
#ifdef SDRE_FLASH_API
    FLASH_ST where;

    set_up();
    return (slot < (uint16_t)BOARD_STORE_SLOTS) &&
           (Flash_Erase(sectors[slot], &where) == STATUS_SUCCESS);
#else
    (void)slot;
    return false;
#endif
}

bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count)
{
#ifdef SDRE_FLASH_API
    FLASH_ST where;

    if ((slot >= (uint16_t)BOARD_STORE_SLOTS) || (offset > BOARD_STORE_WORDS) ||
        ((uint32_t)count > (BOARD_STORE_WORDS - offset))) {
        return false;
    }
    set_up();
    for (uint16_t n = 0U; n < count; n++) {
        uint16_t word = words[n];
        if (Flash_Program(word_of(slot, offset + n), &word, 1UL, &where) != STATUS_SUCCESS) {
            return false;
        }
    }
    return true;
#else
    (void)slot;
    (void)offset;
    (void)words;
    (void)count;
    return false;
#endif
}
