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

static bool read(drive_image_t *image, const store_content_t *stored, const law_t *law)
{
    return (stored->words != NULL) && (law != NULL) &&
           (drive_image_read(image, law, stored->words, stored->count) == DRIVE_IMAGE_OK) &&
           (app_image_check(image) == DRIVE_IMAGE_OK);
}

bool app_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive)
{
    const store_content_t stored = store_newest(STORE_IMAGE);
    const bool            taken  = read(&chosen->image, &stored, drive->law);

    chosen->number   = taken ? stored.number : 0UL;
    chosen->fallback = stored.lost || (!taken && (stored.words != NULL));
    return taken || drive_image_copy(&chosen->image, app, drive);
}

bool app_image_accept(app_image_t *chosen)
{
    const store_content_t stored = store_newest(STORE_IMAGE);
    bool                  ok     = true;

    if (chosen->fallback) {
        ok = (chosen->number == 0UL) ? store_forget(STORE_IMAGE)
                                     : store_write(STORE_IMAGE, stored.words, stored.count);
    }
    if (ok && chosen->fallback) {
        chosen->fallback = false;
        chosen->number   = (chosen->number == 0UL) ? 0UL : store_newest(STORE_IMAGE).number;
    }
    return ok;
}
