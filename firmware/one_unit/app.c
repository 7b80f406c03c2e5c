/* SPDX-License-Identifier: MIT */
/* The application's tick without its measurements as one translation unit of an image: parts.h. */
#define APP_PART static inline

#include "../app/app.c"
#include "../app/operate/app_gate.c"
#include "../app/operate/app_modes.c"
#include "../app/operate/app_states.c"
#include "../app/trace/app_record.c"
