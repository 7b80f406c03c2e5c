/* SPDX-License-Identifier: MIT */
#include "app_position.h"

#include "frames.h"

APP_MEASURE_PART void app_position_track(app_position_t *p, const app_angle_t *angle,
                                         const app_angle_reading_t *reading)
{
    const float theta_rad = frames_wrap(reading->theta_e_rad);

    if (!p->have) {
        p->actual.theta_e_rad = theta_rad;
        p->have               = true;
    }
    p->actual = position_followed(&p->actual, theta_rad);
    if (angle->reference == APP_ANGLE_NONE) {
        p->known = false;
    } else if (!p->known) {
        app_position_find_zero(p, angle);
    } else {
        /* the zero stays */
    }
}
