/* SPDX-License-Identifier: MIT */
#include "parts.h"

#include "../control/law_noc_speed.c"
