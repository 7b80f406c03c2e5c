/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_sdo.h
 * @brief SDO server of CiA 301: expedited and segmented transfers. Context: background.
 *
 * A transfer that its client leaves unfinished ends with the client's next request.
 */
#ifndef APP_CANOPEN_SDO_H
#define APP_CANOPEN_SDO_H

#include "app_canopen_node.h"

/** Takes a request, and makes its answer. */
void app_canopen_sdo_take(app_canopen_t *c, app_registers_t *r, const board_can_frame_t *request);

/** Sends the answer as soon as the bus has room. */
void app_canopen_sdo_send(app_canopen_t *c);

#endif /* APP_CANOPEN_SDO_H */
