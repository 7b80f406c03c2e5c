/* SPDX-License-Identifier: MIT */
/* clang: integer-overflow */
/* cppcheck: integerOverflow */
long product(void);
long product(void)
{
    const int thousands = 400;
    return thousands * 1000 + 400 * 1000;
}
