/* SPDX-License-Identifier: MIT */
/**
 * @file app_record.h
 * @brief Record of the last 64 ticks before a fault, kept until the next fault.
 *
 * A sample holds currents a and b, dc link, speed and three duty ratios, in this order. The tick
 * writes one ring, and the other ring keeps the record. At a fault the two swap roles; no sample is
 * moved.
 *
 * Cost: seven values in every tick, about 50 instructions (listing of a Cortex-M4). A reader has a
 * consistent record if `number` did not change while it read.
 */
#ifndef APP_RECORD_H
#define APP_RECORD_H

#include "app_part.h"
#include "app_scope_signals.h"

#define APP_RECORD_SAMPLES 64U /**< a power of two */
#define APP_RECORD_SIGNALS 7U

typedef struct {
    float    ring[2][APP_RECORD_SAMPLES][APP_RECORD_SIGNALS];
    uint16_t writes;     /**< the ring that the tick writes, 0 or 1 */
    uint16_t next;       /**< index of the next sample in it */
    uint16_t count;      /**< samples in it, <= APP_RECORD_SAMPLES */
    uint16_t kept_next;  /**< index of the oldest sample of the record */
    uint16_t kept_count; /**< 0: there was no fault */
    uint16_t number;     /**< of the record kept; wraps */
    bool     was_fault;
} app_record_t;

/** Clears both rings. Context: init. */
void app_record_init(app_record_t *r);

/** Call it at the end of a tick. Context: control ISR. */
APP_PART void app_record_tick(app_record_t *r, const app_scope_view_t *view);

/** Begins a new record and keeps this one. Context: control ISR, at a fault. */
void app_record_keep(app_record_t *r);

/** Reads a signal of sample `at` of the record, 0 .. kept_count - 1. Context: background. */
float app_record_read(const volatile app_record_t *r, uint16_t at, uint16_t signal);

#endif /* APP_RECORD_H */
