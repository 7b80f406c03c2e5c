/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

#define GUARD_WORDS 16U /* chosen: half of what the smallest interrupt pushes with its floats */

/* The stack's lowest words, by the linker. startup.c fills them; the stack grows towards them.
 * Below is the region that no access may touch. */
extern const volatile uint32_t image_stack[];

/* All code runs from the flash, whose words have an error-correcting code: there is no copy to
 * compare. */
bool board_memory_is_whole(void)
{
    bool whole = true;

    for (uint32_t n = 0UL; n < GUARD_WORDS; n++) {
        whole = whole && (image_stack[n] == STACK_FILL);
    }
    return whole;
}
