/* SPDX-License-Identifier: MIT */
/**
 * @file app_record.h
 * @brief The last 64 ticks before a fault: currents a and b, dc link, speed and three duty ratios, in this order, kept until the
 *        next fault.
 *
 * Two rings: the tick writes the one, the other keeps. At a fault they change places; no sample is moved.
 * Cost: seven values in every tick, about 50 instructions (listing for a Cortex-M4). Reader: what was read is whole when `number` has not changed meanwhile.
 */
#ifndef APP_RECORD_H
#define APP_RECORD_H

#include "app_scope_signals.h"

#define APP_RECORD_SAMPLES 64U /**< a power of two */
#define APP_RECORD_SIGNALS 7U

typedef struct {
    float    ring[2][APP_RECORD_SAMPLES][APP_RECORD_SIGNALS];
    uint16_t writes;     /**< the ring that the tick writes, 0 or 1 */
    uint16_t next;       /**< its place of the next sample */
    uint16_t count;      /**< its samples, at most all */
    uint16_t kept_next;  /**< of the other: the oldest one */
    uint16_t kept_count; /**< 0: there was no fault */
    uint16_t number;     /**< of the record kept; wraps */
    bool     was_fault;
} app_record_t;

/** Context: init. */
void app_record_init(app_record_t *r);

/** After everything else of a tick. Context: control ISR. */
void app_record_tick(app_record_t *r, const app_scope_view_t *view);

/** Of sample `at` of the record kept, 0 being the first, below kept_count. Context: background. */
float app_record_read(const volatile app_record_t *r, uint16_t at, uint16_t signal);

#endif /* APP_RECORD_H */
