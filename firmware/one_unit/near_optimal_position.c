/* SPDX-License-Identifier: MIT */
#include "parts.h"

#include "../control/laws/near_optimal_position.c"
