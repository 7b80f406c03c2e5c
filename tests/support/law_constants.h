/* SPDX-License-Identifier: MIT */
/**
 * @file law_constants.h
 * @brief The constants of a table's law: to read, and as a copy to change.
 */
#ifndef LAW_CONSTANTS_H
#define LAW_CONSTANTS_H

#include <stddef.h>

#include "drive_config.h"
#include "laws.h"

/** Room for those of any shipped law. Those of near optimal control but noc_h begin with what they share. */
typedef union {
    near_optimal_config_t     near_optimal;
    law_noc_config_t          noc;
    law_noc_speed_config_t    noc_speed;
    law_noc_h_config_t        noc_h;
    law_conventional_config_t conventional;
    law_dobc_config_t         dobc;
    law_pid_config_t          pid;
} test_constants_t;

/** NULL unless the table is of the law. */
static inline const law_noc_config_t *law_constants_noc(const drive_config_t *d)
{
    return (d->law == &law_noc) ? (const law_noc_config_t *)d->constants : NULL;
}

static inline const law_noc_speed_config_t *law_constants_noc_speed(const drive_config_t *d)
{
    return (d->law == &law_noc_speed) ? (const law_noc_speed_config_t *)d->constants : NULL;
}

static inline const law_noc_h_config_t *law_constants_noc_h(const drive_config_t *d)
{
    return (d->law == &law_noc_h) ? (const law_noc_h_config_t *)d->constants : NULL;
}

static inline const law_noc_shaft_config_t *law_constants_noc_shaft(const drive_config_t *d)
{
    return (d->law == &law_noc_shaft) ? (const law_noc_shaft_config_t *)d->constants : NULL;
}

static inline const law_conventional_config_t *law_constants_conventional(const drive_config_t *d)
{
    return (d->law == &law_conventional) ? (const law_conventional_config_t *)d->constants : NULL;
}

static inline const law_dobc_config_t *law_constants_dobc(const drive_config_t *d)
{
    return (d->law == &law_dobc) ? (const law_dobc_config_t *)d->constants : NULL;
}

static inline const law_pid_config_t *law_constants_pid(const drive_config_t *d)
{
    return (d->law == &law_pid) ? (const law_pid_config_t *)d->constants : NULL;
}

/** Common constants of the near optimal laws; NULL for any other law. */
static inline const near_optimal_config_t *law_constants_near_optimal(const drive_config_t *d)
{
    const bool is_one =
        (d->law == &law_noc) || (d->law == &law_noc_speed) || (d->law == &law_conventional);

    if (d->law == &law_noc_h) {
        return &law_constants_noc_h(d)->near_optimal;
    }
    return is_one ? (const near_optimal_config_t *)d->constants : NULL;
}

/** A copy of a table of near optimal control, bound to constants that may be changed. */
static inline drive_config_t law_constants_copy(test_constants_t *to, const drive_config_t *from)
{
    drive_config_t copy = *from;

    if (from->law == &law_noc) {
        to->noc = *law_constants_noc(from);
    } else if (from->law == &law_noc_speed) {
        to->noc_speed = *law_constants_noc_speed(from);
    } else if (from->law == &law_noc_h) {
        to->noc_h = *law_constants_noc_h(from);
    } else {
        to->conventional = *law_constants_conventional(from);
    }
    copy.constants = to;
    return copy;
}

#endif /* LAW_CONSTANTS_H */
