/* SPDX-License-Identifier: MIT */
/**
 * @file app_modbus.h
 * @brief Modbus RTU server on the board's serial line: functions 3, 4, 6, 8, 16, 23 and 43/14, broadcast writes.
 *
 * A frame ends by silence, measured in control ticks. Every other character time is not checked: the line is polled.
 * The line must not echo what is sent.
 *
 * Not answered: a wrong CRC, another address, a broadcast, a length that does not fit the function.
 * Exceptions: 1 function, 2 address, 3 value or quantity, 4 not while the bridge is on.
 */
#ifndef APP_MODBUS_H
#define APP_MODBUS_H

#include "app_registers.h"

#define APP_MODBUS_FRAME_MAX 256U /**< octets, by the protocol */

#define APP_MODBUS_READ_MAX 125U /**< registers that fit an answer, by the protocol */

/** What the line has seen since the start or since function 8 has set them to 0; they wrap. */
typedef struct {
    uint16_t frames;     /**< of anyone, with a good CRC */
    uint16_t bad_frames; /**< wrong CRC, or too short for one */
    uint16_t exceptions; /**< answers that were one */
    uint16_t requests;   /**< for this server, broadcasts included */
    uint16_t unanswered; /**< of these */
    uint16_t overruns;   /**< longer than any frame, or came while answering */
} app_modbus_counts_t;

typedef struct {
    uint16_t            gap_ticks; /**< silence that ends a frame */
    uint16_t            address;   /**< own, of the request at hand */
    uint16_t            rx_octets[APP_MODBUS_FRAME_MAX];
    uint16_t            rx_count;
    bool                rx_spoilt; /**< longer than any frame, or came while answering */
    uint16_t            tx_octets[APP_MODBUS_FRAME_MAX];
    uint16_t            tx_count;
    uint16_t            tx_sent;
    uint16_t            values[APP_MODBUS_READ_MAX]; /**< read or to be written */
    uint32_t            heard_ticks;                 /**< last octet */
    uint32_t            request_ticks;               /**< last request for this server */
    app_modbus_counts_t counts;
} app_modbus_t;

/** @return CTL_BAD_CONFIG when the gap is 0. Context: init. */
ctl_status_t app_modbus_init(app_modbus_t *m, uint16_t gap_ticks);

/**
 * @brief Receive, answer, send; to be called again and again.
 *
 * At most 16 octets are taken and one request is answered per call.
 *
 * @param r         Registers to read and write; own address and time-out are among them.
 * @param now_ticks Control ticks, wraps.
 *
 * Context: background.
 */
void app_modbus_poll(app_modbus_t *m, app_registers_t *r, uint32_t now_ticks);

/**
 * @brief Follows a line: the silence that ends a frame is 3.5 octets or 1.75 ms, whichever is longer, by the protocol.
 *
 * @param least_ticks Of the fast lines, from the constants.
 *
 * Context: init.
 */
void app_modbus_follow(app_modbus_t *m, const board_line_t *line, float ts_s, uint16_t least_ticks);

/** True when the last answer is out and a while has passed in which its last octets left the board. */
bool app_modbus_is_quiet(const app_modbus_t *m, uint32_t now_ticks);

/** CRC of `count` octets; its low octet is sent first. */
uint16_t app_modbus_crc(const uint16_t *octets, uint16_t count);

#endif /* APP_MODBUS_H */
