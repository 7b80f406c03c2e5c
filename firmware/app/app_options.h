/* SPDX-License-Identifier: MIT */
/**
 * @file app_options.h
 * @brief Parts that an image leaves out where its law leaves no room for them, or has no use.
 * They come from CMake.
 */
#ifndef APP_OPTIONS_H
#define APP_OPTIONS_H

#ifndef APP_WATCH_INERTIA
#define APP_WATCH_INERTIA 1 /**< 0: no app_watch_inertia.h. noc_h */
#endif

#ifndef APP_TRIM
#define APP_TRIM 1 /**< 0: no app_trim.h. noc_h */
#endif

#ifndef APP_BELIEVE
#define APP_BELIEVE 1 /**< 0: no app_believe.h. Every law that has one inertia */
#endif

#ifndef APP_DISC_MAP
#define APP_DISC_MAP 0 /**< 1: with app_disc.h. SDRE_DISC_MAP, and every program on a host */
#endif

#endif /* APP_OPTIONS_H */
