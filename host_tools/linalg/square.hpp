// SPDX-License-Identifier: MIT
/// Small square matrices in double on the stack, for the quick solvers. The compiler knows the
/// size, so loops have no remainders and nothing is allocated. A problem of n states is padded to
/// the next size.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sdre {

/// Column-major N x N.
template <std::size_t N> struct Square {
    alignas(16) std::array<double, N * N> x{};

    double &operator()(std::size_t row, std::size_t column)
    {
        return x[row + column * N];
    }
    double operator()(std::size_t row, std::size_t column) const
    {
        return x[row + column * N];
    }
};

template <std::size_t N> Square<N> diagonal(double value)
{
    Square<N> D;
    for (std::size_t i = 0; i < N; i++) {
        D(i, i) = value;
    }
    return D;
}

/// A B, in blocks of rows that stay in registers.
template <std::size_t N> Square<N> product(const Square<N> &A, const Square<N> &B)
{
    constexpr std::size_t rows = N % 4 == 0 ? 4 : 2;
    static_assert(N % rows == 0);
    Square<N> C;
    for (std::size_t i = 0; i < N; i += rows) {
        for (std::size_t j = 0; j < N; j++) {
            std::array<double, rows> sum{};
            for (std::size_t k = 0; k < N; k++) {
                for (std::size_t r = 0; r < rows; r++) {
                    sum[r] += A.x[i + r + k * N] * B.x[k + j * N];
                }
            }
            for (std::size_t r = 0; r < rows; r++) {
                C.x[i + r + j * N] = sum[r];
            }
        }
    }
    return C;
}

template <std::size_t N> Square<N> transposed(const Square<N> &A)
{
    Square<N> T;
    for (std::size_t j = 0; j < N; j++) {
        for (std::size_t i = 0; i < N; i++) {
            T.x[i + j * N] = A.x[j + i * N];
        }
    }
    return T;
}

/// sum += factor * A
template <std::size_t N> void add(Square<N> &sum, double factor, const Square<N> &A)
{
    for (std::size_t i = 0; i < N * N; i++) {
        sum.x[i] += factor * A.x[i];
    }
}

/// (A + A') / 2
template <std::size_t N> Square<N> symmetric_part(const Square<N> &A)
{
    Square<N> S = transposed(A);
    for (std::size_t i = 0; i < N * N; i++) {
        S.x[i] = 0.5 * (S.x[i] + A.x[i]);
    }
    return S;
}

/// Frobenius norm.
template <std::size_t N> double norm(const Square<N> &A)
{
    double sum = 0.0;
    for (const double value : A.x) {
        sum += value * value;
    }
    return std::sqrt(sum);
}

/// Gauss-Jordan with row pivots, in place. False when A is singular; a nearly singular one shows in the residual of
/// what is made of the inverse.
template <std::size_t N> bool invert(Square<N> &A)
{
    std::array<std::size_t, N> swapped{};
    for (std::size_t k = 0; k < N; k++) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < N; i++) {
            pivot = std::abs(A(i, k)) > std::abs(A(pivot, k)) ? i : pivot;
        }
        swapped[k] = pivot;
        if (!(std::abs(A(pivot, k)) > 0.0)) {
            return false;
        }
        if (pivot != k) {
            for (std::size_t j = 0; j < N; j++) {
                std::swap(A(k, j), A(pivot, j));
            }
        }
        const double          inverse = 1.0 / A(k, k);
        std::array<double, N> factor;
        for (std::size_t i = 0; i < N; i++) {
            factor[i] = A(i, k);
            A(i, k)   = 0.0;
        }
        factor[k] = 0.0;
        A(k, k)   = 1.0;
        for (std::size_t j = 0; j < N; j++) {
            const double row = A(k, j) * inverse;
            for (std::size_t i = 0; i < N; i++) {
                A.x[i + j * N] -= factor[i] * row;
            }
            A(k, j) = row;
        }
    }
    for (std::size_t k = N; k-- > 0;) {
        if (swapped[k] != k) {
            for (std::size_t i = 0; i < N; i++) {
                std::swap(A(i, k), A(i, swapped[k]));
            }
        }
    }
    return true;
}

/// log2 |det A|, -inf for a singular A.
template <std::size_t N> double log2_determinant(Square<N> A)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < N; k++) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < N; i++) {
            pivot = std::abs(A(i, k)) > std::abs(A(pivot, k)) ? i : pivot;
        }
        sum += std::log2(std::abs(A(pivot, k)));
        if (!std::isfinite(sum)) {
            return sum;
        }
        std::swap(A(k, k), A(pivot, k));
        const double inverse = 1.0 / A(k, k);
        for (std::size_t j = k + 1; j < N; j++) {
            std::swap(A(k, j), A(pivot, j));
            const double factor = inverse * A(k, j);
            if (factor != 0.0) {
                for (std::size_t i = k + 1; i < N; i++) {
                    A(i, j) -= factor * A(i, k);
                }
            }
        }
    }
    return sum;
}

/// sum of a[i] b[i] in extended precision, in four sums that do not wait for each other.
template <class T> long double dot(const double *a, const T *b, std::size_t n)
{
    std::array<long double, 4> sum{};
    std::size_t                i = 0;
    for (; i + 4 <= n; i += 4) {
        for (std::size_t k = 0; k < 4; k++) {
            sum[k] += static_cast<long double>(a[i + k]) * static_cast<long double>(b[i + k]);
        }
    }
    for (; i < n; i++) {
        sum[0] += static_cast<long double>(a[i]) * static_cast<long double>(b[i]);
    }
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

} // namespace sdre
