// SPDX-License-Identifier: MIT
#include "linalg/care_problem.hpp"

#include <cmath>

namespace sdre::extended {

Matrix residual(const Problem &p, const Matrix &X)
{
    const Matrix XA = X.lazyProduct(p.A);
    return XA + XA.transpose() - p.weight.quadratic(X) + p.Q; // EQ-CARE-1
}

Scalar relative_residual(const Problem &p, const Matrix &X)
{
    const Scalar size =
        2 * p.A.transpose().lazyProduct(X).norm() + p.weight.quadratic(X).norm() + p.Q.norm();
    return size > 0 ? residual(p, X).norm() / size : Scalar(0); // EQ-CARE-2
}

Scalar backward_error(const Problem &p, const Matrix &X)
{
    const Matrix size  = X.cwiseAbs();
    const Matrix AX    = p.A.cwiseAbs().transpose().lazyProduct(size);
    const Matrix terms = AX + AX.transpose() +
                         Matrix(size.lazyProduct(p.weight.G.cwiseAbs())).lazyProduct(size) +
                         p.Q.cwiseAbs();
    const Scalar norm = terms.norm();
    return norm > 0 ? residual(p, X).norm() / norm : Scalar(0);
}

Vector balancing(const Problem &p)
{
    const Eigen::Index n = p.A.rows();
    const Matrix       A = p.A.cwiseAbs();
    const Matrix       G = p.weight.G.cwiseAbs();
    const Matrix       Q = p.Q.cwiseAbs();
    Vector             d = Vector::Ones(n);
    for (int sweep = 0; sweep < 60; ++sweep) {
        for (Eigen::Index i = 0; i < n; ++i) {
            Scalar column = 0;
            Scalar row    = 0;
            for (Eigen::Index j = 0; j < n; ++j) {
                column += Q(j, i) * d(j) * d(i) + (j != i ? A(j, i) * d(i) / d(j) : 0);
                row += G(i, j) / (d(i) * d(j)) + (j != i ? A(i, j) * d(j) / d(i) : 0);
            }
            if (column > 0 && row > 0) {
                // The diagonal entries move with the square of d: the fourth root does not
                // overshoot.
                d(i) *= std::sqrt(std::sqrt(row / column));
            }
        }
    }
    return d.unaryExpr([](Scalar v) { return std::exp2(std::round(std::log2(v))); });
}

Problem scaled(const Problem &p, const Vector &d)
{
    const Vector inv = d.cwiseInverse();
    Problem      s;
    s.A        = inv.asDiagonal() * p.A * d.asDiagonal();
    s.weight.G = inv.asDiagonal() * p.weight.G * inv.asDiagonal();
    if (p.weight.F.size() > 0) {
        s.weight.F = inv.asDiagonal() * p.weight.F;
    }
    s.Q = d.asDiagonal() * p.Q * d.asDiagonal();
    return s;
}

Matrix hamiltonian(const Problem &p)
{
    const Eigen::Index n = p.A.rows();
    Matrix             H(2 * n, 2 * n);
    H << p.A, -p.weight.G, -p.Q, -p.A.transpose();
    return H;
}

Matrix ControlWeight::quadratic(const Matrix &X) const
{
    if (F.size() == 0) {
        return Matrix(X.lazyProduct(G)).lazyProduct(X);
    }
    const Matrix FX = F.transpose().lazyProduct(X);
    return FX.transpose().lazyProduct(FX);
}

} // namespace sdre::extended
