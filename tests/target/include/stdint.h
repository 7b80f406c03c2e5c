/* SPDX-License-Identifier: MIT */
/**
 * @file stdint.h
 * @brief The compiler's <stdint.h> without the types that a machine with 16-bit cells does not have.
 */
#ifndef TARGET_CHECK_STDINT_H
#define TARGET_CHECK_STDINT_H

#include_next <stdint.h>

#pragma GCC poison int8_t uint8_t INT8_MIN INT8_MAX UINT8_MAX INT8_C UINT8_C

#endif /* TARGET_CHECK_STDINT_H */
