/* SPDX-License-Identifier: MIT */
/**
 * @file yield.h
 * @brief One idle instruction for every loop that waits for hardware or another context.
 *
 * The simulated device replaces asm() and advances its time here.
 */
#ifndef YIELD_H
#define YIELD_H

#define BOARD_YIELD() asm(" NOP")

#endif /* YIELD_H */
