// SPDX-License-Identifier: MIT
#include "linalg/care.hpp"

#include <optional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/care_doubling.hpp"
#include "linalg/care_schur.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre {

namespace {

using extended::ControlWeight;
using extended::Scalar;

void require_valid(const Eigen::MatrixXd &A, Eigen::Index weight_rows, const Eigen::MatrixXd &Q)
{
    require_square(A, "A");
    require_shape(Q, A.rows(), A.cols(), "Q");
    require_finite(A, "A");
    require_finite(Q, "Q");
    require_symmetric(Q, "Q");
    if (weight_rows != A.rows()) {
        throw InputError(
            fmt::format("B has {} rows, A has {}: must be equal", weight_rows, A.rows()));
    }
}

/// Calls the thorough solver when the quick one is not allowed or has no answer. The thorough
/// solver names the reason when there is no solution.
template <class Weight>
CareSolution solved(const DoublingProblem &p, const Weight &weight, const CareOptions &options)
{
    const std::string           defect = semidefinite_defect(p.Q, "Q");
    std::optional<CareSolution> solution;
    if (options.precision == Precision::quick) {
        solution = solve_care_by_doubling(p);
    }
    if (!solution) {
        try {
            solution = extended::solve_care_by_schur({p.A.cast<Scalar>(), weight(),
                                                      extended::symmetric_part(p.Q.cast<Scalar>())})
                           .solution;
        } catch (const DesignError &error) {
            throw DesignError(defect.empty() ? error.what() : defect + "; " + error.what());
        }
    }
    if (!defect.empty()) { // a semidefinite Q leaves X no choice
        solution->semidefinite = semidefinite_defect(solution->X, "X").empty();
        if (!solution->semidefinite && !options.allow_indefinite) {
            throw DesignError(defect + ", and neither is the stabilising solution");
        }
    }
    return *solution;
}

} // namespace

CareSolution solve_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &G,
                        const Eigen::MatrixXd &Q, const CareOptions &options)
{
    require_square(A, "A");
    require_shape(G, A.rows(), A.cols(), "G");
    require_finite(G, "G");
    require_symmetric(G, "G");
    require_positive_semidefinite(G, "G");
    require_valid(A, G.rows(), Q);
    return solved(
        {A, G, Q},
        [&] {
            return ControlWeight{extended::symmetric_part(G.cast<Scalar>()), {}};
        },
        options);
}

CareSolution solve_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B,
                        const Eigen::MatrixXd &R, const Eigen::MatrixXd &Q,
                        const CareOptions &options)
{
    const ControlWeight weight = extended::control_weight(B, R);
    require_valid(A, B.rows(), Q);
    const Eigen::MatrixXd G = weight.G.cast<double>();
    return solved(
        {A, G, Q, &weight.F}, [&] { return weight; }, options);
}

} // namespace sdre
