/* SPDX-License-Identifier: MIT */
/**
 * @file check.h
 * @brief Range checks of constants, for the _check functions. Context: init.
 */
#ifndef CHECK_H
#define CHECK_H

#include "base.h"

/** Beyond any physical constant of a drive, and far enough from FLT_MAX that products stay finite. */
#define CHECK_LARGEST 1.0e12f

#define CHECK_COLUMNS 3 /**< of every gain matrix of paper A */

/** 1e-12 .. CHECK_LARGEST. */
bool check_positive(float x);

/** 0 .. CHECK_LARGEST. */
bool check_not_negative(float x);

/** Every one of count numbers within +-CHECK_LARGEST. */
bool check_finite(const float *x, int16_t count);

/** The same for the first rows of a table with three columns. */
bool check_rows(const float row[][CHECK_COLUMNS], int16_t rows);

/**
 * @brief Whether a row of a series holds zeros where its parity says so (nodo_innovation_t): those are not multiplied.
 *
 * @param odd_signals true: the row takes the odd signals, so that id's column is zero; false: the other two are.
 */
bool check_parity(const float row[CHECK_COLUMNS], int16_t id_column, bool odd_signals);

#endif /* CHECK_H */
