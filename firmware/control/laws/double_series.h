/* SPDX-License-Identifier: MIT */
/**
 * @file double_series.h
 * @brief Product of a gain matrix given as a power series in two variables with a vector.
 *
 *     y = sum over n + m <= N of s1^n s2^m (G_nm x)                         EQ-DOUBLE-SERIES-1
 *
 * Terms are stored by rising degree n + m, within a degree by falling n: G_00, G_10, G_01, G_20,
 * G_11, ...
 */
#ifndef DOUBLE_SERIES_H
#define DOUBLE_SERIES_H

#include "base.h"

#define DOUBLE_SERIES_ORDER_MAX 4  /**< highest degree a table can hold */
#define DOUBLE_SERIES_TERMS_MAX 15 /**< (order + 1)(order + 2) / 2 of that */
#define DOUBLE_SERIES_COLUMNS   3  /**< of every G_nm */

/** Index of the term s1^n s2^m. */
static inline int16_t double_series_index(int16_t n, int16_t m)
{
    return (int16_t)((((n + m) * (n + m + 1)) / 2) + m);
}

/** Where the series is evaluated. */
typedef struct {
    float s1;
    float s2;
} double_series_point_t;

/**
 * @brief One row of EQ-DOUBLE-SERIES-1, by Horner in s2 over Horner in s1.
 *
 * @param row   This row of G_00; the same row of the next term is `rows` rows further.
 * @param rows  Rows of every G_nm, 1 or more.
 * @param order N, 0 .. DOUBLE_SERIES_ORDER_MAX.
 * @param at    s1 and s2.
 * @param x     Vector the gain is applied to.
 *
 * Context: control ISR. No division, 2 (N+1)(N+2) + N + 1 multiply-adds.
 */
CTL_PART float double_series_row(const float row[][DOUBLE_SERIES_COLUMNS], int16_t rows,
                                 int16_t order, double_series_point_t at,
                                 const float x[DOUBLE_SERIES_COLUMNS]);

#endif /* DOUBLE_SERIES_H */
