/* SPDX-License-Identifier: MIT */
/**
 * @file law_pid.h
 * @brief PID of the electrical speed error to the q voltage, paper B's law for comparison
 * (pid_law.h).
 */
#ifndef LAW_PID_H
#define LAW_PID_H

#include "law.h"
#include "pid_law.h"

typedef struct {
    pid_law_config_t pid;
    pid_law_config_t id_pi; /**< error in amperes, kd_tick = 0 */
} law_pid_config_t;

typedef struct {
    pid_law_t pid;
    pid_law_t id_pi;
} law_pid_state_t;

void law_pid_fields(fields_t *f, void *constants); /**< for law_pid.fields */

extern const law_t law_pid;

#endif /* LAW_PID_H */
