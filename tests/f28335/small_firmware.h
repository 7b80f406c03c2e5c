/* SPDX-License-Identifier: MIT */
/**
 * @file small_firmware.h
 * @brief A few hundred lines' worth of drivers in one: what a board layer does, with one mistake on demand.
 */
#ifndef SMALL_FIRMWARE_H
#define SMALL_FIRMWARE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    MISTAKE_NONE = 0,
    MISTAKE_NO_PIEACK,        /**< the ISR does not acknowledge */
    MISTAKE_NO_INT_CLEAR,     /**< the ISR leaves the converter's flag standing */
    MISTAKE_ISR_NO_EALLOW,    /**< the ISR relies on the background's EALLOW */
    MISTAKE_NO_SEQ_RESET,     /**< the ISR does not rewind the sequencer */
    MISTAKE_NO_EALLOW,        /**< trip registers written without EALLOW */
    MISTAKE_EDIS_FIRST,       /**< the protection goes up one write too early */
    MISTAKE_TRIP_UNARMED,     /**< TZSEL left at zero on leg 2 */
    MISTAKE_TRIP_PIN_UNMUXED, /**< GPIO12 stays a plain pin */
    MISTAKE_TRIP_FLOATS,      /**< TZCTL left at its reset value: high impedance */
    MISTAKE_DEAD_BAND_WIDE,   /**< 1050 counts, of which ten bits stay */
    MISTAKE_POLARITY,         /**< both outputs of a leg active high */
    MISTAKE_NO_CLOCK,         /**< registers of ePWM2 written while its clock is off */
    MISTAKE_ADC_TOO_FAST,     /**< HISPCP left at its reset value */
    MISTAKE_ADC_COLD,         /**< no wait after power-up */
    MISTAKE_NO_ADC_CAL,
    MISTAKE_ADC_CAL_LOCKED,
    MISTAKE_SHORT_WINDOW, /**< 160 ns, and the first pair is used */
    MISTAKE_DIVSEL_EARLY, /**< PLL divider lowered before the lock */
    MISTAKE_NO_WATCHDOG,  /**< started but not served */
    MISTAKE_HALF_KEY,     /**< served with half of the key */
    MISTAKE_QPOSMAX       /**< 10000 instead of 9999 */
} small_firmware_mistake_t;

/** Set before a run. */
extern small_firmware_mistake_t small_firmware_mistake;
/** Compare value of all legs, and whether the gate driver is enabled. */
extern uint16_t small_firmware_compare;

/** Values that the ISR saw. */
extern volatile uint32_t small_firmware_ticks;
extern volatile uint16_t small_firmware_codes[4];
extern volatile uint16_t small_firmware_position;
extern volatile uint16_t small_firmware_index;
extern volatile uint16_t
    small_firmware_heard; /**< last octet of the serial line, echoed plus one */

int small_firmware_main(void);

#ifdef __cplusplus
}
#endif

#endif /* SMALL_FIRMWARE_H */
