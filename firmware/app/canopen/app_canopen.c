/* SPDX-License-Identifier: MIT */
#include "app_canopen.h"

#include "app_canopen_block.h"
#include "app_canopen_emergency.h"
#include "app_canopen_process.h"
#include "app_canopen_sdo.h"

/* NMT commands. */
#define START               1U
#define STOP                2U
#define ENTER_PRE           128U
#define RESET_NODE          129U
#define RESET_COMMUNICATION 130U

#define QUIET_ms 20.0f   /* chosen: two answers at 125 kbit/s on a bus that others fill by 80 % */
#define STUCK_ms 1000.0f /* chosen: on a full bus a frame may wait for long */

void app_canopen_init(app_canopen_t *c, float ts_s)
{
    static const app_canopen_t none = {.state = APP_CANOPEN_BOOTS, .node = 1U};

    *c              = none;
    c->ticks_per_ms = 1.0e-3f / ts_s;
}

/* All objects of the communication are as after power-on. */
void app_canopen_start(app_canopen_t *c, const app_registers_t *r)
{
    c->node         = r->requested.can_node;
    c->rate_kbps    = r->requested.can_rate_kbps;
    c->state        = APP_CANOPEN_BOOTS;
    c->heartbeat_ms = 0U;
    c->watched      = 0UL;
    c->watches      = false;
    c->missed       = false;
    c->stuck        = false;
    c->block        = APP_CANOPEN_BLOCK_START;
    c->sdo.stage    = APP_CANOPEN_SDO_IDLE;
    c->sdo.answers  = false;
    app_canopen_process_reset(c);
    board_can_set(c->rate_kbps);
    app_canopen_node_listen(c);
}

/* Stops the drive if this bus commands it. */
static void lose_connection(app_registers_t *r)
{
    if (r->by_can) {
        app_registers_silence(r);
    }
}

/* The communication ends by itself: the node waits for its master. */
static void lose_master(app_canopen_t *c, app_registers_t *r)
{
    lose_connection(r);
    if (c->state == APP_CANOPEN_OPERATIONAL) {
        c->state = APP_CANOPEN_PRE_OPERATIONAL;
    }
}

static void go_to(app_canopen_t *c, app_registers_t *r, app_canopen_state_t to, uint32_t now_ticks)
{
    if ((c->state == APP_CANOPEN_OPERATIONAL) && (to != APP_CANOPEN_OPERATIONAL)) {
        lose_connection(r);
    } else if ((c->state != to) && (to == APP_CANOPEN_OPERATIONAL)) {
        app_canopen_process_start(c, now_ticks);
    } else {
        /* it is there, or no PDO counts */
    }
    c->state = to;
}

static void obey(app_canopen_t *c, app_registers_t *r, uint16_t what, uint32_t now_ticks)
{
    switch (what) {
    case START:
        go_to(c, r, APP_CANOPEN_OPERATIONAL, now_ticks);
        break;
    case STOP:
        lose_connection(r);
        go_to(c, r, APP_CANOPEN_STOPPED, now_ticks);
        break;
    case ENTER_PRE:
        go_to(c, r, APP_CANOPEN_PRE_OPERATIONAL, now_ticks);
        break;
    case RESET_NODE:
        c->restart = r->by_can || !r->status.gate_enable; /* not in a run that Modbus commands */
        lose_connection(r);
        app_canopen_start(c, r);
        break;
    case RESET_COMMUNICATION:
        lose_connection(r);
        app_canopen_start(c, r);
        break;
    default:
        break; /* no command of CiA 301 */
    }
}

static void take_nmt(app_canopen_t *c, app_registers_t *r, const board_can_frame_t *frame,
                     uint32_t now_ticks)
{
    const uint16_t to = frame->octets[1];

    if ((frame->length >= 2U) && (c->state != APP_CANOPEN_BOOTS) &&
        ((to == 0U) || (to == c->node))) {
        obey(c, r, frame->octets[0], now_ticks);
    }
}

static void hear_frame(app_canopen_t *c, app_registers_t *r, const board_can_frame_t *frame,
                       uint32_t now_ticks)
{
    const bool operational = c->state == APP_CANOPEN_OPERATIONAL;
    const bool talks       = operational || (c->state == APP_CANOPEN_PRE_OPERATIONAL);

    if (frame->id == APP_CANOPEN_ID_NMT) {
        take_nmt(c, r, frame, now_ticks);
    } else if (frame->id == APP_CANOPEN_ID_SYNC) {
        if (operational) {
            app_canopen_process_sync(c, r);
        }
    } else if (frame->id == (APP_CANOPEN_ID_REQUEST + c->node)) {
        if (talks) {
            c->asked_ticks = now_ticks;
            app_canopen_sdo_take(c, r, frame);
        }
    } else if (frame->id >= APP_CANOPEN_ID_HEARTBEAT) {
        c->watches       = true;
        c->missed        = false;
        c->watched_ticks = now_ticks;
    } else if (operational) {
        app_canopen_process_take(c, r, frame, now_ticks);
    } else {
        /* PDOs count while the node is operational */
    }
}

