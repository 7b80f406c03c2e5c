/* SPDX-License-Identifier: MIT */
/**
 * @file fields_pid_law.h
 * @brief Walk over the constants of a PID.
 */
#ifndef FIELDS_PID_LAW_H
#define FIELDS_PID_LAW_H

#include "fields.h"
#include "pid_law.h"

void fields_pid_law(fields_t *f, pid_law_config_t *c);

#endif /* FIELDS_PID_LAW_H */
