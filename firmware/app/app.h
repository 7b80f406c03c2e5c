/* SPDX-License-Identifier: MIT */
/**
 * @file app.h
 * @brief The drive application on a board: the tick in the control ISR, and the background.
 *
 * The tick owns everything that drives the bridge. The background owns the serial line, the
 * registers and the watchdog. The tick interrupts the background, never the reverse.
 *
 * They share data in app.c only, without masking interrupts:
 *
 * - Life sign of the background, tick count: each has one writer and is one aligned access, which
 *   the C28x does not split.
 * - Command: the background writes it only while its flag is false, then sets the flag. The tick
 *   takes the command and clears the flag. A command of PDOs that wait for SYNC is written before
 *   SYNC comes, and the tick takes it when the board has received SYNC. Until then the background
 *   may clear the flag.
 * - Missing ticks: the background sets the flag after it has opened the bridge. The next tick
 *   clears it.
 * - Status: the background reads data of the tick. It reads again if the tick count changed
 * meanwhile.
 *
 * Both sides watch each other. The background serves the watchdog only if a tick has ended since
 * the last service. It opens the bridge when ticks stop (app_watch_tick.h). A tick trips if the
 * background gives no life sign for config->background_ticks.
 */
#ifndef APP_H
#define APP_H

#include "app_config.h"
#include "app_image.h"
#include "app_parameters.h"
#include "app_status.h"

/**
 * @brief Initialises the application. The bridge stays off.
 *
 * @param config Board constants.
 * @param drive  Drive constants; must stay valid.
 * @return CTL_BAD_CONFIG: the application runs and communicates, but stays in APP_MODE_FAULT.
 *
 * Context: init, before board_start().
 */
ctl_status_t app_init(const app_config_t *config, const drive_config_t *drive);

/**
 * @brief Publishes the name of the constants over Modbus and enables the loader.
 *
 * With compiled-in constants of another board the application stays in APP_MODE_FAULT.
 * Without this call the registers of app_loader.h do not exist.
 *
 * Context: init, after app_init().
 */
void app_tell_image(const app_image_t *image);

/**
 * @brief Loads the stored parameters and sets up the serial line by them.
 *
 * Without this call the drive uses its defaults and cannot store parameters.
 *
 * @param done Result of a command to store parameters before the restart.
 *
 * Context: init, after app_init().
 */
void app_take_parameters(app_parameters_done_t done);

/** Executes one control period. Context: control ISR. */
void app_tick(void);

/** Executes one background pass; call it in an endless loop. Context: background. */
void app_background(void);

/**
 * @brief Gives a command (app_control.h), which acts from the next tick on.
 * @return false: the tick has not taken the previous command yet; retry after a tick.
 *
 * Context: background.
 */
bool app_command_write(const app_objects_t *command);

/** Status of one instant, after a recent tick. Context: background. */
app_status_t app_status_read(void);

/** The drive, for tracing; consistent only if no tick can interrupt. */
const drive_t *app_drive(void);

#endif /* APP_H */
