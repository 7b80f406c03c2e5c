/* SPDX-License-Identifier: MIT */
/* In the simulation main() binds board and application to these instead of the generated tables; they are written before each
 * run, with the constants of the scenario's drive. */
#include "app_config.h"
#include "drive_config.h"

extern drive_config_t sil_drive_config;
extern app_config_t   sil_board_config;

drive_config_t sil_drive_config;
app_config_t   sil_board_config;
