/* SPDX-License-Identifier: MIT */
#include "parts.h"

#include "../control/laws/noc_torque.c"
