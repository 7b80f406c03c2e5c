/* SPDX-License-Identifier: MIT */
/**
 * @file can_firmware.h
 * @brief A driver of eCAN-A in one function, with one mistake on demand. A test drives the mailboxes.
 */
#ifndef CAN_FIRMWARE_H
#define CAN_FIRMWARE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    CAN_MISTAKE_NONE = 0,
    CAN_MISTAKE_NO_CLOCK,
    CAN_MISTAKE_NO_EALLOW,
    CAN_MISTAKE_NO_PINS,     /**< GPIO30 stays a plain pin */
    CAN_MISTAKE_NO_FUNCTION, /**< CANTIOC left at 0 */
    CAN_MISTAKE_SCC,         /**< SCB left at 0 */
    CAN_MISTAKE_NO_CCR,      /**< bit timing changed in operation */
    CAN_MISTAKE_NO_TIMING,   /**< left at 0 */
    CAN_MISTAKE_ID_ENABLED,  /**< MSGID after CANME */
    CAN_MISTAKE_RMW,         /**< CANRMP |= */
    CAN_MISTAKE_LOST_FLAG,   /**< CANRML written */
    CAN_MISTAKE_DATA_LATE,   /**< data after the request */
    CAN_MISTAKE_INTERRUPT    /**< an interrupt enabled */
} can_firmware_mistake_t;

/** Set before a run. */
extern can_firmware_mistake_t can_firmware_mistake;
/** Bits of CANMC beside SCB and CCR, such as ABO and DBO. */
extern uint32_t can_firmware_mc;
/** CANBTC. */
extern uint32_t can_firmware_btc;
/** The loop sends mailbox 1, then mailbox 2, and takes mailbox 31, all in one pass, while this is set. */
extern volatile int      can_firmware_echo;
extern volatile uint32_t can_firmware_heard; /**< frames that the echo has taken */
extern volatile int      can_firmware_joined;

/**
 * Mailboxes: 31 takes 0x123; 30 and 29 take every 11-bit identifier, 30 protected; 28 takes the extended 0x1234567.
 * 1, 2 and 3 send 0x181, 0x182 and the extended 0x10000003; 4 answers requests of 0x184; 5 asks for 0x185.
 */
int can_firmware_main(void);

#ifdef __cplusplus
}
#endif

#endif /* CAN_FIRMWARE_H */
