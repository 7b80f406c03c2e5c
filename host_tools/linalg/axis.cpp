// SPDX-License-Identifier: MIT
#include "linalg/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "linalg/inverse.hpp"

namespace sdre::extended {

namespace {

/// Spectral radius of a matrix without negative entries, to the few percent that a threshold needs.
Scalar perron_root(const Matrix &P)
{
    Vector v    = Vector::Ones(P.cols());
    Scalar root = 0;
    for (int step = 0; step < 30; ++step) {
        const Vector next = P.lazyProduct(v);
        root              = next.maxCoeff();
        if (!(root > 0) || !std::isfinite(root)) {
            return root;
        }
        v = next / root;
    }
    return root;
}

/// Indices of the eigenvalues with Im >= 0 in ascending order of `key`, at most six.
template <class Key> std::vector<Eigen::Index> nearest(const ComplexVector &eigenvalues, Key key)
{
    std::vector<Eigen::Index> order;
    for (Eigen::Index i = 0; i < eigenvalues.size(); ++i) {
        if (eigenvalues(i).imag() >= 0) {
            order.push_back(i);
        }
    }
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return key(eigenvalues(a)) < key(eigenvalues(b));
    });
    order.resize(std::min<std::size_t>(order.size(), 6));
    return order;
}

} // namespace

bool touches_axis(const Matrix &M, Scalar omega)
{
    // M - j omega I can become singular under a change |dM| <= t |M| in one case only: t rho(|(M -
    // j omega I)^-1| |M|) >= 1. Every diagonal scaling of the states has the same rho.
    const Eigen::Index n       = M.rows();
    ComplexMatrix      shifted = M.cast<Complex>();
    shifted.diagonal().array() -= Complex(0, omega);
    const Matrix response = inverse(shifted).cwiseAbs();
    if (!response.allFinite()) {
        return true;
    }
    const Scalar rounding =
        Scalar(2 * n) * static_cast<Scalar>(std::numeric_limits<double>::epsilon());
    return !(perron_root(response.lazyProduct(M.cwiseAbs())) * rounding < 1);
}

bool find_axis_eigenvalue(const Matrix &M, const ComplexVector &eigenvalues, Complex &found)
{
    const auto absolute = nearest(eigenvalues, [](Complex s) { return std::abs(s.real()); });
    const auto relative = nearest(eigenvalues, [](Complex s) {
        const Scalar size = std::abs(s);
        return size > 0 ? std::abs(s.real()) / size : Scalar(0);
    });
    std::vector<Scalar> tried;
    for (const auto &order : {absolute, relative}) {
        for (const Eigen::Index i : order) {
            const Scalar omega = eigenvalues(i).imag();
            if (std::find(tried.begin(), tried.end(), omega) != tried.end()) {
                continue;
            }
            tried.push_back(omega);
            if (touches_axis(M, omega)) {
                found = Complex(0, omega);
                return true;
            }
        }
    }
    return false;
}

} // namespace sdre::extended
