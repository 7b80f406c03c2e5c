/* SPDX-License-Identifier: MIT */
/**
 * @file app_image.h
 * @brief Chooses the drive's constants: the image that was stored last, else the compiled-in ones.
 *
 * A stored image that is damaged, missing or refused leaves a fall-back: the image before it, or
 * the compiled-in constants. They may be those of another motor. The drive communicates with them,
 * and does not run until they are accepted. All of them must belong to the board of this firmware.
 */
#ifndef APP_IMAGE_H
#define APP_IMAGE_H

#include "app_disc.h"
#include "drive_image.h"
#include "store.h"

typedef struct {
    drive_image_t           image;    /**< in use; the tick reads it */
    uint32_t                number;   /**< sequence number (store.h); 0: compiled in */
    bool                    fallback; /**< not what was stored last */
    const board_identity_t *board;    /**< of this firmware */
    drive_image_result_t result; /**< of the last check: of the stored image, or of the loader's */
    board_difference_t   difference; /**< DRIVE_IMAGE_OTHER_BOARD: the first one */
#if APP_DISC_MAP
    const uint16_t *disc; /**< map of the disc behind the image in the store; NULL: none */
#endif
    bool other_board; /**< the compiled-in constants contradict the board: the drive must not run */
} app_image_t;

/**
 * @brief Reads words into chosen->image and checks them: format, board, ranges, map of the disc.
 *
 * The outcome is in chosen->result. After any but DRIVE_IMAGE_OK the image must not be used.
 * Context: init, or the loader.
 */
void app_image_take(app_image_t *chosen, const law_t *law, const store_content_t *content);

/**
 * @brief Chooses the constants and copies them.
 *
 * @param board Must stay valid.
 * @return false: the compiled-in constants have no law or are too large. Nothing may run then.
 *
 * Context: init, before board_init().
 */
bool app_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive,
                      const board_identity_t *board);

/**
 * @brief Stores a fall-back as the last image, so that it runs from now on. Changes nothing else.
 *
 * @return false: the flash failed, and it stays a fall-back.
 *
 * Context: init, before board_start(). Takes seconds.
 */
bool app_image_accept(app_image_t *chosen);

#endif /* APP_IMAGE_H */
