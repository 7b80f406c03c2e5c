/* SPDX-License-Identifier: MIT */
#include "app_line.h"

app_line_t app_line;
