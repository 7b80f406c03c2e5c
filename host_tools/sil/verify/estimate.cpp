// SPDX-License-Identifier: MIT
#include "sil/verify/estimate.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

// Chosen: errors that many features share, of which there are as many. With 10 to 60 the default drive's estimates are
// equally good; without any the dead time's is twice as uncertain.
constexpr Eigen::Index shared_errors = 20;
// Chosen: the shared errors leave at least this of a feature's variance, because the rehearsals are few.
constexpr double least_own = 0.05;
// Chosen: nothing is known of a machine beyond that it is within four uncertainties. It decides only where the
// records show nothing.
constexpr double believed_variance = 16.0;
// Keeps a feature that is the same in all rehearsals from a division by zero.
constexpr double least_variance = 1e-12;

Eigen::MatrixXd regressors(const std::vector<Difference> &differences)
{
    Eigen::MatrixXd x(differences.size(), believed_count + 1);
    for (Eigen::Index row = 0; row < x.rows(); row++) {
        x(row, 0) = 1.0;
        for (Eigen::Index k = 1; k < x.cols(); k++) {
            x(row, k) = differences[static_cast<std::size_t>(row)][static_cast<std::size_t>(k - 1)];
        }
    }
    return x;
}

} // namespace

Estimator::Estimator(const std::vector<Difference> &differences, const Eigen::MatrixXd &features)
{
    const Eigen::MatrixXd x    = regressors(differences);
    const Eigen::MatrixXd fit  = x.colPivHouseholderQr().solve(features); // EQ-VERIFY-3
    const Eigen::MatrixXd rest = features - x * fit;
    const double          free = static_cast<double>(x.rows() - x.cols());
    mean_                      = fit.row(0).transpose();
    deviation_ = (rest.array().square().colwise().sum() / free + least_variance).sqrt().transpose();
    sensitivity_ = fit.bottomRows(fit.rows() - 1).transpose();
    sensitivity_ = deviation_.cwiseInverse().asDiagonal() * sensitivity_;
    weigh(rest * deviation_.cwiseInverse().asDiagonal());
}

/// The covariance of e in deviations: the strongest principal components, and the same rest for each feature. They come from
/// the products of the rehearsals, which are fewer than the features.
void Estimator::weigh(const Eigen::MatrixXd &rest)
{
    const Eigen::Index n = std::min({shared_errors, rest.rows(), rest.cols()});
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> products(rest * rest.transpose());
    const Eigen::VectorXd strength = products.eigenvalues().tail(n).cwiseMax(least_variance);
    const Eigen::MatrixXd shared   = rest.transpose() * products.eigenvectors().rightCols(n) *
                                   strength.cwiseSqrt().cwiseInverse().asDiagonal();
    const Eigen::VectorXd variance = strength / static_cast<double>(rest.rows());
    const double own = std::max(1.0 - variance.sum() / static_cast<double>(rest.cols()), least_own);
    const Eigen::VectorXd less = (variance.array() / (own * (own + variance.array()))).matrix();
    const Eigen::MatrixXd weighted =
        sensitivity_ / own - shared * (less.asDiagonal() * (shared.transpose() * sensitivity_));
    const Eigen::MatrixXd believed =
        Eigen::MatrixXd::Identity(believed_count, believed_count) / believed_variance;
    inverse_ = (sensitivity_.transpose() * weighted + believed).ldlt().solve(weighted.transpose());
}

Estimate Estimator::of(const Eigen::VectorXd &features) const
{
    const Eigen::VectorXd y = (features - mean_).cwiseQuotient(deviation_);
    const Eigen::VectorXd x = inverse_ * y;
    Estimate              e;
    std::copy(x.begin(), x.end(), e.difference.begin());
    e.misfit = std::log((y - sensitivity_ * x).squaredNorm() / static_cast<double>(y.size()));
    return e;
}

} // namespace sdre
