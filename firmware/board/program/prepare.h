/* SPDX-License-Identifier: MIT */
/**
 * @file prepare.h
 * @brief First step of main(), before anything that takes time.
 */
#ifndef PREPARE_H
#define PREPARE_H

#include <stdbool.h>

/**
 * @brief Makes the pins safe, then sets up clock, flash timing and trip. All six switches stay off.
 *
 * @return false: the clock failed (BOARD_FAULT_CLOCK). board_init() then returns false too.
 *
 * Context: init, once, before any other call, interrupts off. About 5 ms.
 */
bool board_prepare(void);

#endif /* PREPARE_H */
