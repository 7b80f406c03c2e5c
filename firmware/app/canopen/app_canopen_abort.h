/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_abort.h
 * @brief Why an object is not read or written: abort codes of CiA 301.
 */
#ifndef APP_CANOPEN_ABORT_H
#define APP_CANOPEN_ABORT_H

#include <stdint.h>

#define APP_CANOPEN_OK ((uint32_t)0UL)
/** A segment came twice, or one is missing. */
#define APP_CANOPEN_TOGGLE ((uint32_t)0x05030000UL)
/** Unknown command; block transfers too. */
#define APP_CANOPEN_COMMAND      ((uint32_t)0x05040001UL)
#define APP_CANOPEN_READ_ONLY    ((uint32_t)0x06010002UL)
#define APP_CANOPEN_NO_OBJECT    ((uint32_t)0x06020000UL)
#define APP_CANOPEN_NOT_MAPPABLE ((uint32_t)0x06040041UL)
/** More than the eight octets of a PDO. */
#define APP_CANOPEN_TOO_MUCH ((uint32_t)0x06040042UL)
#define APP_CANOPEN_LENGTH   ((uint32_t)0x06070010UL)
#define APP_CANOPEN_NO_SUB   ((uint32_t)0x06090011UL)
/** Out of range. */
#define APP_CANOPEN_VALUE ((uint32_t)0x06090030UL)
/** Not now. */
#define APP_CANOPEN_STATE ((uint32_t)0x08000022UL)

#endif /* APP_CANOPEN_ABORT_H */
