/* SPDX-License-Identifier: MIT */
#include "base.h"

float base_clamp(float x, float lo, float hi)
{
    if (x > hi) {
        return hi;
    }
    return (x >= lo) ? x : lo;
}

bool base_in_range(float x, float lo, float hi)
{
    return (x >= lo) && (x <= hi);
}
