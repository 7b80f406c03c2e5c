/* SPDX-License-Identifier: MIT */
/**
 * @file board_limits.h
 * @brief The numbers of the board interface that no drive changes.
 *
 * The implementation checks at compile time that its clock tree yields them.
 */
#ifndef BOARD_LIMITS_H
#define BOARD_LIMITS_H

#define BOARD_ADC_CODES   4096U      /**< 12-bit converter: codes 0 .. 4095 */
#define BOARD_CAPTURE_Hz  75000000UL /**< of the encoder's edge times: half the processor's clock */
#define BOARD_UPDATES_MAX 2U         /**< control periods per PWM period */
#define BOARD_STORE_WORDS 0x8000UL   /**< a sector of the flash */
#define BOARD_STORE_GRAIN 1U         /**< words that are written at once */

#endif /* BOARD_LIMITS_H */
