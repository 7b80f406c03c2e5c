// SPDX-License-Identifier: MIT
/// `float` as the FPU of the C28x has it, for compiling the control core as C++: in comparisons and as an operand a NaN is
/// an infinity of its sign, a denormal is zero; no operation yields a NaN.
#pragma once

// Everything that means the compiler's own float comes first.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

class c28x_float {
public:
    c28x_float() = default;
    template <typename Number>
    constexpr c28x_float(Number x) // NOLINT: converts from every number, as float does
        : x_(static_cast<float>(x))
    {
    }
    template <typename Number> explicit constexpr operator Number() const
    {
        return static_cast<Number>(x_);
    }

    /// What the FPU takes the bits for.
    static float seen(c28x_float y)
    {
        if (std::isnan(y.x_)) {
            return std::copysign(INFINITY, y.x_);
        }
        return std::fpclassify(y.x_) == FP_SUBNORMAL ? std::copysign(0.0F, y.x_) : y.x_;
    }

    friend c28x_float operator+(c28x_float a, c28x_float b)
    {
        return result(seen(a) + seen(b));
    }
    friend c28x_float operator-(c28x_float a, c28x_float b)
    {
        return result(seen(a) - seen(b));
    }
    friend c28x_float operator*(c28x_float a, c28x_float b)
    {
        return result(seen(a) * seen(b));
    }
    friend c28x_float operator/(c28x_float a, c28x_float b)
    {
        return result(seen(a) / seen(b));
    }
    friend c28x_float operator-(c28x_float a)
    {
        return c28x_float(-a.x_);
    }
    c28x_float &operator+=(c28x_float b)
    {
        return *this = *this + b;
    }
    c28x_float &operator-=(c28x_float b)
    {
        return *this = *this - b;
    }
    c28x_float &operator*=(c28x_float b)
    {
        return *this = *this * b;
    }
    friend bool operator<(c28x_float a, c28x_float b)
    {
        return seen(a) < seen(b);
    }
    friend bool operator>(c28x_float a, c28x_float b)
    {
        return seen(a) > seen(b);
    }
    friend bool operator<=(c28x_float a, c28x_float b)
    {
        return seen(a) <= seen(b);
    }
    friend bool operator>=(c28x_float a, c28x_float b)
    {
        return seen(a) >= seen(b);
    }
    friend bool operator==(c28x_float a, c28x_float b)
    {
        return seen(a) == seen(b);
    }

private:
    static c28x_float result(float x)
    {
        return std::isnan(x) ? c28x_float(INFINITY) : c28x_float(seen(c28x_float(x)));
    }

    float x_;
};

inline c28x_float c28x_fabsf(c28x_float x)
{
    return c28x_float(std::fabs(static_cast<float>(x)));
}
inline c28x_float c28x_sqrtf(c28x_float x)
{
    return x < c28x_float(0.0F) ? c28x_float(0.0F) : c28x_float(std::sqrt(c28x_float::seen(x)));
}
inline c28x_float c28x_fmaxf(c28x_float a, c28x_float b)
{
    return a > b ? a : b;
}
inline c28x_float c28x_fminf(c28x_float a, c28x_float b)
{
    return a < b ? a : b;
}

#define fabsf c28x_fabsf
#define sqrtf c28x_sqrtf
#define fmaxf c28x_fmaxf
#define fminf c28x_fminf
#define float c28x_float
