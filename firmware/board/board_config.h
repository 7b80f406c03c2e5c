/* SPDX-License-Identifier: MIT */
/**
 * @file board_config.h
 * @brief The constants of the board that is built; sdre-gains makes those of the F28335 from the drive file.
 */
#ifndef BOARD_CONFIG_H
#define BOARD_CONFIG_H

#include "app_config.h"

extern const app_config_t board_config;

#endif /* BOARD_CONFIG_H */
