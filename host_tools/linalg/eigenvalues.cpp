// SPDX-License-Identifier: MIT
#include "linalg/eigenvalues.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include <Eigen/Eigenvalues>

#include "linalg/hessenberg.hpp"
#include "linalg/schur.hpp"

namespace sdre {
namespace {

// The sampled loops of all laws fit without an allocation; what is larger has time for long double.
constexpr int small = 34;
using Small         = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, small, small>;

/// None when the iteration does not converge.
std::optional<Eigen::VectorXcd> eigenvalues_of(Small H)
{
    const Eigen::Index n = H.rows();
    reduce_to_hessenberg(H);
    Eigen::RealSchur<Small> schur(n);
    schur.computeFromHessenberg(H, H, false);
    if (schur.info() != Eigen::Success) {
        return std::nullopt;
    }
    const Small     &T = schur.matrixT();
    Eigen::VectorXcd values(n);
    for (Eigen::Index k = 0; k < n; k++) {
        if (k + 1 < n && T(k + 1, k) != 0.0) { // a conjugate pair
            const double p    = 0.5 * (T(k, k) - T(k + 1, k + 1));
            const double imag = std::sqrt(std::abs(p * p + T(k + 1, k) * T(k, k + 1)));
            values(k)         = {T(k + 1, k + 1) + p, imag};
            values(k + 1)     = std::conj(values(k));
            k++;
        } else {
            values(k) = T(k, k);
        }
    }
    return values;
}

} // namespace

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd &A)
{
    if (A.rows() <= small) {
        if (const auto found = eigenvalues_of(A)) {
            return *found;
        }
    }
    return extended::eigenvalues(A.cast<long double>()).cast<std::complex<double>>();
}

Eigen::VectorXcd sorted_eigenvalues(const Eigen::MatrixXd &A)
{
    Eigen::VectorXcd sorted = eigenvalues(A);
    std::sort(sorted.data(), sorted.data() + sorted.size(), [](const auto &a, const auto &b) {
        return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
    });
    return sorted;
}

double spectral_radius(const Eigen::MatrixXd &A)
{
    return A.allFinite() ? eigenvalues(A).cwiseAbs().maxCoeff()
                         : std::numeric_limits<double>::infinity();
}

} // namespace sdre
