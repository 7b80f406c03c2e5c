/* SPDX-License-Identifier: MIT */
/**
 * @file parts.h
 * @brief Modules of the tick that one place calls, for one translation unit of an image.
 *
 * The compiler then puts each where it is called: no call, no return, no arguments and results by way of memory, a quarter of
 * the tick (docs/hardware.md, "Cycle budget"). What a unit does not call is left out. Hosts and tests compile every file of firmware/control by itself;
 * the results are the same, test unit.one_unit.
 */
#ifndef PARTS_H
#define PARTS_H

#define CTL_PART static inline

#include "angle_gate.c"
#include "conventional.c"
#include "current_clamp.c"
#include "current_gate.c"
#include "current_ref.c"
#include "current_watch.c"
#include "double_series.c"
#include "encoder_form.c"
#include "motion_watch.c"
#include "near_optimal.c"
#include "nodo_encoder.c"
#include "nosc.c"
#include "svpwm.c"
#include "voltage.c"

#endif /* PARTS_H */
