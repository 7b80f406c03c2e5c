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

bool check_parity(const float row[CHECK_COLUMNS], int16_t id_column, bool odd_signals)
{
    bool zero = true;

    for (int16_t column = 0; column < CHECK_COLUMNS; column++) {
        const bool used = (column == id_column) != odd_signals;
        zero            = zero && (used || base_within(row[column], 0.0f));
    }
    return zero;
}
