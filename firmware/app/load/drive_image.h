/* SPDX-License-Identifier: MIT */
/**
 * @file drive_image.h
 * @brief All constants of one drive, as one object and as a sequence of 16-bit words.
 *
 * The words change the motor without a compiler. `sdre-gains image` writes them, the loader stores
 * them, and main() reads them:
 *
 *     0        DRIVE_IMAGE_SCHEMA
 *     1        number of the law (law.h)
 *     2 .. 13  digest of the drive file: text, two characters a word, first one high, zero padded
 *     14 .. 29 name of the drive, in the same format
 *     30 .. 41 name of the board that it was made for, in the same format
 *     42 ..    facts of that board (board_identity.h), two words each
 *     92 ..    constants of application and board, temperatures, drive, law; order of fields.h
 *     ..       a map of the encoder disc (app_disc.h), or nothing
 */
#ifndef DRIVE_IMAGE_H
#define DRIVE_IMAGE_H

#include "app_config.h"
#include "board_identity.h"
#include "drive_config.h"
#include "laws.h"

#define DRIVE_IMAGE_SCHEMA       6U  /**< incremented when the meaning of a word changes */
#define DRIVE_IMAGE_DIGEST_WORDS 12U /**< length that sdre-gains writes */
#define DRIVE_IMAGE_NAME_WORDS   16U /**< chosen: 32 characters; longer names are cut */
#define DRIVE_IMAGE_TEMPERATURES 32U /**< chosen: sdre-gains writes 28 points */

/** Constants of one drive. Its pointers point into the object itself: it must not be moved. */
typedef struct {
    char             digest[(2U * DRIVE_IMAGE_DIGEST_WORDS) + 1U];
    char             name[(2U * DRIVE_IMAGE_NAME_WORDS) + 1U];
    board_identity_t board; /**< that the constants were made for; a read one has no sum */
    app_config_t     app;
    float            ntc_degC[DRIVE_IMAGE_TEMPERATURES];
    drive_config_t   drive;
    law_constants_t  constants;
} drive_image_t;

typedef enum {
    DRIVE_IMAGE_OK = 0,
    DRIVE_IMAGE_OTHER_SCHEMA, /**< written by an incompatible sdre-gains */
    DRIVE_IMAGE_OTHER_LAW,    /**< the firmware was linked with another law */
    DRIVE_IMAGE_DAMAGED,      /**< wrong length, or a flag is neither 0 nor 1 */
    DRIVE_IMAGE_REFUSED,      /**< constant out of range, or the board does not fit */
    DRIVE_IMAGE_OTHER_BOARD,  /**< made for another board, or contradicts this one */
    DRIVE_IMAGE_OTHER_DISC    /**< its map is for another encoder, or the firmware uses none */
} drive_image_result_t;

/**
 * @brief Visits every field of the image after the schema and the law's number.
 *
 * `f` decides whether the fields are read or written. Too many temperatures clear `f->ok`.
 */
void drive_image_fields(fields_t *f, drive_image_t *image, const law_t *law);

/**
 * @brief Reads the image from words. It checks the format only.
 *
 * app_config_check() and board_fits() check the ranges.
 *
 * @param law The law of this firmware. The image then points to it.
 * @return DRIVE_IMAGE_OK. After any other result the image must not be used.
 *
 * Context: init, or the loader.
 */
drive_image_result_t drive_image_read(drive_image_t *image, const law_t *law, const uint16_t *words,
                                      uint32_t count);

/**
 * @brief The same of words that may go on behind the image.
 *
 * @param used Words of the image, after DRIVE_IMAGE_OK.
 *
 * Context: init, or the loader.
 */
drive_image_result_t drive_image_read_part(drive_image_t *image, const law_t *law,
                                           const uint16_t *words, uint32_t count, uint32_t *used);

/** Writes the image as words; `words` NULL: counts only. @return Number of words; 0: above
 * `room`. */
uint32_t drive_image_write(drive_image_t *image, uint16_t *words, uint32_t room);

/**
 * @brief Fills the image from compiled-in constants.
 *
 * @return false: the law's constants or the temperatures exceed the space of the image.
 *
 * Context: init.
 */
bool drive_image_copy(drive_image_t *image, const app_config_t *app, const drive_config_t *drive,
                      const board_identity_t *board);

#endif /* DRIVE_IMAGE_H */
