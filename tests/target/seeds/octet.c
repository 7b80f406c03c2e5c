/* SPDX-License-Identifier: MIT */
/* clang: poisoned */
#include <stdint.h>
uint8_t octet(void);
uint8_t octet(void)
{
    return 1;
}
