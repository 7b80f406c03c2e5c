/* SPDX-License-Identifier: MIT */
/**
 * @file fields_app.h
 * @brief Serialises the constants of application and board, without the temperature table.
 */
#ifndef FIELDS_APP_H
#define FIELDS_APP_H

#include "app_config.h"
#include "fields.h"

/** Reads or writes all members of `c`, as `f` was created for. Context: init, loader. */
void fields_app(fields_t *f, app_config_t *c);

#endif /* FIELDS_APP_H */
