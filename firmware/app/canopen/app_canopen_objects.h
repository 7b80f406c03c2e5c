/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_objects.h
 * @brief The registers as objects of CANopen, and constant objects. Context: background.
 *
 * Values have the counts of the registers. An object may have fewer octets than its register, or
 * more.
 */
#ifndef APP_CANOPEN_OBJECTS_H
#define APP_CANOPEN_OBJECTS_H

#include "app_canopen_abort.h"
#include "app_canopen_map.h"
#include "app_registers.h"

/** @return APP_CANOPEN_OK, _NO_OBJECT or _NO_SUB. */
uint32_t app_canopen_objects_find(uint16_t index, uint16_t sub, app_canopen_object_t *found);

/** Value of an object, with its sign in all 32 bits. */
uint32_t app_canopen_objects_value(const app_registers_t *r, const app_canopen_object_t *o);

/** Writes the low octets of `value` to a holding register. @return an abort code. */
uint32_t app_canopen_objects_write(app_registers_t *r, const app_registers_entry_t *entry,
                                   uint16_t octets, uint32_t value);

/** Tries the same, app_registers_try(). @return false: it is refused. */
bool app_canopen_objects_try(app_registers_t *r, const app_registers_entry_t *entry,
                             uint16_t octets, uint32_t value);

/** Writes any object. @return an abort code. */
uint32_t app_canopen_objects_put(app_registers_t *r, const app_canopen_object_t *o, uint32_t value);

/** Writes holding registers; they act together, or none does. @return an abort code. */
uint32_t app_canopen_objects_write_words(app_registers_t *r, uint16_t first, uint16_t count,
                                         const uint16_t *words);

/** Abort code for the result of the registers. */
uint32_t app_canopen_objects_result(app_registers_result_t result);

#endif /* APP_CANOPEN_OBJECTS_H */
