/* SPDX-License-Identifier: MIT */
/**
 * @file drive_image.h
 * @brief All constants of one drive in one object, and as words: a new motor without a compiler.
 *
 * `sdre-gains image` writes the words, the loader stores them, main() reads them:
 *
 *     0        DRIVE_IMAGE_SCHEMA
 *     1        number of the law (law.h)
 *     2 .. 13  digest of the drive file as text, two characters a word, the first one high, filled up with zeros
 *     14 .. 29 name of the drive, the same
 *     30 ..    constants of application and board, temperatures, of the drive, of its law: the walks of fields.h
 */
#ifndef DRIVE_IMAGE_H
#define DRIVE_IMAGE_H

#include "app_config.h"
#include "drive_config.h"
#include "laws.h"

#define DRIVE_IMAGE_SCHEMA       2U  /**< raised with every change of what the words mean */
#define DRIVE_IMAGE_DIGEST_WORDS 12U /**< as long as sdre-gains writes it */
#define DRIVE_IMAGE_NAME_WORDS   16U /**< chosen: 32 characters; longer names are cut */
#define DRIVE_IMAGE_TEMPERATURES                                                                   \
    32U /**< chosen: room for the 28 points that sdre-gains makes, and some */

/** The pointers lead into the object itself: it must not be moved. */
typedef struct {
    char            digest[(2U * DRIVE_IMAGE_DIGEST_WORDS) + 1U];
    char            name[(2U * DRIVE_IMAGE_NAME_WORDS) + 1U];
    app_config_t    app;
    float           ntc_degC[DRIVE_IMAGE_TEMPERATURES];
    drive_config_t  drive;
    law_constants_t constants;
} drive_image_t;

typedef enum {
    DRIVE_IMAGE_OK = 0,
    DRIVE_IMAGE_OTHER_SCHEMA, /**< made by another sdre-gains */
    DRIVE_IMAGE_OTHER_LAW,    /**< the firmware was linked with another law */
    DRIVE_IMAGE_DAMAGED,      /**< too short or too long, or a flag that is none */
    DRIVE_IMAGE_REFUSED       /**< a constant is out of range, or board and drive do not fit */
} drive_image_result_t;

/** Visits what is in the image behind its schema and law's number. */
void drive_image_fields(fields_t *f, drive_image_t *image, const law_t *law);

/**
 * @brief Makes the image what the words say. Ranges are not looked at: drive_config_check(), app_init(), board_fits().
 *
 * @param law The one that the firmware has; gets the pointers.
 * @return Anything but DRIVE_IMAGE_OK: the image is worth nothing.
 *
 * Context: init, or the loader.
 */
drive_image_result_t drive_image_read(drive_image_t *image, const law_t *law, const uint16_t *words,
                                      uint32_t count);

/** The words of an image; `words` NULL: only how many. @return their number; 0: there are more than `room`. */
uint32_t drive_image_write(drive_image_t *image, uint16_t *words, uint32_t room);

/**
 * @brief Makes the image what is compiled in.
 *
 * @return false: the law's constants do not fit, or there are more temperatures than room.
 *
 * Context: init.
 */
bool drive_image_copy(drive_image_t *image, const app_config_t *app, const drive_config_t *drive);

#endif /* DRIVE_IMAGE_H */
