/* SPDX-License-Identifier: MIT */
#include "peripherals.h"
#include "yield.h"

void cycles_init(void)
{
    CORE_DEMCR |= CORE_TRACE_ON;
    CORE_DWT->CYCCNT = 0UL;
    CORE_DWT->CTRL |= CORE_DWT_COUNTS;
}

uint32_t board_cycles(void)
{
    return CORE_DWT->CYCCNT;
}

void cycles_wait(uint32_t cycles)
{
    const uint32_t start = board_cycles();

    while ((uint32_t)(board_cycles() - start) < cycles) {
        BOARD_YIELD();
    }
}
