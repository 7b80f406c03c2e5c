/* SPDX-License-Identifier: MIT */
/**
 * @file math.h
 * @brief Stand-in for the target's <math.h>: compilers for 16-bit machines come without a C library.
 *
 * Exactly the functions firmware may call; any other name is an undeclared identifier, hence an error.
 */
#ifndef TARGET_CHECK_MATH_H
#define TARGET_CHECK_MATH_H

float cosf(float x);
float fabsf(float x);
float fmaxf(float x, float y);
float fminf(float x, float y);
float sinf(float x);
float sqrtf(float x);

#endif /* TARGET_CHECK_MATH_H */
