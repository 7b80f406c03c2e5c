/* SPDX-License-Identifier: MIT */
/**
 * @file fields_app.h
 * @brief Walk over the constants of application and board; the table of temperatures is left as it is.
 */
#ifndef FIELDS_APP_H
#define FIELDS_APP_H

#include "app_config.h"
#include "fields.h"

void fields_app(fields_t *f, app_config_t *c);

#endif /* FIELDS_APP_H */
