/* SPDX-License-Identifier: MIT */
/**
 * @file board_f28335.h
 * @brief Constants of the F28335 board; derivations stand beside the values.
 */
#ifndef BOARD_F28335_H
#define BOARD_F28335_H

#include "app_config.h"

extern const app_config_t board_f28335_config;

#endif /* BOARD_F28335_H */
