/* SPDX-License-Identifier: MIT */
/**
 * @file law_dobc.h
 * @brief CDOBC, GPIOBC and HDOBC of paper B: the observer's table tells them apart (dobc.h).
 */
#ifndef LAW_DOBC_H
#define LAW_DOBC_H

#include "dobc.h"
#include "law.h"
#include "pid_law.h"

typedef struct {
    dobc_config_t    dobc;
    pid_law_config_t id_pi; /**< error in amperes, kd_tick = 0 */
} law_dobc_config_t;

typedef struct {
    dobc_t    dobc;
    pid_law_t id_pi;
    float     direct_V; /**< u_qd of the last period */
} law_dobc_state_t;

void law_dobc_fields(fields_t *f, void *constants); /**< for law_dobc.fields */

extern const law_t law_dobc;

#endif /* LAW_DOBC_H */
