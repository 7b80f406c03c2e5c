/* SPDX-License-Identifier: MIT */
/* A CANopen node on the fake board, as a master sees it: frames in, frames out. */
#ifndef CANOPEN_BENCH_H
#define CANOPEN_BENCH_H

#include "app_canopen.h"
#include "fake_board.h"

#define BENCH_NODE 5

extern app_canopen_t   node;
extern app_registers_t registers;
extern uint32_t        now;

/** A node that has told its start; nothing of that is left on the bus. */
void bench_start(void);

/** Some control periods of 0.2 ms, with a poll each. */
void bench_run(int periods);
void bench_run_ms(double time_ms);

/** Sends a frame to the node, and polls until it has taken it. */
void bench_send(int id, int length, const int *octets);

/** The next frame of the node with this identifier; -1: there is none. Others are left out. */
int bench_take(int id, int *octets);

/** Number of frames with this identifier that the node has sent, and forgets all frames. */
int bench_count(int id);

/** NMT command. */
void bench_nmt(int command, int to);

/** Reads an object with up to 4 octets. @return its octets, or -1 and the abort code in value. */
int bench_read(int index, int sub, uint32_t *value);

/** Writes one. @return the abort code; 0: written. */
uint32_t bench_write(int index, int sub, uint32_t value, int octets);

#endif /* CANOPEN_BENCH_H */
