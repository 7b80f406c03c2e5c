/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

#define GUARD_WORDS 16U /* chosen: half of what the smallest interrupt pushes with its floats */
#define COPY_WORDS  16U /* chosen: a pass takes 200 cycles longer, and 7 KB take 112 passes */
#define PAGE_OCTETS 1024UL
#define CCM_BASE    0x10000000UL

/* The stack's lowest words, by the linker. startup.c fills them; the stack grows towards them.
 * Below is the region that no access may touch. */
extern const volatile uint32_t image_stack[];

/* Code in the CCM SRAM and where it comes from, by the linker. Code in the flash has an
 * error-correcting code. */
extern const volatile uint32_t image_ccm[];
extern const volatile uint32_t image_ccm_end[];
extern const uint32_t          image_ccm_load[];

static uint32_t word; /* the next one to compare */

void memory_protect_code(void)
{
    const uint32_t first = ((uint32_t)image_ccm - CCM_BASE) / PAGE_OCTETS;

    SYSCFG->SWPR = (SYSCFG_SWPR_PAGES << first) & SYSCFG_SWPR_PAGES; /* up to the last one */
}

static bool stack_is_whole(void)
{
    bool whole = true;

    for (uint32_t n = 0UL; n < GUARD_WORDS; n++) {
        whole = whole && (image_stack[n] == STACK_FILL);
    }
    return whole;
}

/* Each pass compares a few words, in turn. */
static bool code_is_whole(void)
{
    bool same = true;

    for (uint32_t n = 0UL; n < COPY_WORDS; n++) {
        same = same && (image_ccm[word] == image_ccm_load[word]);
        word++;
        if (&image_ccm[word] >= image_ccm_end) {
            word = 0UL;
        }
    }
    return same;
}

bool board_memory_is_whole(void)
{
    const bool code = code_is_whole();

    return stack_is_whole() && code;
}
