/* SPDX-License-Identifier: MIT */
/**
 * @file startup.c
 * @brief Vectors and reset of an image. The emulator loads all sections where they run and
 *        memory starts at zero, so nothing is copied or cleared.
 */
#include <stdint.h>

#include "semihosting.h"

#define CPACR           (*(volatile uint32_t *)0xE000ED88u)
#define CPACR_FPU       (0xFu << 20) /* full access to coprocessors 10 and 11 */
#define EXIT_UNEXPECTED 3u

extern uint32_t image_stack_top; /* image.ld */
int             main(void);
void            startup_reset(void);

void startup_reset(void)
{
    CPACR |= CPACR_FPU;
    __asm__ volatile("dsb\n isb");
    semihosting_exit((uint32_t)main());
}

static void unexpected(void)
{
    semihosting_exit(EXIT_UNEXPECTED);
}

typedef union {
    void (*handler)(void);
    const uint32_t *address;
} vector_t;

__attribute__((section(".vectors"), used)) static const vector_t vectors[] = {
    {.address = &image_stack_top}, {.handler = startup_reset}, {.handler = unexpected}, /* NMI */
    {.handler = unexpected}, /* hard fault */
    {.handler = unexpected},       {.handler = unexpected},    {.handler = unexpected}};
