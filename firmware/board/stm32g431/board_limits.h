/* SPDX-License-Identifier: MIT */
/**
 * @file board_limits.h
 * @brief The numbers of the board interface that no drive changes.
 */
#ifndef BOARD_LIMITS_H
#define BOARD_LIMITS_H

#define BOARD_ADC_CODES   4096U       /**< 12-bit converter: codes 0 .. 4095 */
#define BOARD_CAPTURE_Hz  170000000UL /**< of the encoder's edge times: the processor's clock */
#define BOARD_UPDATES_MAX 1U      /**< shunts carry the currents around the counter's top only */
#define BOARD_STORE_WORDS 0x800UL /**< two pages of the flash */
#define BOARD_STORE_GRAIN 4U      /**< words that are written at once, with their ECC */

#endif /* BOARD_LIMITS_H */
