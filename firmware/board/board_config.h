/* SPDX-License-Identifier: MIT */
/**
 * @file board_config.h
 * @brief Constants of the board. For the F28335, sdre-gains generates them from drive and board
 * file.
 */
#ifndef BOARD_CONFIG_H
#define BOARD_CONFIG_H

#include "app_config.h"
#include "board_identity.h"

extern const app_config_t board_config;

/** The board that this firmware is for; host_stub has none and takes no image. */
extern const board_identity_t board_identity;

#endif /* BOARD_CONFIG_H */
