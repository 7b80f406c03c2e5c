/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_process.h
 * @brief When PDOs are taken and sent. Context: background.
 */
#ifndef APP_CANOPEN_PROCESS_H
#define APP_CANOPEN_PROCESS_H

#include "app_canopen_node.h"

/** As after power-on. */
void app_canopen_process_reset(app_canopen_t *c);

/** Nothing of the time before counts. Context: the node has become operational. */
void app_canopen_process_start(app_canopen_t *c, uint32_t now_ticks);

/** Takes a frame if it is a PDO. */
void app_canopen_process_take(app_canopen_t *c, app_registers_t *r, const board_can_frame_t *frame,
                              uint32_t now_ticks);

/** SYNC: PDOs that wait for it act, and those that it asks for are read. */
void app_canopen_process_sync(app_canopen_t *c, app_registers_t *r);

/**
 * @brief Tries PDOs that wait for SYNC, once after the last of them came.
 * @return true: `r->trial` is the request that SYNC will make. False: none waits, or they have to
 *         act one by one. Then an object refuses its value, or the mode of operation changes.
 */
bool app_canopen_process_prepare(app_canopen_t *c, app_registers_t *r);

/** True while these PDOs wait for SYNC, and no other has come. */
bool app_canopen_process_is_prepared(const app_canopen_t *c);

/** Sends what is due. */
void app_canopen_process_send(app_canopen_t *c, const app_registers_t *r, uint32_t now_ticks);

/** True once when a received PDO is later than its event timer. */
bool app_canopen_process_late(app_canopen_t *c, uint32_t now_ticks);

#endif /* APP_CANOPEN_PROCESS_H */
