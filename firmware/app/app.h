/* SPDX-License-Identifier: MIT */
/**
 * @file app.h
 * @brief The drive application on a board: what runs in the control ISR and what runs behind it.
 *
 * The tick owns everything that drives the bridge; the background owns the serial line, the registers and the
 * watchdog. They share, in one place (app.c), without masking interrupts:
 *
 * | what | writer | how it stays whole |
 * |---|---|---|
 * | life sign of the background, tick count | one side each | one aligned access, which the C28x does not split |
 * | command | background | written only while its flag is down, then raised; the tick takes it and lowers the flag |
 * | missing ticks | background | raised by it after it has opened the bridge, lowered by the next tick |
 * | status | tick | the background reads what the tick keeps, and again when the tick count has moved meanwhile |
 *
 * The tick interrupts the background, never the other way round.
 *
 * Watchdog, both ways: the background serves it only when a tick has ended since it did so last; a tick trips
 * when the background has given no sign for config->background_ticks. The background opens the bridge when no tick ends
 * any more (app_watch_tick.h).
 */
#ifndef APP_H
#define APP_H

#include "app_config.h"
#include "app_image.h"
#include "app_parameters.h"
#include "app_status.h"

/**
 * @brief Everything to its start; the bridge stays off.
 *
 * @param config Board constants.
 * @param drive  Drive constants, must stay.
 * @return CTL_BAD_CONFIG: the application runs and answers, but stays in APP_MODE_FAULT.
 *
 * Context: init, before board_start().
 */
ctl_status_t app_init(const app_config_t *config, const drive_config_t *drive);

/**
 * @brief What the constants are called, for who asks over Modbus, and the way into the loader: without this call the
 *        registers of app_loader.h do not exist.
 *
 * Context: init, after app_init().
 */
void app_tell_image(const app_image_t *image);

/**
 * @brief What became of a command to store parameters, and the parameters that are stored, with the line that they ask
 *        for; without this call the drive has its defaults and stores nothing.
 *
 * Context: init, after app_init().
 */
void app_take_parameters(app_parameters_done_t done);

/** One control period. Context: control ISR. */
void app_tick(void);

/** One pass of the background; to be called for ever. Context: background. */
void app_background(void);

/**
 * @brief Give a command (app_control.h); it acts from the next tick on.
 * @return false: the command before has not been taken yet, try again after a tick.
 *
 * Context: background.
 */
bool app_command_write(const app_objects_t *command);

/** The status after the last tick during which nothing was read: of one instant. Context: background. */
app_status_t app_status_read(void);

/** The drive, for tracing; consistent only where no tick can interrupt. */
const drive_t *app_drive(void);

#endif /* APP_H */
