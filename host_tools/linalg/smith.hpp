// SPDX-License-Identifier: MIT
/// A Lyapunov equation solved by doubling, for the Newton steps of the quick Riccati solver.
#pragma once

#include <array>
#include <cstddef>

#include "linalg/square.hpp"

namespace sdre {

/// X of A'X + X A + W = 0 for any number of W. X is the sum of (F')^k V F^k with F = (A + gI)(A -
/// gI)^-1, summed by squaring F.
template <std::size_t N> class Smith {
public:
    /// False when A is not Hurwitz, or close to it.
    bool prepare(const Square<N> &A, double shift)
    {
        shift_    = shift;
        resolved_ = A;
        add(resolved_, -shift, diagonal<N>(1.0));
        if (!invert(resolved_)) {
            return false;
        }
        Square<N> F = diagonal<N>(1.0);
        add(F, 2.0 * shift, resolved_);
        for (count_ = 0; count_ < doublings; count_++) {
            powers_[count_]   = F;
            const double size = norm(F);
            if (size * size < settled * settled) {
                return true;
            }
            F = product(F, F);
        }
        return false;
    }

    Square<N> solve(const Square<N> &W) const
    {
        Square<N> X = product(transposed(resolved_), product(W, resolved_));
        for (double &x : X.x) {
            x *= 2.0 * shift_;
        }
        for (std::size_t k = 0; k < count_; k++) {
            add(X, 1.0, product(transposed(powers_[k]), product(X, powers_[k])));
        }
        return symmetric_part(X);
    }

private:
    // Twice as many terms with every step: 2^16 are enough for poles that are 1e9 apart.
    static constexpr int doublings = 16;
    // Squared, it is below the rounding of a double.
    static constexpr double settled = 1e-8;

    double                           shift_ = 0.0;
    std::size_t                      count_ = 0;
    Square<N>                        resolved_;
    std::array<Square<N>, doublings> powers_;
};

} // namespace sdre
