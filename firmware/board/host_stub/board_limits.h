/* SPDX-License-Identifier: MIT */
/**
 * @file board_limits.h
 * @brief Constants of the board interface: ranges of the values of board.h.
 *
 * They differ from those of the F28335 on purpose: the application must not assume any of them.
 */
#ifndef BOARD_LIMITS_H
#define BOARD_LIMITS_H

#define BOARD_ADC_CODES   16384U     /**< 14-bit converter: codes 0 .. 16383 */
#define BOARD_CAPTURE_Hz  12500000UL /**< of the encoder's edge times: half the clock */
#define BOARD_UPDATES_MAX 1U         /**< control periods per PWM period */
#define BOARD_STORE_WORDS 0UL        /**< no store */
#define BOARD_STORE_GRAIN 1U

#endif /* BOARD_LIMITS_H */
