// SPDX-License-Identifier: MIT
#include "linalg/care_doubling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "linalg/eigenvalues.hpp"
#include "linalg/smith.hpp"
#include "linalg/square.hpp"

namespace sdre {
namespace {

using Index = Eigen::Index;

// Twice as many samples with every step: 2^16 are enough for poles that are 1e9 apart.
constexpr int doublings_max = 16;
// The error is squared with every step, so what is left is below the rounding of a double.
constexpr double settled = 1e-8;
// A Newton step squares the error of X.
constexpr double newton_enough = 1e-9;
// Chosen: a rounding of the entries of A, G, Q moves X by 1e-9 at most, so no broken assumption is near.
constexpr double condition_limit = 1e7;
// Measured on drives and benchmark cases: 2e-16 at most.
constexpr long double residual_limit = 1e-15L;

/// The problem in the states z, x = diag(d) z, with padding that is stable and coupled to nothing.
template <std::size_t N> class Doubling {
public:
    explicit Doubling(const DoublingProblem &p)
        : given_(p), n_(static_cast<std::size_t>(p.A.rows()))
    {
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i < n_; i++) {
                const auto row = static_cast<Index>(i);
                const auto col = static_cast<Index>(j);
                A_(i, j)       = p.A(row, col);
                G_(i, j)       = 0.5 * p.G(row, col) + 0.5 * p.G(col, row);
                Q_(i, j)       = 0.5 * p.Q(row, col) + 0.5 * p.Q(col, row);
            }
        }
        balance();
    }

    std::optional<CareSolution> solve()
    {
        Square<N> X;
        Smith<N>  smith;
        if (!start(X) || !smith.prepare(closed_loop(X), shift_)) {
            return {};
        }
        double correction = 1.0;
        for (int step = 0; step < 3 && correction > newton_enough; step++) {
            const Square<N> change = smith.solve(residual(X));
            add(X, 1.0, change);
            correction = norm(change) / std::max(norm(X), 1e-300);
        }
        if (!(correction <= newton_enough) || !(condition(X, smith) <= condition_limit)) {
            return {};
        }
        return verified(X);
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

    /// Geometric mean of the closed loop's poles: they are half of the Hamiltonian's.
    double pole_size() const
    {
        Square<2 *N> H = diagonal<2 * N>(1.0);
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i < n_; i++) {
                H(i, j)         = A_(i, j);
                H(i, N + j)     = -G_(i, j);
                H(N + i, j)     = -Q_(i, j);
                H(N + i, N + j) = -A_(j, i);
            }
        }
        return std::exp2(log2_determinant(H) / static_cast<double>(2 * n_));
    }

    /// The Cayley transform of the Hamiltonian, then doubling.
    bool start(Square<N> &H)
    {
        shift_ = pole_size();
        if (!(shift_ > 0.0) || !std::isfinite(shift_)) {
            return false;
        }
        for (std::size_t i = n_; i < N; i++) {
            A_(i, i) = -shift_;
        }

        Square<N> inverse = A_;
        add(inverse, -shift_, diagonal<N>(1.0));
        Square<N> M = transposed(inverse);
        if (!invert(inverse)) {
            return false;
        }
        const Square<N> AG = product(inverse, G_);
        add(M, 1.0, product(Q_, AG));
        if (!invert(M)) {
            return false;
        }
        Square<N> E = diagonal<N>(1.0);
        add(E, 2.0 * shift_, transposed(M));
        Square<N> G;
        add(G, 2.0 * shift_, symmetric_part(product(AG, M)));
        H = Square<N>{};
        add(H, 2.0 * shift_, symmetric_part(product(M, product(Q_, inverse))));
        return doubled(E, G, H);
    }

    static bool doubled(Square<N> E, Square<N> G, Square<N> &H)
    {
        for (int k = 0; k < doublings_max; k++) {
            Square<N> W = diagonal<N>(1.0);
            add(W, 1.0, product(G, H));
            if (!invert(W)) {
                return false;
            }
            const Square<N> WE   = product(W, E);
            const Square<N> step = symmetric_part(product(transposed(E), product(H, WE)));
            add(H, 1.0, step);
            const double size = norm(H);
            if (!std::isfinite(size)) {
                return false;
            }
            if (norm(step) <= settled * size) {
                return true;
            }
            add(G, 1.0, symmetric_part(product(E, product(product(W, G), transposed(E)))));
            E = product(E, WE);
        }
        return false;
    }

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

    using Long = std::array<long double, N * N>;

    void quadratic(const Square<N> &X, Long &XGX) const
    {
        if (given_.F == nullptr) {
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
        for (Index c = 0; c < given_.F->cols(); c++) {
            std::array<long double, N> f{};
            std::array<long double, N> FX{};
            for (std::size_t i = 0; i < n_; i++) {
                f[i] = (*given_.F)(static_cast<Index>(i), c) / static_cast<long double>(d_[i]);
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

    /// How much larger the relative change of X is than that of the entries of A, G and Q behind it.
    double condition(const Square<N> &X, const Smith<N> &smith) const
    {
        const auto size = [](Square<N> M) {
            for (double &x : M.x) {
                x = std::abs(x);
            }
            return M;
        };
        const Square<N> Xs    = size(X);
        const Square<N> XA    = product(Xs, size(A_));
        Square<N>       terms = product(Xs, product(size(G_), Xs));
        add(terms, 1.0, XA);
        add(terms, 1.0, transposed(XA));
        add(terms, 1.0, size(Q_));
        const double change = norm(smith.solve(terms));
        return change > 0.0 ? change / norm(X) : 0.0;
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

    std::optional<CareSolution> verified(const Square<N> &X) const
    {
        const long double rest = relative_residual(X);
        if (!(rest <= residual_limit)) {
            return {};
        }
        CareSolution    out;
        const auto      n   = static_cast<Index>(n_);
        const Square<N> Acl = closed_loop(X);
        Eigen::MatrixXd poles_of(n, n);
        out.X.resize(n, n);
        for (std::size_t j = 0; j < n_; j++) {
            for (std::size_t i = 0; i < n_; i++) {
                const auto row     = static_cast<Index>(i);
                const auto col     = static_cast<Index>(j);
                out.X(row, col)    = X(i, j) / d_[i] / d_[j];
                poles_of(row, col) = Acl(i, j);
            }
        }
        out.relative_residual       = static_cast<double>(rest);
        out.closed_loop_eigenvalues = sorted_eigenvalues(poles_of);
        if (!out.X.allFinite() || !(out.closed_loop_eigenvalues(n - 1).real() < 0.0)) {
            return {};
        }
        return out;
    }

    const DoublingProblem &given_;
    std::size_t            n_;
    std::array<double, N>  d_{};
    Square<N>              A_, G_, Q_;
    double                 shift_ = 0.0;
};

} // namespace

std::optional<CareSolution> solve_care_by_doubling(const DoublingProblem &problem)
{
    const Index n = problem.A.rows();
    if (n > 16) {
        return {};
    }
    return n <= 4    ? Doubling<4>(problem).solve()
           : n <= 6  ? Doubling<6>(problem).solve()
           : n <= 8  ? Doubling<8>(problem).solve()
           : n <= 12 ? Doubling<12>(problem).solve()
                     : Doubling<16>(problem).solve();
}

} // namespace sdre
