/* SPDX-License-Identifier: MIT */
/**
 * @file board_limits.h
 * @brief The numbers of the board interface: ranges of what board.h hands over, and the PWM period.
 *
 * The implementation checks at compile time that its clock tree yields them.
 */
#ifndef BOARD_LIMITS_H
#define BOARD_LIMITS_H

#define BOARD_ADC_CODES   4096U      /**< 12-bit converter: codes 0 .. 4095 */
#define BOARD_POSITIONS   10000U     /**< per turn: 2500 lines, four edges each */
#define BOARD_DUTY_FULL   7500U      /**< compare counts of duty one: 75 MHz / (2 * 5 kHz) */
#define BOARD_CAPTURE_Hz  75000000UL /**< of the encoder's edge times: half the processor's clock */
#define BOARD_UPDATES_MAX 2U         /**< control periods per PWM period */
#define BOARD_PWM_CYCLES  30000UL    /**< processor cycles per PWM period: 150 MHz / 5 kHz */

#endif /* BOARD_LIMITS_H */
