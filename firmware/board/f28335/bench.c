/* SPDX-License-Identifier: MIT */
#include "bench.h"

#include "board_config.h"
#include "prepare.h"
#include "yield.h"

#define MIDDLE_cnt  2048L /* half of the converter's range: no current */
#define CURRENT_cnt 205U  /* chosen: a twentieth of the range, 1 A of the shipped drive */

volatile bench_wanted_t bench_wanted = {.current_cnt = CURRENT_cnt};
volatile bench_seen_t   bench_seen;

static bool is_beyond(uint16_t current_cnt)
{
    const int32_t away_cnt = (int32_t)current_cnt - MIDDLE_cnt;
    const int32_t most_cnt = (int32_t)bench_wanted.current_cnt;

    return (away_cnt > most_cnt) || (away_cnt < -most_cnt);
}

static void open_bridge(void)
{
    board_gate_trip();
    bench_wanted.gates = 0U; /* the debugger must request them again */
    bench_seen.on      = false;
}

/* One tick: a trip comes first, an enable comes last. */
static void tick(void)
{
    const board_sample_t sample = *board_sample();
    const bool           over   = is_beyond(sample.ia_cnt) || is_beyond(sample.ib_cnt);
    const bool           wanted = bench_wanted.gates == BENCH_GATES;

    bench_seen.sample = sample;
    bench_seen.ticks  = bench_seen.ticks + 1UL;
    bench_seen.faults = board_fault_read();
    if (bench_seen.on && (over || (bench_seen.faults != 0U))) {
        bench_seen.over_current = (uint16_t)(bench_seen.over_current + (over ? 1U : 0U));
        open_bridge();
    } else if (!wanted || !sample.valid || over) {
        open_bridge();
    } else {
        const board_duty_t duty = bench_wanted.duty;

        board_duty_write(&duty);
        if (!bench_seen.on) {
            board_gate_enable();
            bench_seen.on = true;
        }
    }
}

int main(void)
{
    if (board_prepare() && board_init(&board_config.board)) {
        board_start(tick, 1U);
    } else {
        board_gate_trip();
    }
    for (;;) {
        if (!board_memory_is_whole()) {
            board_gate_trip();
        }
        board_watchdog_serve();
        BOARD_YIELD();
    }
}
