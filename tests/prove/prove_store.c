/* SPDX-License-Identifier: MIT */
/* The store, the image and the parameters' record over any contents of the flash, for the analyser (docs/assurance.md). Flash
 * that is erased or written holds anything afterwards, and each of both may fail. */
#include <string.h>

#include "any_flash.h"
#include "app_image.h"
#include "store.h"

uint16_t      words[100];
drive_image_t image;

#define NAMED_(a, b) a##b
#define NAMED(a, b)  NAMED_(a, b)

/* Every word of a content is in the flash. */
static void read_all(const store_content_t *c)
{
    uint16_t sum = 0U;

    if (c->words != NULL) {
        for (uint32_t n = 0U; n < c->count; n++) {
            sum ^= c->words[n];
        }
    }
    words[0] = sum;
}

static void use(store_kind_t kind)
{
    const store_content_t found = store_newest(kind);
    store_write_t         w;

    read_all(&found);
    (void)store_writes(kind);
    if (store_begin(&w, kind, (uint32_t)any_long)) {
        (void)store_put(&w, (uint32_t)any_long, words, (uint16_t)(any_word % 101U));
        const store_content_t written = store_written(&w);
        read_all(&written);
        (void)store_commit(&w);
    }
    (void)store_write(kind, words, (uint32_t)any_long % 101UL);
    (void)store_forget(kind);
}

/* Entry: every function of the store. */
void prove_store(void)
{
    use(STORE_IMAGE);
    use(STORE_PARAMETERS);
}

/* Entry: an image of any words and any length, and its words again. */
void prove_image(void)
{
#ifndef PROVE_any /* a law with its fields */
    const uint32_t count = (uint32_t)any_long % (BOARD_STORE_WORDS + 1U);

    (void)memset(&image, 0, sizeof image);
    if (drive_image_read(&image, &NAMED(law_, PROVE_LAW), flash[0], count) == DRIVE_IMAGE_OK) {
        (void)drive_image_write(&image, flash[1], BOARD_STORE_WORDS);
    }
#endif
}
