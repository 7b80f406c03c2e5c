/* SPDX-License-Identifier: MIT */
/**
 * @file app_traces.h
 * @brief What scope and record hold, as input registers: two a value, single precision of IEEE 754, high word first.
 *
 *     APP_TRACES_SCOPE + 2 (4 sample + channel)     while the scope is DONE
 *     APP_TRACES_RECORD + 2 (7 sample + signal)     while there is a record
 *
 * Samples in the order of time. Context: background.
 */
#ifndef APP_TRACES_H
#define APP_TRACES_H

#include "app_record.h"
#include "app_scope.h"

#define APP_TRACES_SCOPE  16384U
#define APP_TRACES_RECORD 24576U

typedef enum {
    APP_TRACES_OK = 0,
    APP_TRACES_BAD_ADDRESS,
    APP_TRACES_NOT_NOW /**< nothing was taken, or it is being taken */
} app_traces_result_t;

/** `count` registers from `first`, which is APP_TRACES_SCOPE or more, on. */
app_traces_result_t app_traces_read(const volatile app_scope_t  *scope,
                                    const volatile app_record_t *record, uint16_t first,
                                    uint16_t count, uint16_t *values);

#endif /* APP_TRACES_H */
