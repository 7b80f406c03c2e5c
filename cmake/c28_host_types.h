/* SPDX-License-Identifier: MIT */
/**
 * @file c28_host_types.h
 * @brief Integer types of the device headers in their C28x widths, for a compile check on a host.
 *
 * Included ahead of everything else. The first line keeps the headers from defining the types themselves.
 */
#ifndef C28_HOST_TYPES_H
#define C28_HOST_TYPES_H

#define DSP28_DATA_TYPES

#include <stdint.h>

typedef int16_t  int16;
typedef int32_t  int32;
typedef int64_t  int64;
typedef uint16_t Uint16;
typedef uint32_t Uint32;
typedef uint64_t Uint64;
typedef float    float32;
typedef double   float64;

#endif /* C28_HOST_TYPES_H */
