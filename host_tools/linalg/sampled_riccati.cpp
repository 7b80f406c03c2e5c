// SPDX-License-Identifier: MIT
#include "linalg/sampled_riccati.hpp"

#include <cmath>

#include <Eigen/LU>

#include "common/errors.hpp"
#include "linalg/matrix_functions.hpp"

namespace sdre {
namespace {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// 2^60 periods: a mode that has not settled by then never does.
constexpr int         doublings_max = 60;
constexpr long double settled       = 1e-17L;

Matrix symmetric(const Matrix &X)
{
    return 0.5L * (X + X.transpose());
}

/// P of EQ-DARE-1 by structure-preserving doubling: H after k steps is P after 2^k periods from nothing.
Matrix solve_riccati(const Matrix &A, const Matrix &G, const Matrix &Q)
{
    const Matrix I = Matrix::Identity(A.rows(), A.cols());
    Matrix       E = A.transpose();
    Matrix       g = G;
    Matrix       H = Q;
    for (int k = 0; k < doublings_max; k++) {
        const Eigen::PartialPivLU<Matrix> W(I + g * H);
        const Matrix                      WE   = W.solve(E);
        const Matrix                      step = symmetric(E.transpose() * H * WE);
        g += symmetric(E * W.solve(g) * E.transpose());
        E = E * WE;
        H += step;
        if (!std::isfinite(static_cast<double>(H.norm()))) {
            break;
        }
        if (step.norm() <= settled * H.norm()) {
            return H;
        }
    }
    throw DesignError("sampled Riccati equation: no stabilising solution found");
}

/// X = F X F' + W by squaring F.
Matrix solve_stein(Matrix F, const Matrix &W)
{
    Matrix X = W;
    for (int k = 0; k < doublings_max; k++) {
        const Matrix step = symmetric(F * X * F.transpose());
        X += step;
        F = F * F;
        if (step.norm() <= settled * X.norm()) {
            return X;
        }
    }
    throw DesignError("Stein equation: the sampled observer does not settle");
}

double relative(const Matrix &residual, const Matrix &a, const Matrix &b)
{
    const long double scale = a.norm() + b.norm();
    return scale > 0.0L ? static_cast<double>(residual.norm() / scale) : 0.0;
}

} // namespace

SampledObserverGain solve_sampled_observer(const SampledObserverProblem &p)
{
    const Matrix A  = p.A0.cast<long double>();
    const Matrix A1 = p.A1.cast<long double>();
    const Matrix Q  = p.Q0.cast<long double>();
    const Matrix C  = p.C.cast<long double>();
    const Matrix R  = p.R.cast<long double>();
    const Matrix I  = Matrix::Identity(A.rows(), A.cols());

    const Matrix P         = solve_riccati(A, C.transpose() * R.inverse() * C, Q);
    const Matrix S_inverse = Matrix(C * P * C.transpose() + R).inverse();
    const Matrix K         = P * C.transpose() * S_inverse;
    const Matrix left      = I - K * C;
    const Matrix after     = symmetric(left * P);
    const Matrix F         = A * left;
    const Matrix W  = symmetric(2.0L * A1 * after * A.transpose()) + p.Q1.cast<long double>();
    const Matrix P1 = solve_stein(F, W);
    const Matrix K1 = left * P1 * C.transpose() * S_inverse;

    SampledObserverGain out;
    out.K0               = K.cast<double>();
    out.K1               = K1.cast<double>();
    out.P0               = P.cast<double>();
    out.P1               = P1.cast<double>();
    out.riccati_residual = relative(P - (A * after * A.transpose() + Q), P, Q);
    out.stein_residual   = relative(P1 - (F * P1 * F.transpose() + W), P1, W);
    out.spectral_radius  = spectral_radius(F.cast<double>());
    if (!(out.spectral_radius < 1.0)) {
        throw DesignError("sampled Riccati equation: no stabilising solution found");
    }
    return out;
}

} // namespace sdre
