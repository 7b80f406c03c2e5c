/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_dictionary.h
 * @brief All objects of the node: its own, and those of app_canopen_objects.h. Context: background.
 */
#ifndef APP_CANOPEN_DICTIONARY_H
#define APP_CANOPEN_DICTIONARY_H

#include "app_canopen_node.h"

/**
 * @brief Reads an object.
 *
 * @param octets Room for APP_CANOPEN_SDO_WORDS, the low octet of a number first.
 * @param count  Number of them.
 * @return an abort code.
 */
uint32_t app_canopen_dictionary_read(const app_canopen_t *c, const app_registers_t *r,
                                     uint16_t index, uint16_t sub, uint16_t *octets,
                                     uint16_t *count);

/** Writes `count` octets; 0: as many as the object has, of at least four. @return an abort code. */
uint32_t app_canopen_dictionary_write(app_canopen_t *c, app_registers_t *r, uint16_t index,
                                      uint16_t sub, const uint16_t *octets, uint16_t count);

#endif /* APP_CANOPEN_DICTIONARY_H */
