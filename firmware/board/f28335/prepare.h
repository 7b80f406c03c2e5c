/* SPDX-License-Identifier: MIT */
/**
 * @file prepare.h
 * @brief The start of main(), before anything that takes time.
 */
#ifndef PREPARE_H
#define PREPARE_H

#include <stdbool.h>

/**
 * @brief Makes the pins safe, then sets clock, flash timing and trip up; all six switches stay off.
 *
 * @return false: the clock cannot be trusted (BOARD_FAULT_CLOCK); board_init() refuses everything then.
 *
 * Context: init, once, first of all and before board_init(), interrupts off. About 5 ms.
 */
bool board_prepare(void);

#endif /* PREPARE_H */
