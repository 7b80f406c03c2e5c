/* SPDX-License-Identifier: MIT */
/**
 * @file app_modbus_device.h
 * @brief Modbus functions 8, diagnostics of the line, and 43/14, device identification.
 */
#ifndef APP_MODBUS_DEVICE_H
#define APP_MODBUS_DEVICE_H

#include "app_modbus.h"

/** Function 8: loop-back and the counts. Context: background. */
void app_modbus_device_diagnose(app_modbus_t *m);

/** Function 43 with MEI type 14. Context: background. */
void app_modbus_device_identify(app_modbus_t *m, const app_registers_t *r);

#endif /* APP_MODBUS_DEVICE_H */
