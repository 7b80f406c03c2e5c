/* SPDX-License-Identifier: MIT */
/**
 * @file check.h
 * @brief Range checks of constants, for the _check functions. Context: init.
 */
#ifndef CHECK_H
#define CHECK_H

#include "base.h"

/** Exceeds every physical constant of a drive; products of it stay finite. */
#define CHECK_LARGEST 1.0e12f

#define CHECK_COLUMNS 3 /**< of every gain matrix of paper A */

/** True if x is in 1e-12 .. CHECK_LARGEST. */
bool check_positive(float x);

/** True if x is in 0 .. CHECK_LARGEST. */
bool check_not_negative(float x);

/** True if all `count` numbers are within +-CHECK_LARGEST. */
bool check_finite(const float *x, int16_t count);

/** The same for the first rows of a table with three columns. */
bool check_rows(const float row[][CHECK_COLUMNS], int16_t rows);

/**
 * @brief True if a row of a series has the zeros that its parity requires (nodo_innovation_t).
 *
 * The series skips these elements.
 *
 * @param odd_signals true: the row takes the odd signals, and the column of id is zero. false: the
 *                    other two columns are zero.
 */
bool check_parity(const float row[CHECK_COLUMNS], int16_t id_column, bool odd_signals);

#endif /* CHECK_H */
