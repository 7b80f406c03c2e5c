/* SPDX-License-Identifier: MIT */
/**
 * @file parts.h
 * @brief Modules of the tick with one caller each, collected in one translation unit.
 *
 * The compiler then inlines each module, which saves calls and arguments: a quarter of the tick
 * (docs/hardware.md, "Cycle budget"). It omits modules that the unit does not call. A host
 * without sanitizers compiles these units too. With sanitizers every file of firmware/control is
 * compiled separately. The tests of the tick and of the laws run with both.
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
#include "nodo_harmonic.c"
#include "nodo_shaft.c"
#include "nosc.c"
#include "svpwm.c"
#include "voltage.c"

#endif /* PARTS_H */
