/* SPDX-License-Identifier: MIT */
/**
 * @file board_limits.h
 * @brief The numbers of the board interface: ranges of what board.h hands over, and the PWM period.
 *
 * Chosen unlike those of the F28335: the application must not know any of them by itself.
 */
#ifndef BOARD_LIMITS_H
#define BOARD_LIMITS_H

#define BOARD_ADC_CODES   16384U     /**< 14-bit converter: codes 0 .. 16383 */
#define BOARD_CAPTURE_Hz  12500000UL /**< of the encoder's edge times: half the clock */
#define BOARD_UPDATES_MAX 1U         /**< control periods per PWM period */
#define BOARD_STORE_WORDS 0UL        /**< no store */

#endif /* BOARD_LIMITS_H */
