/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_emergency.h
 * @brief Emergencies of CiA 301 and their history. Context: background.
 */
#ifndef APP_CANOPEN_EMERGENCY_H
#define APP_CANOPEN_EMERGENCY_H

#include "app_canopen_node.h"

/** Notes an error of the communication. */
void app_canopen_emergency_tell(app_canopen_emergency_t *e, uint16_t code);

/** Notes the end of such errors. @param holds One of them still holds. */
void app_canopen_emergency_hold(app_canopen_emergency_t *e, bool holds);

/** Notes a new fault of the drive, or its end. */
void app_canopen_emergency_see(app_canopen_emergency_t *e, const app_status_t *status);

/** Object 1001h. */
uint16_t app_canopen_emergency_register(const app_canopen_emergency_t *e);

/** Sends the oldest one that is not sent yet. */
void app_canopen_emergency_send(app_canopen_t *c);

/** Reads sub-index `sub` of 1003h. @return an abort code. */
uint32_t app_canopen_emergency_kept(const app_canopen_emergency_t *e, uint16_t sub, uint32_t *value,
                                    uint16_t *octets);

#endif /* APP_CANOPEN_EMERGENCY_H */
