/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen.h
 * @brief CANopen node of CiA 301 and CiA 402 on the board's CAN bus. docs/canopen.md describes it.
 *
 * Connection lost: off the bus, a heartbeat or a received PDO that is late, or a command out of the
 * operational state. It stops the drive by LOST_OPTION if CAN wrote the control word last.
 */
#ifndef APP_CANOPEN_H
#define APP_CANOPEN_H

#include "app_canopen_node.h"

/** Chosen: most frames that one background pass takes. Eight objects in each take 0.2 ms. */
#define APP_CANOPEN_FRAMES 2U

/** Not on the bus yet. @param ts_s Control period [s]. Context: init. */
void app_canopen_init(app_canopen_t *c, float ts_s);

/** Goes onto the bus with the node number and bit rate of the registers. Context: init. */
void app_canopen_start(app_canopen_t *c, const app_registers_t *r);

/** Receives, answers and sends; call it in every background pass. @param now_ticks Control ticks,
 * wraps. */
void app_canopen_poll(app_canopen_t *c, app_registers_t *r, uint32_t now_ticks);

/** True if no answer waits and the bus has had time to send the last one. */
bool app_canopen_is_quiet(const app_canopen_t *c, uint32_t now_ticks);

#endif /* APP_CANOPEN_H */
