/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_node.h
 * @brief State of the CANopen node. Context: background.
 */
#ifndef APP_CANOPEN_NODE_H
#define APP_CANOPEN_NODE_H

#include "app_canopen_pdo.h"

/* Identifiers of CiA 301; the last four plus the number of the node. */
#define APP_CANOPEN_ID_NMT       0U
#define APP_CANOPEN_ID_SYNC      0x80U
#define APP_CANOPEN_ID_EMERGENCY 0x80U
#define APP_CANOPEN_ID_ANSWER    0x580U
#define APP_CANOPEN_ID_REQUEST   0x600U
#define APP_CANOPEN_ID_HEARTBEAT 0x700U

#define APP_CANOPEN_ERRORS 8U /**< kept by 1003h */

/** States of CiA 301, as a heartbeat has them. */
typedef enum {
    APP_CANOPEN_BOOTS           = 0, /**< has to say so; then pre-operational */
    APP_CANOPEN_STOPPED         = 4,
    APP_CANOPEN_OPERATIONAL     = 5,
    APP_CANOPEN_PRE_OPERATIONAL = 127
} app_canopen_state_t;

/* Emergency codes of the communication, by CiA 301. */
#define APP_CANOPEN_NO_ERROR    0x0000U
#define APP_CANOPEN_OVERRUN     0x8110U /**< a frame for this node had no room */
#define APP_CANOPEN_PASSIVE     0x8120U
#define APP_CANOPEN_HEARTBEAT   0x8130U /**< the watched one has gone */
#define APP_CANOPEN_BUS_BACK    0x8140U /**< was off the bus */
#define APP_CANOPEN_PDO_REFUSED 0x8200U /**< an object refused its value */
#define APP_CANOPEN_PDO_SHORT   0x8210U /**< fewer octets than its objects */
#define APP_CANOPEN_PDO_LATE    0x8250U /**< its event timer ran out */

/** Room of a transfer: octets of a text, or registers of a block. */
#define APP_CANOPEN_SDO_WORDS 64U

/** Most octets that are written to an object other than a block. */
#define APP_CANOPEN_SDO_MAX 16U

typedef enum {
    APP_CANOPEN_SDO_IDLE = 0,
    APP_CANOPEN_SDO_READS, /**< segments follow */
    APP_CANOPEN_SDO_WRITES
} app_canopen_sdo_stage_t;

typedef struct {
    app_canopen_sdo_stage_t stage;
    uint16_t                index;
    uint16_t                sub;
    uint16_t                toggle;
    uint16_t                at;     /**< octets done */
    uint16_t                count;  /**< of the object; while writing the announced number, or 0 */
    bool                    paired; /**< two octets in a word: registers, the low octet first */
    uint16_t                octets[APP_CANOPEN_SDO_WORDS];
    board_can_frame_t       answer;
    bool                    answers; /**< the answer waits for the bus */
} app_canopen_sdo_t;

typedef struct {
    uint16_t code; /**< emergency code */
    uint16_t more; /**< low octet: fault of the application, high octet: of the drive */
} app_canopen_error_t;

typedef struct {
    app_canopen_error_t errors[APP_CANOPEN_ERRORS]; /**< the newest first */
    uint16_t            count;                      /**< of these */
    uint16_t            unsent;        /**< the newest ones that the bus has not taken yet */
    uint16_t            fault;         /**< code of the fault that holds; 0: none */
    bool                communication; /**< an error of the communication holds */
} app_canopen_emergency_t;

/** PDOs that wait for SYNC, app_canopen_process_prepare(). */
typedef enum {
    APP_CANOPEN_SYNC_NEW = 0, /**< one came, or none waits */
    APP_CANOPEN_SYNC_REFUSED, /**< they act one by one */
    APP_CANOPEN_SYNC_PREPARED /**< the application has their command */
} app_canopen_sync_t;

typedef struct {
    app_canopen_state_t     state;
    uint16_t                node; /**< 1 .. 127 */
    uint16_t                rate_kbps;
    float                   ticks_per_ms;
    bool                    restart;      /**< of the whole drive, as soon as the bridge is off */
    uint32_t                asked_ticks;  /**< last request */
    uint16_t                bus;          /**< BOARD_CAN_ bits of the last pass */
    uint16_t                heartbeat_ms; /**< 1017h; 0: none */
    uint32_t                heartbeat_ticks; /**< sent */
    uint32_t                watched;       /**< 1016h: node in bits 16 to 22, milliseconds below */
    bool                    watches;       /**< has heard it */
    bool                    missed;        /**< it has gone */
    uint32_t                watched_ticks; /**< heard */
    bool                    stuck;         /**< a frame waits on a bus without errors */
    uint32_t                stuck_ticks;   /**< since then */
    uint32_t                block;         /**< selected registers, app_canopen_block.h */
    app_canopen_sdo_t       sdo;
    app_canopen_emergency_t emergency;
    app_canopen_sync_t      waiting;
    bool                    acted; /**< what was prepared is in the registers now */
    app_canopen_pdo_t       received[APP_CANOPEN_PDOS];
    app_canopen_pdo_t       sent[APP_CANOPEN_PDOS];
} app_canopen_t;

/** Sends a frame. @return false: the bus has no room yet. */
bool app_canopen_node_send(app_canopen_t *c, const board_can_frame_t *frame);

/** True if the time [ms] has passed since a tick. */
bool app_canopen_node_passed(const app_canopen_t *c, uint32_t since_ticks, uint32_t now_ticks,
                             float time_ms);

/** Tells the board the identifiers that this node listens to. */
void app_canopen_node_listen(const app_canopen_t *c);

#endif /* APP_CANOPEN_NODE_H */
