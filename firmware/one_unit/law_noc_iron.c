/* SPDX-License-Identifier: MIT */
#include "parts.h"

#include "../control/laws/law_noc_iron.c"
