/* SPDX-License-Identifier: MIT */
/**
 * @file yield.h
 * @brief Stand-in for the board's yield.h: hands every pass of main()'s loops to the test.
 */
#ifndef YIELD_H
#define YIELD_H

void test_yield(void);

#define BOARD_YIELD() test_yield()

#endif /* YIELD_H */
