/* SPDX-License-Identifier: MIT */
/* clang: implicit-function-declaration */
#include <math.h>
float library(float x);
float library(float x)
{
    return (float)sin((double)x);
}
