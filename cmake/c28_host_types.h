/* SPDX-License-Identifier: MIT */
/**
 * @file c28_host_types.h
 * @brief Integer types of the device headers in their C28x widths, for a compile check on a host.
 *
 * Included ahead of everything else. The first line keeps the headers from defining the types themselves. No standard
 * header: a source file that forgets one has to fail.
 */
#ifndef C28_HOST_TYPES_H
#define C28_HOST_TYPES_H

#define DSP28_DATA_TYPES

typedef __INT16_TYPE__  int16;
typedef __INT32_TYPE__  int32;
typedef __INT64_TYPE__  int64;
typedef __UINT16_TYPE__ Uint16;
typedef __UINT32_TYPE__ Uint32;
typedef __UINT64_TYPE__ Uint64;
typedef float           float32;
typedef double          float64;

#endif /* C28_HOST_TYPES_H */
