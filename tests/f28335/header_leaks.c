/* SPDX-License-Identifier: MIT */
/* Compiled only. The SDK's headers include no standard header; where the stand-ins did, one of these names would be
 * declared twice or be a macro. */
#include "DSP28x_Project.h"

enum {
    NULL,
    bool,
    true,
    false,
    size_t,
    ptrdiff_t,
    offsetof,
    int16_t,
    int32_t,
    int64_t,
    uint16_t,
    uint32_t,
    uint64_t,
    uintptr_t,
    UINT16_MAX,
    UINT32_MAX,
    CHAR_BIT,
    FLT_MAX
};
