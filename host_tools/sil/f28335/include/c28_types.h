/* SPDX-License-Identifier: MIT */
/**
 * @file c28_types.h
 * @brief The register headers' type names with their exact widths on any compiler.
 */
#ifndef C28_TYPES_H
#define C28_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef int16_t  int16;
typedef int32_t  int32;
typedef int64_t  int64;
typedef uint16_t Uint16;
typedef uint32_t Uint32;
typedef uint64_t Uint64;
typedef float    float32;

#endif /* C28_TYPES_H */
