/* SPDX-License-Identifier: MIT */
/**
 * @file string.h
 * @brief Stand-in for the target's <string.h>, likewise.
 */
#ifndef TARGET_CHECK_STRING_H
#define TARGET_CHECK_STRING_H

#include <stddef.h>

void *memcpy(void *to, const void *from, size_t chars);
void *memset(void *to, int value, size_t chars);

#endif /* TARGET_CHECK_STRING_H */
