/* SPDX-License-Identifier: MIT */
/**
 * @file app_believe.h
 * @brief A second set of the law's constants, for the inertia that the drive has learned.
 *
 * The drive's own constants never change. The second set is made from them while they are in force,
 * and the tick takes it with the next command (drive_adopt()). For another ratio the drive first
 * goes back to its own constants. Context: background.
 */
#ifndef APP_BELIEVE_H
#define APP_BELIEVE_H

#include "drive_config.h"
#include "laws.h"

/** Ratios that differ by a smaller share are the same. Chosen: a load that swings moves a learned
 * ratio by 0.06 at most (sil.inertia). */
#define APP_BELIEVE_SAME 0.08f

typedef struct {
    drive_config_t  drive;
    law_constants_t constants;
    float           asked; /**< ratio that they were made for */
    float           ratio; /**< the same within the certified range */
} app_believe_t;

/** No second set is made yet. Context: init. */
void app_believe_init(app_believe_t *b, const drive_config_t *own);

/**
 * @brief Chooses the constants for a shaft with `ratio` times the drive's inertia.
 *
 * @param b        The second set. It is made anew only while it is not in force.
 * @param own      The drive's constants.
 * @param in_force Those that the tick uses, with no other ones on the way to it.
 * @param ratio    Of the inertia over the drive's; 1: the drive's own constants.
 * @param made     Whether the second set was made anew.
 * @return The drive's own constants or the second set.
 */
const drive_config_t *app_believe_choose(app_believe_t *b, const drive_config_t *own,
                                         const drive_config_t *in_force, float ratio, bool *made);

#endif /* APP_BELIEVE_H */
