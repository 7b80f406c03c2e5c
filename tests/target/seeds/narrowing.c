/* SPDX-License-Identifier: MIT */
/* clang: implicit-int-conversion */
#include <stdint.h>
int narrowing(int32_t cycles);
int narrowing(int32_t cycles)
{
    return cycles;
}
