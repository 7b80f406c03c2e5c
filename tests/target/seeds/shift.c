/* SPDX-License-Identifier: MIT */
/* clang: shift-count-overflow */
/* cppcheck: shiftTooManyBits */
int shift(int x);
int shift(int x)
{
    return x << 16;
}
