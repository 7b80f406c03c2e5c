/* SPDX-License-Identifier: MIT */
#include "app_believe.h"

#include <stddef.h>

void app_believe_init(app_believe_t *b, const drive_config_t *own)
{
    b->drive = *own;
    b->asked = 1.0f;
    b->ratio = 1.0f;
}

static bool is_same(float ratio, float other)
{
    return base_within(ratio - other, APP_BELIEVE_SAME * other);
}

const drive_config_t *app_believe_choose(app_believe_t *b, const drive_config_t *own,
                                         const drive_config_t *in_force, float ratio, bool *made)
{
    const bool own_one = (own->law->believe == NULL) || is_same(ratio, 1.0f) || !(ratio > 0.0f);

    *made = false;
    if (own_one) {
        return own;
    }
    if (in_force != own) {
        return is_same(ratio, b->asked) ? &b->drive : own;
    }
    b->ratio = own->law->believe(&b->drive, &b->constants, own, ratio);
    b->asked = ratio;
    *made    = true;
    return (drive_config_check(&b->drive) == CTL_OK) ? &b->drive : own;
}
