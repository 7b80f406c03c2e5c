/* SPDX-License-Identifier: MIT */
#include "app_image.h"

#include <stddef.h>

#include "app_config_check.h"

drive_image_result_t app_image_check(const drive_image_t *image)
{
    const bool accepted =
        board_fits(&image->app.board) && (app_config_check(&image->app, &image->drive) == CTL_OK);

    return accepted ? DRIVE_IMAGE_OK : DRIVE_IMAGE_REFUSED;
}

bool app_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive)
{
    const store_content_t stored = store_newest(STORE_IMAGE);

    if ((stored.words != NULL) && (drive->law != NULL) &&
        (drive_image_read(&chosen->image, drive->law, stored.words, stored.count) ==
         DRIVE_IMAGE_OK) &&
        (app_image_check(&chosen->image) == DRIVE_IMAGE_OK)) {
        chosen->number = stored.number;
        return true;
    }
    chosen->number = 0UL;
    return drive_image_copy(&chosen->image, app, drive);
}
