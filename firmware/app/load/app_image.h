/* SPDX-License-Identifier: MIT */
/**
 * @file app_image.h
 * @brief Chooses the drive's constants: the newest valid stored image, else the compiled-in ones.
 */
#ifndef APP_IMAGE_H
#define APP_IMAGE_H

#include "drive_image.h"
#include "store.h"

typedef struct {
    drive_image_t image;  /**< in use; the tick reads it */
    uint32_t      number; /**< sequence number (store.h); 0: compiled in */
} app_image_t;

/**
 * @brief Checks the constants of an image: what the board's registers hold, and app_config_check().
 *
 * Context: init, or the loader.
 */
drive_image_result_t app_image_check(const drive_image_t *image);

/**
 * @brief Chooses the constants and copies them.
 *
 * @return false: the compiled-in constants have no law or are too large. Nothing may run then.
 *
 * Context: init, before board_init().
 */
bool app_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive);

#endif /* APP_IMAGE_H */
