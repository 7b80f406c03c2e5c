// SPDX-License-Identifier: MIT
#include "linalg/product.hpp"

#include <algorithm>
#include <array>

namespace sdre::extended {

Matrix product(const Matrix &A, const Matrix &B)
{
    constexpr Eigen::Index at_once = 4;
    const Eigen::Index     rows    = A.rows();
    const Eigen::Index     inner   = A.cols();
    Matrix                 C(rows, B.cols());
    for (Eigen::Index j = 0; j < B.cols(); j++) {
        const Scalar *column = B.data() + j * inner;
        for (Eigen::Index i = 0; i < rows; i += at_once) {
            if (rows - i < at_once) {
                for (Eigen::Index r = i; r < rows; r++) {
                    Scalar sum = 0;
                    for (Eigen::Index k = 0; k < inner; k++) {
                        sum += A(r, k) * column[k];
                    }
                    C(r, j) = sum;
                }
                break;
            }
            Scalar        s0 = 0, s1 = 0, s2 = 0, s3 = 0;
            const Scalar *a = A.data() + i;
            for (Eigen::Index k = 0; k < inner; k++, a += rows) {
                const Scalar b = column[k];
                s0 += a[0] * b;
                s1 += a[1] * b;
                s2 += a[2] * b;
                s3 += a[3] * b;
            }
            C(i, j)     = s0;
            C(i + 1, j) = s1;
            C(i + 2, j) = s2;
            C(i + 3, j) = s3;
        }
    }
    return C;
}

} // namespace sdre::extended
