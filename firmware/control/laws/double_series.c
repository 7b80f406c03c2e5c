/* SPDX-License-Identifier: MIT */
#include "double_series.h"

CTL_PART float double_series_row(const float row[][DOUBLE_SERIES_COLUMNS], int16_t rows,
                                 int16_t order, double_series_point_t at,
                                 const float x[DOUBLE_SERIES_COLUMNS])
{
    float y = 0.0f;

    /*@ split order; */                    /* for tests/prove: each order by itself */
    for (int16_t m = order; m >= 0; m--) { /* EQ-DOUBLE-SERIES-1 */
        float inner = 0.0f;
        for (int16_t n = (int16_t)(order - m); n >= 0; n--) {
            const float *g = row[rows * double_series_index(n, m)];
            inner          = (inner * at.s1) + ((g[0] * x[0]) + (g[1] * x[1]) + (g[2] * x[2]));
        }
        y = (y * at.s2) + inner;
    }
    return y;
}
