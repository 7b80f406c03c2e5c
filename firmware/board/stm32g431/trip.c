/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

/* The control interrupt and its tick write `latched`; SysTick, which may interrupt the tick, has
 * its own word. */
static volatile uint16_t latched;
static volatile bool     overdue;
static volatile bool     enabled; /* false: the software keeps the bridge off */
static volatile bool     wanted;  /* enable at the start of the next period */

void trip_init(void)
{
    enabled = false;
    wanted  = false;
    latched = BOARD_FAULT_NONE;
    overdue = false;
}

void trip_latch(uint16_t fault)
{
    board_gate_trip();
    latched = (uint16_t)(latched | fault);
}

void trip_overdue(void)
{
    board_gate_trip();
    overdue = true;
}

static uint16_t faults(void)
{
    return (uint16_t)(latched | (overdue ? (uint16_t)BOARD_FAULT_OVERRUN : 0U));
}

/* True while a comparator sees too much current, or the button is pressed. */
static bool input_is_active(void)
{
    const uint32_t over = COMP->C1CSR | COMP->C2CSR | COMP->C4CSR;

    return ((over & COMP_CCSR_VALUE) != 0UL) || gpio_button();
}

static uint16_t hinders(void)
{
    const uint16_t clock = clock_is_good() ? BOARD_FAULT_NONE : BOARD_FAULT_CLOCK;
    const uint16_t input = input_is_active() ? BOARD_FAULT_TRIP : BOARD_FAULT_NONE;

    return (uint16_t)(clock | input);
}

/* Enables the gates. Runs just after the top of the counter: all lower switches are on, and the
 * duty ratios of the previous tick have become active. SysTick must not come between its look and
 * its write. */
static void enable(void)
{
    core_mask();
    latched = (uint16_t)(latched | hinders());
    if (faults() == BOARD_FAULT_NONE) {
        TIM1->SR = ~(TIM_SR_BIF | TIM_SR_SBIF);
        enabled  = true;
        TIM1->BDTR |= TIM_BDTR_MOE; /* last; without effect while a break is active */
    }
    core_unmask();
}

void trip_check(void)
{
    uint16_t found = BOARD_FAULT_NONE;

    if (!clock_is_good()) {
        found = BOARD_FAULT_CLOCK;
    } else if (enabled && (((TIM1->BDTR & TIM_BDTR_MOE) == 0UL) || gpio_button())) {
        found = BOARD_FAULT_TRIP;
    } else {
        /* none */
    }
    if (found != BOARD_FAULT_NONE) {
        trip_latch(found);
    }
    if (wanted) {
        wanted = false;
        enable();
    }
    if (!enabled) {
        board_gate_trip(); /* every period, in case a bit changed by itself */
    }
    gpio_light(enabled);
}

/* `enabled` is cleared before MOE: otherwise a control interrupt in between would report it as a
 * hardware trip. A control interrupt may also enable the gates in between, at the request of a
 * tick. The loop condition detects this. */
void board_gate_trip(void)
{
    do {
        wanted  = false;
        enabled = false;
        TIM1->BDTR &= ~TIM_BDTR_MOE;
    } while (enabled);
}

void board_gate_enable(void)
{
    if (!enabled) { /* must not clear a trip that occurs now */
        latched = BOARD_FAULT_NONE;
        overdue = false;
        wanted  = true;
    }
}

uint16_t board_fault_read(void)
{
    return (uint16_t)(faults() | (input_is_active() ? (uint16_t)BOARD_FAULT_INPUT : 0U));
}
