/* SPDX-License-Identifier: MIT */
#include "clock_tree.h"
#include "peripherals.h"
#include "restart_mark.h"
#include "yield.h"

#define KEY_START  0xCCCCUL
#define KEY_UNLOCK 0x5555UL
#define KEY_SERVE  0xAAAAUL
#define QUARTER    0UL /* PR: divides by four */

static board_reset_t cause;

/* They survive a reset: the start-up code writes neither. */
__attribute__((section(".noinit"))) static volatile uint32_t after_reset[2];
__attribute__((section(".noinit"))) static uint16_t          kept[BOARD_KEPT_WORDS];

void watchdog_init(void)
{
    const uint32_t causes = RCC->CSR & (RCC_CSR_IWDGRSTF | RCC_CSR_SFTRSTF);

    cause = (causes != 0UL) ? BOARD_RESET_WATCHDOG : BOARD_RESET_PIN;
    RCC->CSR |= RCC_CSR_RMVF; /* the next reset sets its own cause */
}

board_reset_t board_reset_cause(void)
{
    return cause;
}

bool board_loader_is_wanted(void)
{
    return restart_mark_take(after_reset);
}

uint16_t *board_kept(void)
{
    return kept;
}

void board_restart(bool loader)
{
    board_gate_trip();
    restart_mark_set(after_reset, loader);
    core_barrier();
    CORE_SCB->AIRCR = CORE_AIRCR_RESET;
    for (;;) {
        BOARD_YIELD();
    }
}

/* It cannot be stopped after this. Its registers take a while, as its clock is slow. */
void watchdog_start(void)
{
    IWDG->KR  = KEY_START;
    IWDG->KR  = KEY_UNLOCK;
    IWDG->PR  = QUARTER;
    IWDG->RLR = CLOCK_WATCHDOG_cnt - 1UL;
    while (IWDG->SR != 0UL) {
        BOARD_YIELD();
    }
    board_watchdog_serve();
}

void board_watchdog_serve(void)
{
    IWDG->KR = KEY_SERVE;
}
