// SPDX-License-Identifier: MIT
#include "linalg/sampled_riccati.hpp"

#include <cmath>

#include "common/errors.hpp"
#include "linalg/eigenvalues.hpp"
#include "linalg/inverse.hpp"
#include "linalg/product.hpp"
#include "linalg/stein.hpp"

namespace sdre {
namespace {

using extended::Matrix;
using extended::product;
using extended::symmetric_part;

// 2^60 periods: a mode that has not settled by then never does.
constexpr int         dare_doublings_max = 60;
constexpr long double dare_settled       = 1e-17L;

Matrix times(const Matrix &A, const Matrix &B, const Matrix &C)
{
    return product(product(A, B), C);
}

/// P of EQ-DARE-1 by structure-preserving doubling: H after k steps is P after 2^k periods from nothing.
Matrix solve_riccati(const Matrix &A, const Matrix &G, const Matrix &Q)
{
    const Matrix I = Matrix::Identity(A.rows(), A.cols());
    Matrix       E = A.transpose();
    Matrix       g = G;
    Matrix       H = Q;
    for (int k = 0; k < dare_doublings_max; k++) {
        const Matrix W    = extended::inverse(Matrix(I + product(g, H)));
        const Matrix WE   = product(W, E);
        const Matrix step = symmetric_part(times(E.transpose(), H, WE));
        g += symmetric_part(times(E, product(W, g), E.transpose()));
        E = product(E, WE);
        H += step;
        if (!std::isfinite(static_cast<double>(H.norm()))) {
            break;
        }
        if (step.norm() <= dare_settled * H.norm()) {
            return H;
        }
    }
    throw DesignError("sampled Riccati equation: no stabilising solution found");
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

    const Matrix Ct        = C.transpose();
    const Matrix P         = solve_riccati(A, times(Ct, extended::inverse(R), C), Q);
    const Matrix S_inverse = extended::inverse(Matrix(times(C, P, Ct) + R));
    const Matrix K         = times(P, Ct, S_inverse);
    const Matrix left      = I - product(K, C);
    const Matrix after     = symmetric_part(product(left, P));
    const Matrix F         = product(A, left);
    const Matrix W =
        symmetric_part(2.0L * times(A1, after, A.transpose())) + p.Q1.cast<long double>();
    const Matrix P1 = extended::solve_stein(F, W);
    const Matrix K1 = product(times(left, P1, Ct), S_inverse);

    SampledObserverGain out;
    out.K0               = K.cast<double>();
    out.K1               = K1.cast<double>();
    out.P0               = P.cast<double>();
    out.P1               = P1.cast<double>();
    out.riccati_residual = relative(P - (times(A, after, A.transpose()) + Q), P, Q);
    out.stein_residual   = relative(P1 - (times(F, P1, F.transpose()) + W), P1, W);
    out.spectral_radius  = spectral_radius(F.cast<double>());
    if (!(out.spectral_radius < 1.0)) {
        throw DesignError("sampled Riccati equation: no stabilising solution found");
    }
    return out;
}

} // namespace sdre
