/* SPDX-License-Identifier: MIT */
#include "drive_image.h"

#include <stddef.h>
#include <string.h>

#include "fields_app.h"
#include "fields_drive.h"
#include "fields_text.h"

/* Copies a text, cut to 2 * words characters and padded with zeros. */
static void copy_text(char *to, const char *from, uint16_t words)
{
    uint16_t n = 0U;

    for (; (n < (uint16_t)(2U * words)) && (from != NULL) && (from[n] != '\0'); n++) {
        to[n] = from[n];
    }
    for (; n <= (uint16_t)(2U * words); n++) {
        to[n] = '\0';
    }
}

void drive_image_fields(fields_t *f, drive_image_t *image, const law_t *law)
{
    FIELDS_BEGIN(f, digest);
    fields_text(f, image->digest, DRIVE_IMAGE_DIGEST_WORDS);
    FIELDS_END(f);
    FIELDS_BEGIN(f, name);
    fields_text(f, image->name, DRIVE_IMAGE_NAME_WORDS);
    FIELDS_END(f);
    board_identity_fields(f, &image->board);
    FIELDS_PART(fields_app, f, image, app);
    if (image->app.scale.ntc_points > DRIVE_IMAGE_TEMPERATURES) {
        f->ok = false;
    } else {
        FIELDS_BEGIN(f, ntc_degC);
        fields_floats(f, image->ntc_degC, image->app.scale.ntc_points);
        FIELDS_END(f);
        FIELDS_PART(fields_drive, f, image, drive);
        FIELDS_PART(law->fields, f, image, constants);
    }
}

static void point_inside(drive_image_t *image, const law_t *law)
{
    image->app.scale.ntc_degC = image->ntc_degC;
    image->app.drive_name     = image->name;
    image->app.digest         = image->digest;
    image->drive.law          = law;
    image->drive.constants    = &image->constants;
}

drive_image_result_t drive_image_read_part(drive_image_t *image, const law_t *law,
                                           const uint16_t *from, uint32_t count, uint32_t *used)
{
    fields_t f      = fields_reader(from, count);
    uint16_t schema = 0U;
    uint16_t number = 0U;

    fields_u16(&f, &schema);
    fields_u16(&f, &number);
    if (!f.ok) {
        return DRIVE_IMAGE_DAMAGED;
    }
    if (schema != DRIVE_IMAGE_SCHEMA) {
        return DRIVE_IMAGE_OTHER_SCHEMA;
    }
    if ((number != law->number) || (law->fields == NULL)) {
        return DRIVE_IMAGE_OTHER_LAW;
    }
    drive_image_fields(&f, image, law);
    point_inside(image, law);
    *used = f.at;
    return f.ok ? DRIVE_IMAGE_OK : DRIVE_IMAGE_DAMAGED;
}

drive_image_result_t drive_image_read(drive_image_t *image, const law_t *law, const uint16_t *from,
                                      uint32_t count)
{
    uint32_t                   used   = 0UL;
    const drive_image_result_t result = drive_image_read_part(image, law, from, count, &used);

    return ((result == DRIVE_IMAGE_OK) && (used != count)) ? DRIVE_IMAGE_DAMAGED : result;
}

uint32_t drive_image_write(drive_image_t *image, uint16_t *to, uint32_t room)
{
    const law_t *const law    = image->drive.law;
    fields_t           f      = fields_writer(to, room);
    uint16_t           schema = DRIVE_IMAGE_SCHEMA;
    uint16_t           number = law->number;

    fields_u16(&f, &schema);
    fields_u16(&f, &number);
    drive_image_fields(&f, image, law);
    return f.ok ? f.at : 0UL;
}

bool drive_image_copy(drive_image_t *image, const app_config_t *app, const drive_config_t *drive,
                      const board_identity_t *board)
{
    const law_t *const law = drive->law;

    if ((law == NULL) || (law->constants_chars > (uint32_t)sizeof image->constants) ||
        (app->scale.ntc_points > DRIVE_IMAGE_TEMPERATURES)) {
        return false;
    }
    (void)memset(image, 0, sizeof *image);
    image->app   = *app;
    image->drive = *drive;
    image->board = *board;
    for (uint16_t n = 0U; n < app->scale.ntc_points; n++) {
        image->ntc_degC[n] = app->scale.ntc_degC[n];
    }
    copy_text(image->digest, app->digest, DRIVE_IMAGE_DIGEST_WORDS);
    copy_text(image->name, app->drive_name, DRIVE_IMAGE_NAME_WORDS);
    (void)memcpy(&image->constants, drive->constants, (size_t)law->constants_chars);
    point_inside(image, law);
    return true;
}
