/* SPDX-License-Identifier: MIT */
/**
 * @file app_board_check.h
 * @brief Compares the constants of a drive with the facts of the board.
 *
 * An image names the board it was made for, but its constants may still be others. Those that
 * follow from the board must follow from it, and the limits of the drive must be within its own.
 */
#ifndef APP_BOARD_CHECK_H
#define APP_BOARD_CHECK_H

#include "app_config.h"
#include "board_identity.h"
#include "drive_config.h"

/**
 * @return First constant that contradicts the board, with the name of the board's fact. Values are
 *         in the unit of the fact.
 *
 * Context: init, loader.
 */
board_difference_t app_board_check(const board_identity_t *board, const app_config_t *config,
                                   const drive_config_t *drive);

#endif /* APP_BOARD_CHECK_H */
