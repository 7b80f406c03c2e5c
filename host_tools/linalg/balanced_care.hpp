// SPDX-License-Identifier: MIT
/// EQ-CARE-1 in balanced states, with residuals in extended precision, for the quick solver.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "linalg/care_doubling.hpp"
#include "linalg/square.hpp"

namespace sdre {

/// The problem in the states z, x = diag(d) z, in the first n rows and columns. The rest is padding: zero.
template <std::size_t N> class BalancedCare {
public:
    explicit BalancedCare(const DoublingProblem &p)
        : F_(p.F), n_(static_cast<std::size_t>(p.A.rows()))
    {
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i < n_; i++) {
                const auto row = static_cast<Eigen::Index>(i);
                const auto col = static_cast<Eigen::Index>(j);
                A_(i, j)       = p.A(row, col);
                G_(i, j)       = 0.5 * p.G(row, col) + 0.5 * p.G(col, row);
                Q_(i, j)       = 0.5 * p.Q(row, col) + 0.5 * p.Q(col, row);
            }
        }
        balance();
    }

    std::size_t n() const
    {
        return n_;
    }
    const Square<N> &A() const
    {
        return A_;
    }
    const Square<N> &G() const
    {
        return G_;
    }
    const Square<N> &Q() const
    {
        return Q_;
    }
    double d(std::size_t state) const
    {
        return d_[state];
    }

    /// Stable modes in the padding, coupled to nothing.
    void pad(double pole)
    {
        for (std::size_t i = n_; i < N; i++) {
            A_(i, i) = -pole;
        }
    }

    /// A - G X
    Square<N> closed_loop(const Square<N> &X) const
    {
        Square<N> Acl = A_;
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i < n_; i++) {
                Acl(i, j) = static_cast<double>(static_cast<long double>(A_(i, j)) -
                                                dot(&G_.x[i * N], &X.x[j * N], n_));
            }
        }
        return Acl;
    }

    /// A'X + XA - XGX + Q
    Square<N> residual(const Square<N> &X) const
    {
        Terms t;
        evaluate(X, t);
        Square<N> R;
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i <= j; i++) {
                R(i, j) = R(j, i) = static_cast<double>(t.residual[i + j * N]);
            }
        }
        return R;
    }

    /// EQ-CARE-2 in the states that were given.
    long double relative_residual(const Square<N> &X) const
    {
        Terms t;
        evaluate(X, t);
        long double AX = 0.0L, XGX = 0.0L, Q = 0.0L, R = 0.0L;
        const auto  square = [](long double x) { return x * x; };
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i <= j; i++) {
                const long double s =
                    1.0L / (static_cast<long double>(d_[i]) * static_cast<long double>(d_[j]));
                const long double twice = i == j ? 1.0L : 2.0L;
                AX += square(s * t.XA[i + j * N]) + (i == j ? 0.0L : square(s * t.XA[j + i * N]));
                XGX += twice * square(s * t.XGX[i + j * N]);
                Q += twice * square(s * static_cast<long double>(Q_(i, j)));
                R += twice * square(s * t.residual[i + j * N]);
            }
        }
        const long double size = 2.0L * std::sqrt(AX) + std::sqrt(XGX) + std::sqrt(Q);
        return size > 0.0L ? std::sqrt(R) / size : 0.0L;
    }

private:
    /// As the extended solver balances, but only until it is good enough.
    void balance()
    {
        d_.fill(1.0);
        bool moved = true;
        for (int sweep = 0; sweep < 30 && moved; sweep++) {
            moved = false;
            for (std::size_t i = 0; i < n_; i++) {
                double column = 0.0;
                double row    = 0.0;
                for (std::size_t j = 0; j < n_; j++) {
                    const double ratio = j != i ? d_[i] / d_[j] : 0.0;
                    column += std::abs(Q_(j, i)) * d_[j] * d_[i] + std::abs(A_(j, i)) * ratio;
                    row += std::abs(G_(j, i)) / (d_[j] * d_[i]) +
                           (j != i ? std::abs(A_(i, j)) / ratio : 0.0);
                }
                if (column > 0.0 && row > 0.0 && (row > 4.0 * column || column > 4.0 * row)) {
                    d_[i] *= std::exp2(std::round(0.25 * std::log2(row / column)));
                    moved = true;
                }
            }
        }
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i < n_; i++) {
                A_(i, j) *= d_[j] / d_[i];
                G_(i, j) /= d_[i] * d_[j];
                Q_(i, j) *= d_[i] * d_[j];
            }
        }
    }

    using Long = std::array<long double, N * N>;

    void quadratic(const Square<N> &X, Long &XGX) const
    {
        if (F_ == nullptr) {
            Long GX{};
            for (std::size_t j = 0; j < n_; j++) {
                for (std::size_t i = 0; i < n_; i++) {
                    GX[i + j * N] = dot(&G_.x[i * N], &X.x[j * N], n_);
                }
            }
            for (std::size_t j = 0; j < n_; j++) {
                for (std::size_t i = 0; i <= j; i++) {
                    XGX[i + j * N] = dot(&X.x[i * N], &GX[j * N], n_);
                }
            }
            return;
        }
        XGX.fill(0.0L);
        for (Eigen::Index c = 0; c < F_->cols(); c++) {
            std::array<long double, N> f{};
            std::array<long double, N> FX{};
            for (std::size_t i = 0; i < n_; i++) {
                f[i] = (*F_)(static_cast<Eigen::Index>(i), c) / static_cast<long double>(d_[i]);
            }
            for (std::size_t j = 0; j < n_; j++) {
                FX[j] = dot(&X.x[j * N], f.data(), n_);
                for (std::size_t i = 0; i <= j; i++) {
                    XGX[i + j * N] += FX[i] * FX[j];
                }
            }
        }
    }

    /// Upper triangles of the three terms of EQ-CARE-1 that depend on X, and the residual.
    struct Terms {
        Long XA{}; ///< all of it
        Long XGX{};
        Long residual{};
    };

    void evaluate(const Square<N> &X, Terms &t) const
    {
        quadratic(X, t.XGX);
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i < n_; i++) {
                t.XA[i + j * N] = dot(&X.x[i * N], &A_.x[j * N], n_);
            }
        }
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i <= j; i++) {
                const long double AX  = t.XA[i + j * N] + t.XA[j + i * N];
                t.residual[i + j * N] = AX - t.XGX[i + j * N] + static_cast<long double>(Q_(i, j));
            }
        }
    }

    const extended::Matrix *F_;
    std::size_t             n_;
    std::array<double, N>   d_{};
    Square<N>               A_, G_, Q_;
};

} // namespace sdre
