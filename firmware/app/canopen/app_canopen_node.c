/* SPDX-License-Identifier: MIT */
#include "app_canopen_node.h"

#include <stddef.h>

bool app_canopen_node_send(app_canopen_t *c, const board_can_frame_t *frame)
{
    const bool taken = board_can_write(frame);

    c->stuck = c->stuck || !taken;
    return taken;
}

bool app_canopen_node_passed(const app_canopen_t *c, uint32_t since_ticks, uint32_t now_ticks,
                             float time_ms)
{
    return (float)(uint32_t)(now_ticks - since_ticks) >= (time_ms * c->ticks_per_ms);
}

void app_canopen_node_listen(const app_canopen_t *c)
{
    const uint16_t watched = (uint16_t)((c->watched >> 16U) & 0x7FUL);
    uint16_t       ids[BOARD_CAN_IDS];
    uint16_t       count = 3U;

    ids[0] = APP_CANOPEN_ID_NMT;
    ids[1] = APP_CANOPEN_ID_SYNC;
    ids[2] = (uint16_t)(APP_CANOPEN_ID_REQUEST + c->node);
    for (uint16_t n = 0U; n < APP_CANOPEN_PDOS; n++) {
        if (app_canopen_pdo_is_used(&c->received[n])) {
            ids[count] = app_canopen_pdo_id(&c->received[n]);
            count      = (uint16_t)(count + 1U);
        }
    }
    if (watched != 0U) {
        ids[count] = (uint16_t)(APP_CANOPEN_ID_HEARTBEAT + watched);
        count      = (uint16_t)(count + 1U);
    }
    board_can_listen(ids, count);
}
