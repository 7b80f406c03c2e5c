// SPDX-License-Identifier: MIT
#include "linalg/transfer_function.hpp"

#include <cmath>
#include <utility>

#include "linalg/hessenberg.hpp"

namespace sdre {
namespace {

/// Powers of two d that bring rows and columns of diag(d)^-1 A diag(d) to similar size. Otherwise
/// reflections mix states, and the digits of small states are lost beside large ones.
Eigen::VectorXd balancing(const Eigen::MatrixXd &A)
{
    Eigen::VectorXd d     = Eigen::VectorXd::Ones(A.rows());
    bool            moved = true;
    for (int sweep = 0; sweep < 30 && moved; sweep++) {
        moved = false;
        for (Eigen::Index i = 0; i < A.rows(); i++) {
            double column = 0.0;
            double row    = 0.0;
            for (Eigen::Index j = 0; j < A.rows(); j++) {
                column += j != i ? std::abs(A(j, i)) * d(i) / d(j) : 0.0;
                row += j != i ? std::abs(A(i, j)) * d(j) / d(i) : 0.0;
            }
            if (column > 0.0 && row > 0.0 && (row > 4.0 * column || column > 4.0 * row)) {
                d(i) *= std::exp2(std::round(0.5 * std::log2(row / column)));
                moved = true;
            }
        }
    }
    return d;
}

} // namespace

TransferFunction::TransferFunction(const Eigen::MatrixXd &A, const Eigen::VectorXd &b,
                                   const Eigen::RowVectorXd &c)
{
    const Eigen::VectorXd d = balancing(A);

    H_                = d.cwiseInverse().asDiagonal() * A * d.asDiagonal();
    Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(A.rows(), A.cols());
    reduce_to_hessenberg(H_, &Q);
    b_ = Q.transpose().lazyProduct(b.cwiseQuotient(d));
    c_ = c.cwiseProduct(d.transpose()).lazyProduct(Q);
}

std::complex<double> TransferFunction::at(std::complex<double> z) const
{
    using Complex        = std::complex<double>;
    const Eigen::Index n = H_.rows();
    Eigen::MatrixXcd   M = -H_.transpose().cast<Complex>(); // a column is a row of the system
    Eigen::VectorXcd   x = b_.cast<Complex>();
    M.diagonal().array() += z;
    for (Eigen::Index k = 0; k + 1 < n; k++) {
        if (std::norm(M(k, k + 1)) > std::norm(M(k, k))) {
            M.col(k).swap(M.col(k + 1));
            std::swap(x(k), x(k + 1));
        }
        const Complex factor = M(k, k + 1) / M(k, k);
        M.col(k + 1).tail(n - k) -= factor * M.col(k).tail(n - k);
        x(k + 1) -= factor * x(k);
    }
    Complex sum = 0.0;
    for (Eigen::Index k = n; k-- > 0;) {
        for (Eigen::Index j = k + 1; j < n; j++) {
            x(k) -= M(j, k) * x(j);
        }
        x(k) /= M(k, k);
        sum += c_(k) * x(k);
    }
    return sum;
}

} // namespace sdre
