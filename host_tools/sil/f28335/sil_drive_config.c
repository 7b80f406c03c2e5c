/* SPDX-License-Identifier: MIT */
/* In the simulation, main() uses these constants instead of the generated tables. They are set from
 * the scenario's drive before each run. */
#include "app_config.h"
#include "board_identity.h"
#include "drive_config.h"

extern drive_config_t   sil_drive_config;
extern app_config_t     sil_board_config;
extern board_identity_t sil_board_identity;

drive_config_t   sil_drive_config;
app_config_t     sil_board_config;
board_identity_t sil_board_identity;
