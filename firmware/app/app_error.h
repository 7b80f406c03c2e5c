/* SPDX-License-Identifier: MIT */
/**
 * @file app_error.h
 * @brief Faults as error codes of IEC 61800-7-201, object 603Fh.
 */
#ifndef APP_ERROR_H
#define APP_ERROR_H

#include "app_status.h"

/** 0 without a fault. */
uint16_t app_error_code(app_fault_t fault, drive_fault_t drive_fault);

#endif /* APP_ERROR_H */
