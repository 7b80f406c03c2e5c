/* SPDX-License-Identifier: MIT */
#include "parts.h"

#include "../control/law_conventional.c"
