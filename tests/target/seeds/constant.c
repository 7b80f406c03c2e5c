/* SPDX-License-Identifier: MIT */
/* clang: constant-conversion */
#include <stdint.h>
uint16_t constant(void);
uint16_t constant(void)
{
    return 100000;
}
