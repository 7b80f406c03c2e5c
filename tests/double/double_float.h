/* SPDX-License-Identifier: MIT */
/* Included before everything else: the control core with double precision where it says `float`, and with names of its
 * own, so that it stands beside the other one. */
#ifndef DOUBLE_FLOAT_H
#define DOUBLE_FLOAT_H

/* What means the compiler's own float comes first. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "double_names.h" /* #define NAME double_NAME of every function and object; made by the build */

#define sqrtf sqrt
#define fabsf fabs
#define float double

#endif /* DOUBLE_FLOAT_H */
