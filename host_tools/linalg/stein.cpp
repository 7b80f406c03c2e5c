// SPDX-License-Identifier: MIT
#include "linalg/stein.hpp"

#include <cmath>

#include "common/errors.hpp"
#include "linalg/product.hpp"

namespace sdre::extended {
namespace {

// 2^60 periods: a mode that has not settled by then never does.
constexpr int    doublings_max = 60;
constexpr Scalar settled       = 1e-17L;

} // namespace

Matrix solve_stein(Matrix F, const Matrix &W)
{
    Matrix X = W;
    for (int k = 0; k < doublings_max; k++) {
        const Matrix FX   = product(F, X);
        const Matrix step = symmetric_part(product(FX, F.transpose()));
        X += step;
        F = product(F, F);
        if (step.norm() <= settled * X.norm()) {
            return X;
        }
    }
    throw DesignError("Stein equation: the sampled observer does not settle");
}

} // namespace sdre::extended
