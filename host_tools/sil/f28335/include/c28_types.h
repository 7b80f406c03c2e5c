/* SPDX-License-Identifier: MIT */
/**
 * @file c28_types.h
 * @brief The register headers' type names with their exact widths on any compiler.
 *
 * No standard header: those of the SDK include none, so a driver has to name what it takes from them.
 */
#ifndef C28_TYPES_H
#define C28_TYPES_H

typedef __INT16_TYPE__  int16;
typedef __INT32_TYPE__  int32;
typedef __INT64_TYPE__  int64;
typedef __UINT16_TYPE__ Uint16;
typedef __UINT32_TYPE__ Uint32;
typedef __UINT64_TYPE__ Uint64;
typedef float           float32;

#endif /* C28_TYPES_H */
