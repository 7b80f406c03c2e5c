/* SPDX-License-Identifier: MIT */
/**
 * @file fpu.h
 * @brief Inverses and square roots, from the estimates that the C28x's FPU has an instruction for,
 * by Newton's method.
 *
 *     y' = y (2 - x y), twice, towards 1 / x                                    EQ-FPU-1
 *     y' = y (3/2 - x y^2 / 2), twice, towards 1 / sqrt(x)                      EQ-FPU-2
 *
 * Each step squares the relative error. TI states eight bits for the estimate: 2^-8, 2^-16, then
 * single precision. A call of the library's division costs more, and takes registers.
 *
 * On other machines the quotient itself stands for the estimate; all after it is the same code. TI
 * does not publish the estimates, so that last bits may differ there. Here EQ-FPU-1 is within 0.5
 * units of the last place and EQ-FPU-2 within 1.5. From any estimate of eight bits they are within
 * 2 and 2.5 (tests/unit/control/base/test_fpu.c).
 *
 * Inline, because a call costs more. Context: control ISR. Pure.
 */
#ifndef FPU_H
#define FPU_H

#include <math.h>

/** 1 / x with a relative error of at most 2^-8 + 2^-10. */
static inline float fpu_inverse_estimate(float x)
{
#ifdef __TMS320C28XX_FPU32__
    return __einvf32(x);
#else
    return 1.0f / x;
#endif
}

/** 1 / sqrt(x) with a relative error of at most 2^-8 + 2^-10. */
static inline float fpu_inverse_root_estimate(float x)
{
#ifdef __TMS320C28XX_FPU32__
    return __eisqrtf32(x);
#else
    return 1.0f / sqrtf(x);
#endif
}

/** EQ-FPU-1 from an estimate y. */
static inline float fpu_inverse_from(float x, float y)
{
    const float once = y * (2.0f - (x * y));

    return once * (2.0f - (x * once));
}

/** EQ-FPU-2 from an estimate y. */
static inline float fpu_inverse_root_from(float x, float y)
{
    const float half = 0.5f * x;
    const float once = y * (1.5f - (half * y * y));

    return once * (1.5f - (half * once * once));
}

/**
 * @brief 1 / x.
 *
 * @param x |x| from 2^-126 to 2^125. Smaller, zero, infinite or no number: the result is none, or
 *          infinite, and every base_within() of it is false.
 */
static inline float fpu_inverse(float x)
{
    return fpu_inverse_from(x, fpu_inverse_estimate(x));
}

/** 1 / sqrt(x), for x from 2^-126 to the largest number. Other numbers, negative ones too, are as
 * in fpu_inverse(). */
static inline float fpu_inverse_root(float x)
{
    return fpu_inverse_root_from(x, fpu_inverse_root_estimate(x));
}

/** sqrt(x), within 3 units of the last place; 0 of a negative number and of a NaN. */
static inline float fpu_root(float x)
{
    return (x > 0.0f) ? (x * fpu_inverse_root(x)) : 0.0f;
}

#endif /* FPU_H */
