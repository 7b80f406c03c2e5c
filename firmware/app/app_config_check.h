/* SPDX-License-Identifier: MIT */
/**
 * @file app_config_check.h
 * @brief Checks the constants of an application with its drive. It changes nothing.
 */
#ifndef APP_CONFIG_CHECK_H
#define APP_CONFIG_CHECK_H

#include "app_config.h"

/**
 * @brief Checks every range, and what configuration and drive must agree about: control period,
 * encoder, dead time, dc link.
 *
 * @return CTL_BAD_CONFIG: app_init() of these constants stays in APP_MODE_FAULT.
 *
 * Context: init, or the loader.
 */
ctl_status_t app_config_check(const app_config_t *config, const drive_config_t *drive);

#endif /* APP_CONFIG_CHECK_H */
