/* SPDX-License-Identifier: MIT */
/* In the simulation main() binds the application to this instead of the generated table; it is written before each
 * run, with the constants of the scenario's controller. */
#include "drive_config.h"

extern drive_config_t sil_drive_config;

drive_config_t sil_drive_config;
