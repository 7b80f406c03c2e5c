/* SPDX-License-Identifier: MIT */
#include "app_image.h"

#include <stddef.h>

#include "app_board_check.h"
#include "app_config_check.h"

static const board_difference_t no_difference = {.field = (uint16_t)BOARD_FIELD_NONE};

static bool is_in_range(const drive_image_t *image)
{
    return board_fits(&image->app.board) &&
           (app_config_check(&image->app, &image->drive) == CTL_OK);
}

static bool is_different(const app_image_t *chosen)
{
    return chosen->difference.field != (uint16_t)BOARD_FIELD_NONE;
}

/* Constants out of range are not compared with the board: a quotient of them may be none. */
static drive_image_result_t check(app_image_t *chosen)
{
    const drive_image_t *const image  = &chosen->image;
    drive_image_result_t       result = DRIVE_IMAGE_OK;

    chosen->difference = board_identity_compare(&image->board, chosen->board);
    if (is_different(chosen)) {
        result = DRIVE_IMAGE_OTHER_BOARD;
    } else if (!is_in_range(image)) {
        result = DRIVE_IMAGE_REFUSED;
    } else {
        chosen->difference = app_board_check(chosen->board, &image->app, &image->drive);
        result             = is_different(chosen) ? DRIVE_IMAGE_OTHER_BOARD : DRIVE_IMAGE_OK;
    }
    return result;
}

/* A map of the encoder's disc may lie behind an image. */
#if APP_DISC_MAP
static void no_disc(app_image_t *chosen)
{
    chosen->disc = NULL;
}

static void take_disc(app_image_t *chosen, const uint16_t *words, uint32_t count)
{
    if (app_disc_check(words, count, chosen->image.drive.hardware.encoder_positions)) {
        chosen->disc = words;
    } else {
        chosen->result = DRIVE_IMAGE_OTHER_DISC;
    }
}
#else
static void no_disc(const app_image_t *chosen)
{
    (void)chosen;
}

static void take_disc(app_image_t *chosen, const uint16_t *words, uint32_t count)
{
    (void)words;
    (void)count;
    chosen->result = DRIVE_IMAGE_OTHER_DISC;
}
#endif

void app_image_take(app_image_t *chosen, const law_t *law, const store_content_t *content)
{
    uint32_t used = 0UL;

    no_disc(chosen);
    chosen->difference = no_difference;
    chosen->result =
        drive_image_read_part(&chosen->image, law, content->words, content->count, &used);
    if (chosen->result == DRIVE_IMAGE_OK) {
        chosen->result = check(chosen);
    }
    if ((chosen->result == DRIVE_IMAGE_OK) && (used < content->count)) {
        take_disc(chosen, &content->words[used], content->count - used);
    }
}

/* Constants out of range are no matter of the board: app_init() refuses them. */
static bool take_compiled(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive)
{
    const board_difference_t stored = chosen->difference;

    no_disc(chosen);
    if (!drive_image_copy(&chosen->image, app, drive, chosen->board)) {
        return false;
    }
    chosen->other_board = check(chosen) == DRIVE_IMAGE_OTHER_BOARD;
    if (chosen->other_board) {
        chosen->result = DRIVE_IMAGE_OTHER_BOARD;
    } else {
        chosen->difference = stored;
    }
    return true;
}

bool app_image_choose(app_image_t *chosen, const app_config_t *app, const drive_config_t *drive,
                      const board_identity_t *board)
{
    const store_content_t stored = store_newest(STORE_IMAGE);
    bool                  taken  = false;

    chosen->board       = board;
    chosen->result      = DRIVE_IMAGE_OK;
    chosen->difference  = no_difference;
    chosen->other_board = false;
    no_disc(chosen);
    if ((stored.words != NULL) && (drive->law != NULL)) {
        app_image_take(chosen, drive->law, &stored);
        taken = chosen->result == DRIVE_IMAGE_OK;
    }
    chosen->number   = taken ? stored.number : 0UL;
    chosen->fallback = stored.lost || (!taken && (stored.words != NULL));
    return taken || take_compiled(chosen, app, drive);
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
