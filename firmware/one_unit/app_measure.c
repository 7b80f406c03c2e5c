/* SPDX-License-Identifier: MIT */
/* The measurements of the application's tick as one translation unit of an image: parts.h. */
#define APP_MEASURE_PART static inline

#include "../app/operate/app_measure.c"

#include "../app/angle/app_disc.c"

#include "../app/angle/app_angle.c"
#include "../app/angle/app_position.c"
#include "../app/app_scale.c"