static void hear_frames(app_canopen_t *c, app_registers_t *r, uint32_t now_ticks)
{
    board_can_frame_t frame = {.id = 0U};
    uint16_t          taken = 0U;

    while ((taken < APP_CANOPEN_FRAMES) && !c->sdo.answers && board_can_read(&frame)) {
        taken = (uint16_t)(taken + 1U);
        hear_frame(c, r, &frame, now_ticks);
    }
}

/* The heartbeat of another node, if 1016h names one, and the deadlines of PDOs. */
static void watch_others(app_canopen_t *c, app_registers_t *r, uint32_t now_ticks)
{
    const uint32_t time_ms   = c->watched & 0xFFFFUL;
    const float    period_ms = (float)time_ms;

    if (c->watches && (period_ms > 0.0f) &&
        app_canopen_node_passed(c, c->watched_ticks, now_ticks, period_ms)) {
        c->watches = false;
        c->missed  = true;
        app_canopen_emergency_tell(&c->emergency, APP_CANOPEN_HEARTBEAT);
        lose_master(c, r);
    }
    if ((c->state == APP_CANOPEN_OPERATIONAL) && app_canopen_process_late(c, now_ticks)) {
        app_canopen_emergency_tell(&c->emergency, APP_CANOPEN_PDO_LATE);
        lose_master(c, r);
    }
}

/* True if the bit is new in this pass. */
static bool is_new(uint16_t now, uint16_t before, int bit)
{
    return ((uint16_t)(now & (uint16_t)~before) & (uint16_t)bit) != 0U;
}

static void watch_bus(app_canopen_t *c, app_registers_t *r)
{
    const uint16_t before = c->bus;
    const uint16_t now    = board_can_state();

    c->bus = now;
    if (is_new(now, before, BOARD_CAN_OFF)) {
        lose_master(c, r);
    } else if (is_new(before, now, BOARD_CAN_OFF)) {
        app_canopen_emergency_tell(&c->emergency, APP_CANOPEN_BUS_BACK);
    } else if (is_new(now, before, BOARD_CAN_PASSIVE)) {
        app_canopen_emergency_tell(&c->emergency, APP_CANOPEN_PASSIVE);
    } else {
        /* as before */
    }
    if (is_new(now, 0U, BOARD_CAN_LOST)) {
        app_canopen_emergency_tell(&c->emergency, APP_CANOPEN_OVERRUN);
    }
}

/* The transmitter of some devices ceases although the bus has no errors (advisory of SPRZ272). A
 * start of the controller ends that. */
static void watch_sender(app_canopen_t *c, uint32_t now_ticks)
{
    if (!c->stuck || (c->bus != 0U)) {
        c->stuck_ticks = now_ticks;
    } else if (app_canopen_node_passed(c, c->stuck_ticks, now_ticks, STUCK_ms)) {
        c->stuck_ticks = now_ticks;
        board_can_set(c->rate_kbps);
    } else {
        /* it waits for the bus */
    }
    c->stuck = false;
}

static bool send_state(app_canopen_t *c, uint32_t now_ticks)
{
    board_can_frame_t frame = {.id = (uint16_t)(APP_CANOPEN_ID_HEARTBEAT + c->node), .length = 1U};

    frame.octets[0] = (uint16_t)c->state;
    const bool sent = app_canopen_node_send(c, &frame);

    if (sent) {
        c->heartbeat_ticks = now_ticks;
    }
    return sent;
}

static void say_all(app_canopen_t *c, const app_registers_t *r, uint32_t now_ticks)
{
    if (c->state == APP_CANOPEN_BOOTS) {
        if (send_state(c, now_ticks)) {
            c->state = APP_CANOPEN_PRE_OPERATIONAL;
        }
    } else if ((c->heartbeat_ms > 0U) &&
               app_canopen_node_passed(c, c->heartbeat_ticks, now_ticks, (float)c->heartbeat_ms)) {
        (void)send_state(c, now_ticks);
    } else {
        /* nothing to say */
    }
    app_canopen_sdo_send(c);
    if ((c->state == APP_CANOPEN_OPERATIONAL) || (c->state == APP_CANOPEN_PRE_OPERATIONAL)) {
        app_canopen_emergency_send(c);
    }
    if (c->state == APP_CANOPEN_OPERATIONAL) {
        app_canopen_process_send(c, r, now_ticks);
    }
}

void app_canopen_poll(app_canopen_t *c, app_registers_t *r, uint32_t now_ticks)
{
    watch_bus(c, r);
    hear_frames(c, r, now_ticks);
    watch_others(c, r, now_ticks);
    app_canopen_emergency_hold(&c->emergency, (c->bus != 0U) || c->missed);
    app_canopen_emergency_see(&c->emergency, &r->status);
    say_all(c, r, now_ticks);
    watch_sender(c, now_ticks);
}

bool app_canopen_is_quiet(const app_canopen_t *c, uint32_t now_ticks)
{
    return !c->sdo.answers && app_canopen_node_passed(c, c->asked_ticks, now_ticks, QUIET_ms);
}
