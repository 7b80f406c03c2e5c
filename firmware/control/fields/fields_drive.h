/* SPDX-License-Identifier: MIT */
/**
 * @file fields_drive.h
 * @brief Walk over the constants of a drive, without the law and its constants.
 */
#ifndef FIELDS_DRIVE_H
#define FIELDS_DRIVE_H

#include "drive_config.h"
#include "fields.h"

void fields_drive(fields_t *f, drive_config_t *c);

#endif /* FIELDS_DRIVE_H */
