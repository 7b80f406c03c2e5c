/* SPDX-License-Identifier: MIT */
/**
 * @file yield.h
 * @brief One idle instruction; every loop that waits for hardware or other contexts contains it.
 *
 * A simulation of the device gives its own meaning to asm(), and lets time pass here.
 */
#ifndef YIELD_H
#define YIELD_H

#define BOARD_YIELD() asm(" NOP")

#endif /* YIELD_H */
