/* SPDX-License-Identifier: MIT */
/* The store at the end of the flash. One bank: the processor waits while a page is erased, 22 ms,
 * or four words are written, 0.1 ms. So this runs in the loader or before the start. */
#include <stddef.h>

#include "peripherals.h"
#include "yield.h"

#define KEY_1 0x45670123UL
#define KEY_2 0xCDEF89ABUL

#define PAGE_OCTETS 2048UL
#define SLOT_PAGES  ((2UL * BOARD_STORE_WORDS) / PAGE_OCTETS)
#define ERASED      0xFFFFU
#define ERRORS                                                                                     \
    (FLASH_SR_OPERR | FLASH_SR_PROGERR | FLASH_SR_WRPERR | FLASH_SR_PGAERR | FLASH_SR_SIZERR |     \
     FLASH_SR_PGSERR | FLASH_SR_MISERR | FLASH_SR_FASTERR)

/* The linker places it at a page. */
extern uint16_t       image_store[BOARD_STORE_SLOTS][BOARD_STORE_WORDS];
extern const uint32_t image_flash[];

static void wait(void)
{
    while ((FLASH->SR & FLASH_SR_BSY) != 0UL) {
        BOARD_YIELD();
    }
}

static void unlock(void)
{
    wait();
    FLASH->KEYR = KEY_1;
    FLASH->KEYR = KEY_2;
    FLASH->SR   = ERRORS | FLASH_SR_EOP; /* cleared by ones */
}

/* True if nothing went wrong. Old words may be in the data cache. */
static bool lock(void)
{
    const bool good = (FLASH->SR & ERRORS) == 0UL;

    FLASH->CR = FLASH_CR_LOCK;
    FLASH->ACR &= ~FLASH_ACR_DCEN;
    FLASH->ACR |= FLASH_ACR_DCRST;
    FLASH->ACR &= ~FLASH_ACR_DCRST;
    FLASH->ACR |= FLASH_ACR_DCEN;
    core_barrier(); /* what is read from here on is read anew */
    return good;
}

const uint16_t *board_store(uint16_t slot)
{
    return (slot < (uint16_t)BOARD_STORE_SLOTS) ? image_store[slot] : NULL;
}

bool board_store_erase(uint16_t slot)
{
    bool good = (slot < (uint16_t)BOARD_STORE_SLOTS) && !control_has_started();

    if (good) {
        const uint32_t first =
            ((uint32_t)board_store(slot) - (uint32_t)image_flash) / PAGE_OCTETS; /* of the device */

        unlock();
        for (uint32_t n = 0UL; n < SLOT_PAGES; n++) {
            FLASH->CR = FLASH_CR_PER | FLASH_CR_PNB(first + n);
            FLASH->CR = FLASH_CR_PER | FLASH_CR_PNB(first + n) | FLASH_CR_STRT;
            wait();
        }
        good = lock();
    }
    return good;
}

static uint32_t pair(const uint16_t *words)
{
    return ((uint32_t)words[1] << 16U) | (uint32_t)words[0];
}

/* Both halves of 64 bits, one directly after the other. */
static void write_grain(uint16_t *at, const uint16_t *grain)
{
    volatile uint32_t *const place = (volatile uint32_t *)(void *)at;

    place[0] = pair(grain);
    core_barrier();
    place[1] = pair(&grain[2]);
    wait();
}

/* True if these grains may be written: inside the slot, on their places, and erased. */
static bool may_write(uint16_t slot, uint32_t offset, uint16_t count)
{
    bool good = (slot < (uint16_t)BOARD_STORE_SLOTS) && !control_has_started() &&
                ((offset % BOARD_STORE_GRAIN) == 0UL) && (offset <= BOARD_STORE_WORDS) &&
                ((uint32_t)count <= (BOARD_STORE_WORDS - offset));

    for (uint32_t n = 0UL; good && (n < count); n++) {
        good = board_store(slot)[offset + n] == ERASED;
    }
    return good;
}

/* The rest of the last grain becomes 0xFFFF and is written too. */
bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count)
{
    bool good = may_write(slot, offset, count);

    if (good) {
        unlock();
        FLASH->CR = FLASH_CR_PG;
        for (uint32_t n = 0UL; n < count; n += BOARD_STORE_GRAIN) {
            uint16_t grain[BOARD_STORE_GRAIN];

            for (uint32_t k = 0UL; k < BOARD_STORE_GRAIN; k++) {
                grain[k] = ((n + k) < count) ? words[n + k] : ERASED;
            }
            write_grain(&image_store[slot][offset + n], grain);
        }
        good = lock();
        for (uint32_t n = 0UL; good && (n < count); n++) {
            good = board_store(slot)[offset + n] == words[n];
        }
    }
    return good;
}
