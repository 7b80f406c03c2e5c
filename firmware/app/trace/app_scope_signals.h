/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
/**
 * @file app_scope_signals.h
 * @brief Signals of the scope. Units: docs/modbus.md.
 */
#ifndef APP_SCOPE_SIGNALS_H
#define APP_SCOPE_SIGNALS_H

#include "app_modes.h"

enum {
    APP_SCOPE_NONE = 0,
    APP_SCOPE_SPEED = 1,
    APP_SCOPE_SPEED_MEASURED = 2,
    APP_SCOPE_SPEED_WANTED = 3,
    APP_SCOPE_IQ = 4,
    APP_SCOPE_ID = 5,
    APP_SCOPE_IQ_REF = 6,
    APP_SCOPE_ID_REF = 7,
    APP_SCOPE_VQ = 8,
    APP_SCOPE_VD = 9,
    APP_SCOPE_IA = 10,
    APP_SCOPE_IB = 11,
    APP_SCOPE_DC_LINK = 12,
    APP_SCOPE_THETA = 13,
    APP_SCOPE_DUTY_A = 14,
    APP_SCOPE_DUTY_B = 15,
    APP_SCOPE_DUTY_C = 16,
    APP_SCOPE_LOAD = 17,
    APP_SCOPE_MODE = 18,
    APP_SCOPE_EDGE = 19,
    APP_SCOPE_CHOPPER = 20,
    APP_SCOPE_SIGNALS = 21
};

/** The end of a tick. */
typedef struct {
    const app_modes_t   *modes;
    const app_command_t *command;
    const bridge_t      *out;
} app_scope_view_t;

/** 0 for a number that is none of them. Context: control ISR. One branch by a table of cases. */
float app_scope_signals_value(const app_scope_view_t *v, uint16_t signal);

#endif /* APP_SCOPE_SIGNALS_H */
