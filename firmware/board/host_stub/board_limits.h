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
#define BOARD_POSITIONS   4096U      /**< per turn: 1024 lines, four edges each */
#define BOARD_DUTY_FULL   2500U      /**< compare counts of duty one: 25 MHz / (2 * 5 kHz) */
#define BOARD_CAPTURE_Hz  12500000UL /**< of the encoder's edge times: half the clock */
#define BOARD_UPDATES_MAX 1U         /**< control periods per PWM period */
#define BOARD_PWM_CYCLES  5000UL     /**< processor cycles per PWM period: 25 MHz / 5 kHz */

#endif /* BOARD_LIMITS_H */
