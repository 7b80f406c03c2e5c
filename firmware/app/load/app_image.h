/* SPDX-License-Identifier: MIT */
/**
 * @file app_image.h
 * @brief Which constants the drive runs with: the newest stored image that everything accepts, else what is compiled in.
 */
#ifndef APP_IMAGE_H
#define APP_IMAGE_H

#include "drive_image.h"
#include "store.h"

typedef struct {
    drive_image_t image;  /**< in force; the tick reads it */
    uint32_t      number; /**< of its writing (store.h); 0: compiled in */
} app_image_t;

/**
 * @brief Everything that has to accept the constants of an image: their own ranges, the board's registers, the application.
 *
 * Context: init before board_start(), or the loader: the application is initialised and not left as it was.
 */
drive_image_result_t app_image_check(const drive_image_t *image);

/**
 * @brief Makes the choice.
 *
 * @return false: what is compiled in has no law, or is too large; nothing may run.
 *
 * Context: init, before board_init().
 */
bool app_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive);

#endif /* APP_IMAGE_H */
