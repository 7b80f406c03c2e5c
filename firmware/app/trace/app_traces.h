/* SPDX-License-Identifier: MIT */
/**
 * @file app_traces.h
 * @brief Samples of scope and record as input registers.
 *
 * A value is an IEEE 754 single in two registers, high word first:
 *
 *     APP_TRACES_SCOPE + 2 (4 sample + channel)     while the scope is DONE
 *     APP_TRACES_RECORD + 2 (7 sample + signal)     while there is a record
 *
 * Samples are in order of time. Context: background.
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
    APP_TRACES_NOT_NOW /**< there are no samples, or sampling is in progress */
} app_traces_result_t;

/** Reads `count` registers from `first` on, >= APP_TRACES_SCOPE. */
app_traces_result_t app_traces_read(const volatile app_scope_t  *scope,
                                    const volatile app_record_t *record, uint16_t first,
                                    uint16_t count, uint16_t *values);

#endif /* APP_TRACES_H */
