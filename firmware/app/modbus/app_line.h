/* SPDX-License-Identifier: MIT */
/**
 * @file app_line.h
 * @brief State of the lines: the application or the loader has them.
 *
 * A start runs one of them until the next restart. So both have the same memory.
 */
#ifndef APP_LINE_H
#define APP_LINE_H

#include "app_canopen.h"
#include "app_loader.h"
#include "app_modbus.h"
#include "app_parameters.h"
#include "app_registers.h"

typedef struct {
    app_modbus_t     modbus;
    app_registers_t  registers;
    app_loader_t     loader;
    app_parameters_t parameters;
    app_canopen_t    canopen;
} app_line_t;

/** Background only. */
extern app_line_t app_line;

#endif /* APP_LINE_H */
