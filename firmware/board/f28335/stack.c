/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

#define GUARD_WORDS 8U /* chosen: the smallest interrupt pushes more words than this */

/* The stack, placed by the linker. codestart.asm fills it before main(). It grows upwards. */
extern volatile uint16_t codestart_stack[BOARD_STACK_WORDS];

bool board_stack_is_whole(void)
{
    for (uint16_t n = BOARD_STACK_WORDS - GUARD_WORDS; n < BOARD_STACK_WORDS; n++) {
        if (codestart_stack[n] != BOARD_STACK_FILL) {
            return false;
        }
    }
    return true;
}
