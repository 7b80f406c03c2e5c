/* SPDX-License-Identifier: MIT */
/* Included before everything else: compiles the control core with double precision in place of `float`. Its names are its
 * own, so that both cores fit into one program. */
#ifndef DOUBLE_FLOAT_H
#define DOUBLE_FLOAT_H

/* Headers that need the compiler's own float come first. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "double_names.h" /* #define NAME double_NAME of every function and object; made by the build */

#define sqrtf sqrt
#define fabsf fabs
#define float double
#define FRAMES_ONES 6755399441055744.0 /* 1.5 times 2^52: frames.c */

#endif /* DOUBLE_FLOAT_H */
