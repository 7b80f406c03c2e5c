/* SPDX-License-Identifier: MIT */
/**
 * @file yield.h
 * @brief One idle instruction for every loop that waits for hardware or another context.
 *
 * It is no WFI: the cycle counter may stand while the processor sleeps.
 */
#ifndef YIELD_H
#define YIELD_H

#define BOARD_YIELD() __asm__ volatile("nop")

#endif /* YIELD_H */
