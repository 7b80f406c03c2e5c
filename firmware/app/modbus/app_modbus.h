/* SPDX-License-Identifier: MIT */
/**
 * @file app_modbus.h
 * @brief Modbus RTU server on the board's serial line: functions 3, 4, 6, 8, 16, 23 and 43/14,
 * broadcast writes.
 *
 * Silence, measured in control ticks, ends a frame. Other character times are not checked, as the
 * line is polled. The line must not echo transmitted octets.
 *
 * Not answered: a wrong CRC, another address, a broadcast, a length that does not fit the function.
 * Exceptions: 1 function, 2 address, 3 value or quantity, 4 not while the bridge is on.
 */
#ifndef APP_MODBUS_H
#define APP_MODBUS_H

#include "app_registers.h"

#define APP_MODBUS_FRAME_MAX 256U /**< octets, by the protocol */

#define APP_MODBUS_READ_MAX 125U /**< registers that fit an answer, by the protocol */

/** Counters of the line since the start, or since function 8 cleared them; they wrap. */
typedef struct {
    uint16_t frames;     /**< with a good CRC, for any server */
    uint16_t bad_frames; /**< wrong CRC, or too short for one */
    uint16_t exceptions; /**< exception answers */
    uint16_t requests;   /**< for this server, broadcasts included */
    uint16_t unanswered; /**< requests without an answer */
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
 * @brief Receives, answers and sends; call it in every background pass.
 *
 * One call takes at most 16 octets and answers at most one request.
 *
 * @param r         Registers to read and write, including own address and time-out.
 * @param now_ticks Control ticks, wraps.
 *
 * Context: background.
 */
void app_modbus_poll(app_modbus_t *m, app_registers_t *r, uint32_t now_ticks);

/**
 * @brief Sets the silence that ends a frame for a line: 3.5 octets or 1.75 ms, the longer one.
 *
 * @param least_ticks Lower limit of the silence, from the constants; it covers fast lines.
 *
 * Context: init.
 */
void app_modbus_follow(app_modbus_t *m, const board_line_t *line, float ts_s, uint16_t least_ticks);

/** True if the last answer is sent and enough time has passed for its last octets. */
bool app_modbus_is_quiet(const app_modbus_t *m, uint32_t now_ticks);

/** CRC of `count` octets. The line sends its low octet first. */
uint16_t app_modbus_crc(const uint16_t *octets, uint16_t count);

#endif /* APP_MODBUS_H */
