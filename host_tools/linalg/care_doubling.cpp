// SPDX-License-Identifier: MIT
#include "linalg/care_doubling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "linalg/balanced_care.hpp"
#include "linalg/eigenvalues.hpp"
#include "linalg/smith.hpp"
#include "linalg/square.hpp"

namespace sdre {
namespace {

using Index = Eigen::Index;

// Twice as many samples with every step: 2^16 are enough for poles that are 1e9 apart.
constexpr int care_doublings_max = 16;
// The error is squared with every step, so what is left is below the rounding of a double.
constexpr double care_settled = 1e-8;
// A Newton step squares the error of X.
constexpr double newton_enough = 1e-9;
// Chosen: rounding the entries of A, G, Q moves X by 1e-9 at most, so no assumption nearly fails.
constexpr double condition_limit = 1e7;
// Measured on drives and benchmark cases: 2e-16 at most.
constexpr long double residual_limit = 1e-15L;

template <std::size_t N> class Doubling {
public:
    explicit Doubling(const DoublingProblem &p) : p_(p) {}

    std::optional<CareSolution> solve()
    {
        Square<N> X;
        Smith<N>  smith;
        if (!start(X) || !smith.prepare(p_.closed_loop(X), shift_)) {
            return {};
        }
        double correction = 1.0;
        for (int step = 0; step < 3 && correction > newton_enough; step++) {
            const Square<N> change = smith.solve(p_.residual(X));
            add(X, 1.0, change);
            correction = norm(change) / std::max(norm(X), 1e-300);
        }
        if (!(correction <= newton_enough) || !(condition(X, smith) <= condition_limit)) {
            return {};
        }
        return verified(X);
    }

private:
    /// Geometric mean of the closed loop's poles: they are half of the Hamiltonian's.
    double pole_size() const
    {
        Square<2 *N> H = diagonal<2 * N>(1.0);
        for (std::size_t j = 0; j < p_.n(); j++) {
            for (std::size_t i = 0; i < p_.n(); i++) {
                H(i, j)         = p_.A()(i, j);
                H(i, N + j)     = -p_.G()(i, j);
                H(N + i, j)     = -p_.Q()(i, j);
                H(N + i, N + j) = -p_.A()(j, i);
            }
        }
        return std::exp2(log2_determinant(H) / static_cast<double>(2 * p_.n()));
    }

    /// The Cayley transform of the Hamiltonian, then doubling.
    bool start(Square<N> &H)
    {
        shift_ = pole_size();
        if (!(shift_ > 0.0) || !std::isfinite(shift_)) {
            return false;
        }
        p_.pad(shift_);

        Square<N> inverse = p_.A();
        add(inverse, -shift_, diagonal<N>(1.0));
        Square<N> M = transposed(inverse);
        if (!invert(inverse)) {
            return false;
        }
        const Square<N> AG = product(inverse, p_.G());
        add(M, 1.0, product(p_.Q(), AG));
        if (!invert(M)) {
            return false;
        }
        Square<N> E = diagonal<N>(1.0);
        add(E, 2.0 * shift_, transposed(M));
        Square<N> G;
        add(G, 2.0 * shift_, symmetric_part(product(AG, M)));
        H = Square<N>{};
        add(H, 2.0 * shift_, symmetric_part(product(M, product(p_.Q(), inverse))));
        return doubled(E, G, H);
    }

    static bool doubled(Square<N> E, Square<N> G, Square<N> &H)
    {
        for (int k = 0; k < care_doublings_max; k++) {
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
            if (norm(step) <= care_settled * size) {
                return true;
            }
            add(G, 1.0, symmetric_part(product(E, product(product(W, G), transposed(E)))));
            E = product(E, WE);
        }
        return false;
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
        const Square<N> XA    = product(Xs, size(p_.A()));
        Square<N>       terms = product(Xs, product(size(p_.G()), Xs));
        add(terms, 1.0, XA);
        add(terms, 1.0, transposed(XA));
        add(terms, 1.0, size(p_.Q()));
        const double change = norm(smith.solve(terms));
        return change > 0.0 ? change / norm(X) : 0.0;
    }

    std::optional<CareSolution> verified(const Square<N> &X) const
    {
        const long double rest = p_.relative_residual(X);
        if (!(rest <= residual_limit)) {
            return {};
        }
        CareSolution    out;
        const auto      n   = static_cast<Index>(p_.n());
        const Square<N> Acl = p_.closed_loop(X);
        Eigen::MatrixXd poles_of(n, n);
        out.X.resize(n, n);
        for (std::size_t j = 0; j < p_.n(); j++) {
            for (std::size_t i = 0; i < p_.n(); i++) {
                const auto row     = static_cast<Index>(i);
                const auto col     = static_cast<Index>(j);
                out.X(row, col)    = X(i, j) / p_.d(i) / p_.d(j);
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

    BalancedCare<N> p_;
    double          shift_ = 0.0;
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
