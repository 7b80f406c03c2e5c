// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/care.hpp"
#include "linalg/extended.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre::extended {

ControlWeight control_weight(const Eigen::MatrixXd &B, const Eigen::MatrixXd &R)
{
    require_square(R, "R");
    if (B.rows() == 0 || B.cols() != R.rows()) {
        throw InputError(fmt::format("B is {} x {}, must have {} columns like R and not be empty",
                                     B.rows(), B.cols(), R.rows()));
    }
    require_finite(B, "B");
    require_finite(R, "R");
    require_symmetric(R, "R");

    // Cholesky by hand: the pivots decide whether R is positive definite to the digits of a double.
    const Eigen::Index m = R.rows();
    Matrix             L = Matrix::Zero(m, m);
    for (Eigen::Index j = 0; j < m; ++j) {
        const Scalar diagonal = R(j, j);
        const Scalar pivot    = diagonal - L.row(j).head(j).squaredNorm();
        if (!(pivot > Scalar(m) * Scalar(std::numeric_limits<double>::epsilon()) * diagonal)) {
            throw DesignError("R is not positive definite");
        }
        L(j, j) = std::sqrt(pivot);
        for (Eigen::Index i = j + 1; i < m; ++i) {
            const Scalar entry = (Scalar(R(i, j)) + Scalar(R(j, i))) / 2;
            L(i, j)            = (entry - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
        }
    }
    ControlWeight weight;
    weight.F = B.cast<Scalar>(); // F L' = B
    for (Eigen::Index j = 0; j < m; ++j) {
        weight.F.col(j) -= weight.F.leftCols(j).lazyProduct(L.row(j).head(j).transpose());
        weight.F.col(j) /= L(j, j);
    }
    weight.G = symmetric_part(weight.F.lazyProduct(weight.F.transpose()));
    return weight;
}

} // namespace sdre::extended

namespace sdre {

Eigen::MatrixXd control_weight(const Eigen::MatrixXd &B, const Eigen::MatrixXd &R)
{
    const Eigen::MatrixXd G = extended::control_weight(B, R).G.cast<double>();
    if (!G.allFinite()) {
        throw DesignError("B R^-1 B' exceeds the range of a double");
    }
    return G;
}

} // namespace sdre
