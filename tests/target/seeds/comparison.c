/* SPDX-License-Identifier: MIT */
/* clang: tautological-constant-out-of-range-compare */
#include <stdbool.h>
bool comparison(int count);
bool comparison(int count)
{
    return count > 40000L;
}
