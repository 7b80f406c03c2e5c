/* SPDX-License-Identifier: MIT */
/**
 * @file clock_tree.h
 * @brief All rates of this board that do not depend on the drive, derived from the crystal.
 *
 * The preprocessor computes them: a rate that a register cannot hold is a compile error.
 */
#ifndef CLOCK_TREE_H
#define CLOCK_TREE_H

#include "board_limits.h"

#define CLOCK_CRYSTAL_Hz 8000000UL /**< of the board */

#define CLOCK_PLL_M     2UL  /**< 4 MHz into the PLL: 2.66 .. 16 MHz are allowed */
#define CLOCK_PLL_N     85UL /**< 340 MHz: 96 .. 344 MHz are allowed in range 1 boost */
#define CLOCK_PLL_R     2UL
#define CLOCK_SYSCLK_Hz (((CLOCK_CRYSTAL_Hz / CLOCK_PLL_M) * CLOCK_PLL_N) / CLOCK_PLL_R)

/** The converters run on a quarter of SYSCLK; both at once may have 52 MHz at most. */
#define CLOCK_ADCCLK_Hz     (CLOCK_SYSCLK_Hz / 4UL)
#define CLOCK_ADCCLK_MAX_Hz 52000000UL

/** Longest PWM period. An edge in the period before the latch has its age in 16 bits, even if the
 *  interrupt is late by half a period. */
#define CLOCK_PERIOD_MAX_cycles 43690UL

/** Dead times of TIM1: steps of 1, 2, 8 and 16 counts, each from where the one before ends.
 *  range(least, most, step, DTG of the least) in counts. */
#define CLOCK_DEAD_TIMES(range)                                                                    \
    range(1U, 127U, 1U, 0x01U), range(128U, 254U, 2U, 0x80U), range(256U, 504U, 8U, 0xC0U),        \
        range(512U, 1008U, 16U, 0xE0U)

#define CLOCK_BAUD_Hz 115200UL /**< the fastest rate, as on the other board */
/** BRR of the nearest rate. */
#define CLOCK_BRR(baud_Bd)            ((CLOCK_SYSCLK_Hz + ((baud_Bd) / 2UL)) / (baud_Bd))
#define CLOCK_BAUD_ACTUAL_Hz(baud_Bd) (CLOCK_SYSCLK_Hz / CLOCK_BRR(baud_Bd))
/** Rate within 2 %, and BRR has 16 bits. */
#define CLOCK_BAUD_FITS(baud_Bd)                                                                   \
    ((CLOCK_BRR(baud_Bd) >= 16UL) && (CLOCK_BRR(baud_Bd) <= 65535UL) &&                            \
     ((CLOCK_BAUD_ACTUAL_Hz(baud_Bd) * 100UL) <= ((baud_Bd)*102UL)) &&                             \
     ((CLOCK_BAUD_ACTUAL_Hz(baud_Bd) * 100UL) >= ((baud_Bd)*98UL)))

/** Time quanta of a CAN bit: one, TSEG1 before the sample point, TSEG2 after it. Chosen: the sample
 *  point at 15 / 17 of a bit is as near to 7 / 8 as whole prescalers allow at all four rates. */
#define CLOCK_CAN_TSEG1 14UL
#define CLOCK_CAN_TSEG2 2UL
#define CLOCK_CAN_SJW   2UL
#define CLOCK_CAN_BIT   (1UL + CLOCK_CAN_TSEG1 + CLOCK_CAN_TSEG2)
/** Prescaler of a bit rate. */
#define CLOCK_CAN_PRESCALER(rate_kbps) (CLOCK_SYSCLK_Hz / (CLOCK_CAN_BIT * 1000UL * (rate_kbps)))
#define CLOCK_CAN_FITS(rate_kbps)                                                                  \
    ((CLOCK_CAN_PRESCALER(rate_kbps) * CLOCK_CAN_BIT * 1000UL * (rate_kbps)) == CLOCK_SYSCLK_Hz)

/** Longest background pass. Chosen, as on the other board. */
#define CLOCK_PASS_MAX_us 1000UL
/** The watchdog counts a quarter of its own oscillator. Nominal 32 kHz, 29.5 .. 34 (data sheet). */
#define CLOCK_LSI_MAX_Hz      34000UL
#define CLOCK_WATCHDOG_cnt    35UL
#define CLOCK_WATCHDOG_MIN_us ((CLOCK_WATCHDOG_cnt * 4UL * 1000000UL) / CLOCK_LSI_MAX_Hz)

#if CLOCK_SYSCLK_Hz != 170000000UL
#error "flash wait states and voltage range are those of 170 MHz"
#endif
#if BOARD_CAPTURE_Hz != CLOCK_SYSCLK_Hz
#error "BOARD_CAPTURE_Hz is not the clock of TIM2"
#endif
#if CLOCK_ADCCLK_Hz > CLOCK_ADCCLK_MAX_Hz
#error "the ADC clock is too fast"
#endif
#if !CLOCK_BAUD_FITS(9600UL) || !CLOCK_BAUD_FITS(19200UL) || !CLOCK_BAUD_FITS(38400UL) ||          \
    !CLOCK_BAUD_FITS(57600UL) || !CLOCK_BAUD_FITS(CLOCK_BAUD_Hz)
#error "a baud rate of serial.c cannot be made within 2 %"
#endif
#if !CLOCK_CAN_FITS(125UL) || !CLOCK_CAN_FITS(250UL) || !CLOCK_CAN_FITS(500UL) ||                  \
    !CLOCK_CAN_FITS(1000UL)
#error "a bit rate of can.c has no whole prescaler"
#endif
#if (4UL * CLOCK_PASS_MAX_us) > CLOCK_WATCHDOG_MIN_us
#error "the watchdog's period is less than four passes of the background"
#endif

#endif /* CLOCK_TREE_H */
