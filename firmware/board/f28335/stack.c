/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

#define GUARD_WORDS 8U /* chosen: what the smallest interrupt pushes at once is more */

/* Where the linker puts the stack; codestart.asm has filled it before main(). It grows upwards. */
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
