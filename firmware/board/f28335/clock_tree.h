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

#define CLOCK_CRYSTAL_Hz 30000000UL /**< of the board */

#define CLOCK_PLL_MULTIPLIER 10U /**< PLLCR.DIV */
#define CLOCK_PLL_DIVSEL     2U  /**< PLLSTS.DIVSEL: divide by two */
#define CLOCK_SYSCLK_Hz      ((CLOCK_CRYSTAL_Hz * CLOCK_PLL_MULTIPLIER) / 2UL)

/* HISPCP and LOSPCP divide by twice their value. */
#define CLOCK_HISPCP    3U
#define CLOCK_HSPCLK_Hz (CLOCK_SYSCLK_Hz / (2UL * CLOCK_HISPCP))
#define CLOCK_LOSPCP    2U
#define CLOCK_LSPCLK_Hz (CLOCK_SYSCLK_Hz / (2UL * CLOCK_LOSPCP))

/** The converter runs on HSPCLK undivided, at its maximum, for the shortest sampling delay. */
#define CLOCK_ADCCLK_Hz     CLOCK_HSPCLK_Hz
#define CLOCK_ADCCLK_MAX_Hz 25000000UL /**< data sheet */

/** Half the system clock: a dead time of 7 us still fits its ten bits. */
#define CLOCK_SYSCLK_PER_TBCLK 2UL
#define CLOCK_TBCLK_Hz         (CLOCK_SYSCLK_Hz / CLOCK_SYSCLK_PER_TBCLK)

/** The encoder's capture timer: SYSCLK / 2^this. */
#define CLOCK_CAPTURE_SHIFT 1U

/** Longest PWM period: half the range of the 16-bit capture timer. An edge in the period before the
 *  latch keeps its age, even if the interrupt is late by a period. */
#define CLOCK_PERIOD_MAX_cycles (65535UL << (CLOCK_CAPTURE_SHIFT - 1U))

#define CLOCK_DEAD_TIME_MAX_cnt 1023UL /**< ten bits */

/** The fastest rate. Chosen: 1.4 ms for a Modbus frame of 16 octets. */
#define CLOCK_BAUD_Hz 115200UL
/** BRR of the nearest rate: LSPCLK / (8 baud) - 1. */
#define CLOCK_BRR(baud_Bd) (((CLOCK_LSPCLK_Hz + (4UL * (baud_Bd))) / (8UL * (baud_Bd))) - 1UL)
/** Rate of this BRR, within 2 % of `baud_Bd`. With 2 % at the other end too, the error stays below
 *  half a bit in eleven. */
#define CLOCK_BAUD_ACTUAL_Hz(baud_Bd) (CLOCK_LSPCLK_Hz / (8UL * (CLOCK_BRR(baud_Bd) + 1UL)))
#define CLOCK_BAUD_FITS(baud_Bd)                                                                   \
    ((CLOCK_BRR(baud_Bd) <= 65535UL) &&                                                            \
     ((CLOCK_BAUD_ACTUAL_Hz(baud_Bd) * 100UL) <= ((baud_Bd)*102UL)) &&                             \
     ((CLOCK_BAUD_ACTUAL_Hz(baud_Bd) * 100UL) >= ((baud_Bd)*98UL)))

/** Clock of the CAN module: half the system clock. */
#define CLOCK_CAN_Hz (CLOCK_SYSCLK_Hz / 2UL)
/** Time quanta of a bit: one, TSEG1 before the sample point, TSEG2 after it. Chosen: the sample
 *  point at 13 / 15 of a bit is as near to 7 / 8 as whole prescalers allow at all four rates. */
#define CLOCK_CAN_TSEG1 12UL
#define CLOCK_CAN_TSEG2 2UL
#define CLOCK_CAN_SJW   2UL
#define CLOCK_CAN_BIT   (1UL + CLOCK_CAN_TSEG1 + CLOCK_CAN_TSEG2)
/** Prescaler of a bit rate. It is whole for 125, 250, 500 and 1000 kbit/s, but not for 800. */
#define CLOCK_CAN_PRESCALER(rate_kbps) (CLOCK_CAN_Hz / (CLOCK_CAN_BIT * 1000UL * (rate_kbps)))
#define CLOCK_CAN_FITS(rate_kbps)                                                                  \
    ((CLOCK_CAN_PRESCALER(rate_kbps) * CLOCK_CAN_BIT * 1000UL * (rate_kbps)) == CLOCK_CAN_Hz)

/** Longest background pass. Chosen: 0.4 ms with the longest frame, doubled for the interrupt. */
#define CLOCK_PASS_MAX_us 1000UL
/** The watchdog's period: 256 * 512 crystal cycles. */
#define CLOCK_WATCHDOG_us ((256UL * 512UL) / (CLOCK_CRYSTAL_Hz / 1000000UL))
/** Time in which continuous octets of 11 bits fill the receive FIFO of 16 octets. */
#define CLOCK_FIFO_us(baud_Bd) ((16UL * 11UL * 1000000UL) / CLOCK_BAUD_ACTUAL_Hz(baud_Bd))
/** True while a whole pass fits in that time. */
#define CLOCK_FIFO_OUTLASTS_PASS(baud_Bd) (CLOCK_FIFO_us(baud_Bd) > CLOCK_PASS_MAX_us)

#if CLOCK_SYSCLK_Hz != 150000000UL
#error "flash wait states and PLL settings are those of 150 MHz"
#endif
#if CLOCK_ADCCLK_Hz > CLOCK_ADCCLK_MAX_Hz
#error "the ADC clock is too fast"
#endif
#if !CLOCK_BAUD_FITS(9600UL) || !CLOCK_BAUD_FITS(19200UL) || !CLOCK_BAUD_FITS(38400UL) ||          \
    !CLOCK_BAUD_FITS(57600UL) || !CLOCK_BAUD_FITS(CLOCK_BAUD_Hz)
#error "a baud rate of serial.c cannot be made within 2 %"
#endif
#if !CLOCK_FIFO_OUTLASTS_PASS(CLOCK_BAUD_Hz)
#error "at the fastest rate the receiver's FIFO does not outlast a pass of the background"
#endif
#if !CLOCK_CAN_FITS(125UL) || !CLOCK_CAN_FITS(250UL) || !CLOCK_CAN_FITS(500UL) ||                  \
    !CLOCK_CAN_FITS(1000UL)
#error "a bit rate of can.c has no whole prescaler"
#endif
#if (4UL * CLOCK_PASS_MAX_us) > CLOCK_WATCHDOG_us
#error "the watchdog's period is less than four passes of the background"
#endif

#endif /* CLOCK_TREE_H */
