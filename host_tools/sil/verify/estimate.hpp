// SPDX-License-Identifier: MIT
/// From features to the machine that has them.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Dense>

#include "sil/verify/rehearsal.hpp"

namespace sdre {

/// A machine that fits the features, and how badly it does.
struct Estimate {
    Difference difference{};
    double misfit = 0.0; ///< logarithm of the mean square that is left, in those of the rehearsals
};

/// Features y of a machine with the difference x are y0 + M x + e. Rehearsals give y0, M and the covariance of e by least
/// squares; x follows by weighted least squares.
class Estimator {
public:
    /// @param differences One of each rehearsal.
    /// @param features    The same in rows; more of them than values that are believed.
    Estimator(const std::vector<Difference> &differences, const Eigen::MatrixXd &features);

    Estimate of(const Eigen::VectorXd &features) const; // EQ-VERIFY-4

private:
    void weigh(const Eigen::MatrixXd &rest);

    Eigen::VectorXd mean_;        ///< y0
    Eigen::VectorXd deviation_;   ///< of e, each
    Eigen::MatrixXd sensitivity_; ///< M in deviations
    Eigen::MatrixXd inverse_;     ///< from y - y0 in deviations to x
};

} // namespace sdre
