/* SPDX-License-Identifier: MIT */
#include "trip_enable.h"

#include "peripherals.h"

uint16_t trip_hinders(void)
{
    const uint16_t clock = clock_is_good() ? BOARD_FAULT_NONE : BOARD_FAULT_CLOCK;
    const uint16_t input = trip_pin_is_active() ? BOARD_FAULT_TRIP : BOARD_FAULT_NONE;

    return (uint16_t)(clock | input);
}

void trip_clear(void)
{
    EALLOW;
    EPwm1Regs.TZCLR.all = TRIP_CLEAR_ALL;
    EPwm2Regs.TZCLR.all = TRIP_CLEAR_ALL;
    EPwm3Regs.TZCLR.all = TRIP_CLEAR_ALL;
    EPwm6Regs.TZCLR.all = TRIP_CLEAR_ALL;
    EDIS;
}
