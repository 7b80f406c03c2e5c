/* SPDX-License-Identifier: MIT */
/**
 * @file app_modbus_frame.h
 * @brief Words of a Modbus request, and octets of its answer. Context: background.
 */
#ifndef APP_MODBUS_FRAME_H
#define APP_MODBUS_FRAME_H

#include "app_modbus.h"

/** Exceptions, by the protocol. */
enum {
    APP_MODBUS_NO_FUNCTION = 1,
    APP_MODBUS_NO_ADDRESS  = 2,
    APP_MODBUS_NO_VALUE    = 3,
    APP_MODBUS_NOT_NOW     = 4
};

/** Function code of the request. */
uint16_t app_modbus_frame_function(const app_modbus_t *m);

/** Two octets of the request, the high one first. */
uint16_t app_modbus_frame_asked(const app_modbus_t *m, uint16_t at);

/** Begins the answer of the request's function. */
void app_modbus_frame_begin(app_modbus_t *m);

/** Adds an octet to the answer, unless the frame is full. */
void app_modbus_frame_octet(app_modbus_t *m, uint16_t octet);

/** Adds two octets, the high one first. */
void app_modbus_frame_word(app_modbus_t *m, uint16_t word);

/** Replaces the answer by an exception. */
void app_modbus_frame_exception(app_modbus_t *m, uint16_t exception);

#endif /* APP_MODBUS_FRAME_H */
