/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

#define GUARD_WORDS 8U  /* chosen: the smallest interrupt pushes more words than this */
#define COPY_WORDS  32U /* chosen: about 500 cycles of a pass, with the waits of the flash */

/* The stack, placed by the linker. codestart.asm fills it before main(). It grows upwards. */
extern volatile uint16_t codestart_stack[BOARD_STACK_WORDS];

/* The next words to compare. */
static uint16_t copy;
static uint32_t word;

static bool stack_is_whole(void)
{
    for (uint16_t n = BOARD_STACK_WORDS - GUARD_WORDS; n < BOARD_STACK_WORDS; n++) {
        if (codestart_stack[n] != BOARD_STACK_FILL) {
            return false;
        }
    }
    return true;
}

/* Each pass compares a few words, in turn. */
static bool copies_are_whole(void)
{
    bool same = true;

    if ((copy >= BOARD_COPIES) || (word >= board_copies[copy].words)) {
        copy = ((copy + 1U) < BOARD_COPIES) ? (uint16_t)(copy + 1U) : 0U;
        word = 0UL;
    }
    const board_copy_t *c = &board_copies[copy];

    for (uint16_t n = 0U; (n < COPY_WORDS) && (word < c->words); n++) {
        same = (c->run[word] == c->load[word]) && same;
        word++;
    }
    return same;
}

bool board_memory_is_whole(void)
{
    return stack_is_whole() && copies_are_whole();
}
