/* SPDX-License-Identifier: MIT */
/**
 * @file board_config.h
 * @brief Constants of the board. For the F28335, sdre-gains generates them from the drive file.
 */
#ifndef BOARD_CONFIG_H
#define BOARD_CONFIG_H

#include "app_config.h"

extern const app_config_t board_config;

#endif /* BOARD_CONFIG_H */
