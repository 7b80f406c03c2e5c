/* SPDX-License-Identifier: MIT */
#include "parts.h"

#include "../control/drive_tick.c"
