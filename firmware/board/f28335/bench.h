/* SPDX-License-Identifier: MIT */
/**
 * @file bench.h
 * @brief Program of the debugger image (f28335-ram): the board layer without application and law.
 *
 * A debugger writes bench_wanted and reads bench_seen, as docs/bring-up.md describes. It tests the
 * power stage only: duty ratios are open loop, and no motor is connected.
 */
#ifndef BENCH_H
#define BENCH_H

#include "board.h"

#define BENCH_GATES 0x6A7EU /**< bench_wanted.gates: chosen, unlikely as a stray write */

typedef struct {
    uint16_t     gates;       /**< BENCH_GATES: the bridge follows `duty`; anything else opens it */
    uint16_t     current_cnt; /**< largest distance of a current from the converter's middle */
    board_duty_t duty;
} bench_wanted_t;

typedef struct {
    board_sample_t sample;
    uint32_t       ticks;
    uint16_t       faults;       /**< BOARD_FAULT_ */
    uint16_t       over_current; /**< samples beyond `current_cnt` that have opened the bridge */
    bool           on;           /**< the gates are enabled */
} bench_seen_t;

extern volatile bench_wanted_t bench_wanted;
extern volatile bench_seen_t   bench_seen;

#endif /* BENCH_H */
