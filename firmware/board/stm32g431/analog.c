/* SPDX-License-Identifier: MIT */
/* Amplifiers of the three shunts, and the comparators that open the bridge. Both look at the same
 * pins. docs/hardware_stm32g431.md has the network before them. */
#include "clock_tree.h"
#include "peripherals.h"

#define PGA          2U  /* VM_SEL */
#define GAIN_16_BIAS 11U /* 16 of the pin's voltage, against the bias at VINM0 */

#define DAC_INSIDE   3U /* MODE: to the comparators only, without buffer */
#define ABOVE_160MHZ 2U /* HFSEL */

#define MINUS_DAC3     4U /* INMSEL: channel 1 at COMP1, channel 2 at COMP2 and COMP4 */
#define HYSTERESIS_10m 1U /* 10 mV: chosen, 6 A */

/* Pin voltage at 45 A out of the motor: (0.9 V + 4 * 45 A * 3 mOhm) / 7 = 0.206 V. Chosen: above
 * the board's 40 A. In units of a 12-bit code of 3.3 V. */
#define TRIP_cnt 255UL

/* The start takes 8 us (data sheet, unbuffered); chosen twice of it. */
#define SETTLE_CYCLES (CLOCK_SYSCLK_Hz / 62500UL)

static void set_threshold(void)
{
    DAC3->MCR = DAC_MCR_MODE1(DAC_INSIDE) | DAC_MCR_MODE2(DAC_INSIDE) | DAC_MCR_HFSEL(ABOVE_160MHZ);
    DAC3->CR  = DAC_CR_EN1 | DAC_CR_EN2;
    cycles_wait(SETTLE_CYCLES);
    DAC3->DHR12R1 = TRIP_cnt;
    DAC3->DHR12R2 = TRIP_cnt;
    cycles_wait(SETTLE_CYCLES);
}

void analog_init(void)
{
    const uint32_t amplifier = OPAMP_CSR_OPAMPxEN | OPAMP_CSR_VM_SEL(PGA) | OPAMP_CSR_OPAHSM |
                               OPAMP_CSR_PGA_GAIN(GAIN_16_BIAS);
    const uint32_t comparator =
        COMP_CCSR_EN | COMP_CCSR_INMSEL(MINUS_DAC3) | COMP_CCSR_HYST(HYSTERESIS_10m);

    OPAMP->OPAMP1_CSR = amplifier;
    OPAMP->OPAMP2_CSR = amplifier;
    OPAMP->OPAMP3_CSR = amplifier;
    set_threshold();
    COMP->C1CSR = comparator;
    COMP->C2CSR = comparator;
    COMP->C4CSR = comparator;
    cycles_wait(SETTLE_CYCLES);
}
