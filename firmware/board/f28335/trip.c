/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"
#include "trip_enable.h"

/* The control interrupt and its tick write `latched`; INT13, which may interrupt the tick, has its
 * own word. */
static volatile uint16_t latched;
static volatile bool     overdue;
static volatile bool     enabled; /* false: the software keeps the bridge off */
static volatile bool     wanted;  /* enable at the start of the next period */

static void arm(volatile struct EPWM_REGS *leg)
{
    EALLOW;
    leg->TZSEL.all       = 0U;
    leg->TZSEL.bit.OSHT1 = 1U; /* TZ1 trips for good */
    leg->TZCTL.bit.TZA   = TZ_FORCE_LO;
    leg->TZCTL.bit.TZB   = TZ_FORCE_LO;
    leg->TZEINT.all      = 0U; /* the hardware needs no help; trip_check() looks once a period */
    leg->TZFRC.bit.OST   = 1U; /* off until board_gate_enable() */
    EDIS;
}

void trip_init(void)
{
    enabled = false;
    wanted  = false;
    latched = BOARD_FAULT_NONE;
    overdue = false;
    arm(&EPwm1Regs);
    arm(&EPwm2Regs);
    arm(&EPwm3Regs);
    arm(&EPwm6Regs); /* the brake: it closes whenever the bridge opens */
}

void trip_latch(uint16_t fault)
{
    board_gate_trip();
    latched |= fault;
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

/* Enables the gates. Runs just after PRD: all lower switches are on, and the duty ratios of the
 * previous tick have become active. */
static void enable(void)
{
    latched |= trip_hinders();
    if (faults() != BOARD_FAULT_NONE) {
        return;
    }
    trip_clear();
    if (trip_is_tripped()) { /* the input went low just now */
        trip_latch(BOARD_FAULT_TRIP);
        return;
    }

    enabled                 = true;
    GpioDataRegs.GPASET.all = TRIP_GATE_PIN; /* last: from here the bridge follows the PWM */
}

void trip_check(void)
{
    uint16_t found = BOARD_FAULT_NONE;

    if (!clock_is_good()) {
        found = BOARD_FAULT_CLOCK;
    } else if (enabled && trip_is_tripped()) {
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
        board_gate_trip(); /* every period, in case a pin or a one-shot flag changed by itself */
    }
}

/* `enabled` is cleared before the one-shots: otherwise a control interrupt in between would report
 * them as a hardware trip. A control interrupt may also enable the gates in between, at the request
 * of a tick. The loop condition detects this. */
void board_gate_trip(void)
{
    do {
        wanted                    = false;
        enabled                   = false;
        GpioDataRegs.GPACLEAR.all = TRIP_GATE_PIN;
        EALLOW;
        EPwm1Regs.TZFRC.bit.OST = 1U;
        EPwm2Regs.TZFRC.bit.OST = 1U;
        EPwm3Regs.TZFRC.bit.OST = 1U;
        EPwm6Regs.TZFRC.bit.OST = 1U;
        EDIS;
    } while (enabled);
}

void board_gate_enable(void)
{
    if (enabled) {
        return; /* must not clear a trip that occurs now */
    }

    latched = BOARD_FAULT_NONE;
    overdue = false;
    wanted  = true;
}

uint16_t board_fault_read(void)
{
    return (uint16_t)(faults() | (trip_pin_is_active() ? (uint16_t)BOARD_FAULT_INPUT : 0U));
}
