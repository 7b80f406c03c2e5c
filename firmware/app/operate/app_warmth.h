/* SPDX-License-Identifier: MIT */
/**
 * @file app_warmth.h
 * @brief Slow measurements, app_slow.h: temperature, dc link for a start, thermal model.
 *
 * The thermal model takes the current vector of one period. A ripple of i^2 counts with its phase
 * there if its frequency is a multiple of 1 kHz.
 */
#ifndef APP_WARMTH_H
#define APP_WARMTH_H

#include "app_modes.h"

/** Starts with an unknown temperature. Context: init. */
void app_warmth_init(app_modes_t *m, const app_config_t *config, const drive_config_t *drive);

/** Heat sink, of a valid sample. Context: control ISR. */
void app_warmth_sink(app_modes_t *m, const board_sample_t *raw);

/** Thermal model and dc link, of a valid sample. Context: control ISR. */
void app_warmth_heat(app_modes_t *m);

#endif /* APP_WARMTH_H */
