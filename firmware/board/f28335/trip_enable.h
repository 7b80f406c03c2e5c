/* SPDX-License-Identifier: MIT */
/**
 * @file trip_enable.h
 * @brief Checks and registers that enable the gates, once in a run. Internal to trip.c.
 *
 * trip_enable.c runs from the flash.
 */
#ifndef TRIP_ENABLE_H
#define TRIP_ENABLE_H

#include "DSP28x_Project.h"
#include "board.h"

#define TRIP_GATE_PIN  0x40UL /**< GPIO6 */
#define TRIP_ONE_SHOT  4U     /**< TZFLG: OST */
#define TRIP_CLEAR_ALL 7U     /**< one-shot, cycle by cycle, and the summary flag */

/** True if one of the three legs is off by its one-shot. Context: control ISR. */
static inline bool trip_is_tripped(void)
{
    const uint16_t first  = EPwm1Regs.TZFLG.all;
    const uint16_t second = EPwm2Regs.TZFLG.all;
    const uint16_t third  = EPwm3Regs.TZFLG.all;

    return ((first | second | third) & TRIP_ONE_SHOT) != 0U;
}

/** True if the trip input is low. Context: control ISR. */
static inline bool trip_pin_is_active(void)
{
    return GpioDataRegs.GPADAT.bit.GPIO12 == 0U;
}

/** Faults that forbid to enable now: the crystal, the trip input. Context: control ISR. */
uint16_t trip_hinders(void);

/** Clears the one-shots of legs and brake; an active input sets them again. Context: control
 * ISR. */
void trip_clear(void);

#endif /* TRIP_ENABLE_H */
