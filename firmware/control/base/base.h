/* SPDX-License-Identifier: MIT */
/**
 * @file base.h
 * @brief Vector types and range helpers shared by all modules of the core.
 *
 * Scaling is amplitude invariant: the length of a current vector is the peak of the phase current.
 * The core uses single precision only. It does not allocate, read a clock or access hardware.
 */
#ifndef BASE_H
#define BASE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#define BASE_PI      3.14159265f
#define BASE_TWO_PI  6.28318531f
#define BASE_SQRT3   1.73205081f
#define BASE_1_SQRT3 0.577350269f

/* Linkage of functions that the tick calls in one place only. It is empty on hosts. In an image the
 * tick is two translation units (firmware/one_unit): there the functions are static inline, without
 * cost of a call. */
#ifndef CTL_PART
#define CTL_PART
#endif

/* Linkage of functions that the tick calls in few samples. It is empty on most targets. Where only
 * a part of the tick has room in the memory without waits (board/stm32g431), they stay outside. */
#ifndef CTL_RARE
#define CTL_RARE
#endif

/** Vector in the rotor frame; d is the magnet axis. */
typedef struct {
    float d;
    float q;
} dq_t;

/** Vector in the stator frame; alpha is the axis of phase a. */
typedef struct {
    float alpha;
    float beta;
} ab_t;

/** Three phase quantities. */
typedef struct {
    float a;
    float b;
    float c;
} abc_t;

/** Result of an _init function; anything but CTL_OK leaves the module unusable. */
typedef enum {
    CTL_OK = 0,
    CTL_BAD_CONFIG /**< a constant is missing, not finite or out of its documented range */
} ctl_status_t;

/* Inline, because a call costs more than the comparison and the tick makes about sixty of them.
 *
 * A NaN compares false, except on the C28x: there it acts as an infinity of its sign. The
 * statements on NaN below hold under both rules (tests/target/test_c28x_floats.cpp). */

/** The smaller one of a and b. If one is a NaN the result is b, except on the C28x. */
static inline float base_min(float a, float b)
{
#ifdef __TMS320C28XX_FPU32__
    return __fmin(a, b);
#else
    return (a < b) ? a : b;
#endif
}

/** The larger one of a and b. If one is a NaN the result is b, except on the C28x. */
static inline float base_max(float a, float b)
{
#ifdef __TMS320C28XX_FPU32__
    return __fmax(a, b);
#else
    return (a > b) ? a : b;
#endif
}

/** x limited to [lo, hi]. A NaN becomes one of the two limits. */
static inline float base_clamp(float x, float lo, float hi)
{
    const float at_least = base_max(x, lo);
    /* For tests/prove, which does not see it: */
    /*@ admit number: \is_NaN(lo) || !\is_NaN(at_least); */
    return base_min(at_least, hi);
}

/** True if lo <= x <= hi; false for NaN. It is the check for all inputs. */
static inline bool base_in_range(float x, float lo, float hi)
{
    return (x >= lo) && (x <= hi);
}

/** true when |x| <= limit, in one comparison; false for NaN. */
static inline bool base_within(float x, float limit)
{
    return fabsf(x) <= limit;
}

#endif /* BASE_H */
