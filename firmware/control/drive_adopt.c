/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "drive_tick.h"

void drive_adopt(drive_t *d, const drive_config_t *next)
{
    const drive_config_t *c = d->config;

    if ((c == NULL) || (c != d->config_again) || (c->law->adopt == NULL)) {
        return;
    }
    if (d->state == DRIVE_RUN) {
        c->law->adopt(&d->law, c, next);
    }
    d->config          = next;
    d->config_again    = next;
    d->constants_again = next->constants;
}
