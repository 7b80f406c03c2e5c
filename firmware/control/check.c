/* SPDX-License-Identifier: MIT */
#include "check.h"

bool check_positive(float x)
{
    return base_in_range(x, 1.0e-12f, CHECK_LARGEST);
}

bool check_not_negative(float x)
{
    return base_in_range(x, 0.0f, CHECK_LARGEST);
}

bool check_finite(const float *x, int16_t count)
{
    bool finite = true;

    for (int16_t i = 0; i < count; i++) {
        finite = finite && base_in_range(x[i], -CHECK_LARGEST, CHECK_LARGEST);
    }
    return finite;
}

bool check_rows(const float row[][CHECK_COLUMNS], int16_t rows)
{
    bool finite = true;

    for (int16_t i = 0; i < rows; i++) {
        finite = finite && check_finite(row[i], CHECK_COLUMNS);
    }
    return finite;
}
