// SPDX-License-Identifier: MIT
#include "design/sdre_series.hpp"

#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/extended.hpp"
#include "linalg/linalg_checks.hpp"
#include "linalg/lyapunov.hpp"

namespace sdre {

namespace {

using extended::Matrix;
using extended::Scalar;
using Powers = std::vector<int>;
using Terms  = std::map<Powers, Matrix>;

int degree(const Powers &alpha)
{
    return std::accumulate(alpha.begin(), alpha.end(), 0);
}

/// Appends to `all` every multi-index that continues `head` with the total degree `rest`, the
/// earlier variables' powers descending.
void append_multi_indices(Powers &head, std::size_t variables, int rest, std::vector<Powers> &all)
{
    if (head.size() + 1 == variables) {
        head.push_back(rest);
        all.push_back(head);
        head.pop_back();
        return;
    }
    for (int power = rest; power >= 0; --power) {
        head.push_back(power);
        append_multi_indices(head, variables, rest - power, all);
        head.pop_back();
    }
}

std::vector<Powers> multi_indices(std::size_t variables, int n)
{
    std::vector<Powers> all;
    Powers              head;
    if (variables > 0) {
        append_multi_indices(head, variables, n, all);
    }
    return all;
}

/// alpha - beta, false when a power would be negative.
bool difference(const Powers &alpha, const Powers &beta, Powers &result)
{
    result.resize(alpha.size());
    for (std::size_t k = 0; k < alpha.size(); ++k) {
        result[k] = alpha[k] - beta[k];
        if (result[k] < 0) {
            return false;
        }
    }
    return true;
}

/// Contribution of the known terms to the equation of X_alpha, and the sum of the sizes of its
/// parts.
struct Forcing {
    Matrix W;
    Scalar size = 0;
};

/// W of EQ-SERIES-3:  X_a Acl + Acl' X_a + W = 0.
Forcing forcing(const SdreProblem &problem, const Terms &terms, const Powers &alpha)
{
    const Matrix G = problem.G.cast<Scalar>();
    Forcing      f{Matrix::Zero(G.rows(), G.cols()), 0};
    for (std::size_t k = 0; k < problem.dA.size(); ++k) {
        if (alpha[k] > 0) {
            Powers lower = alpha;
            --lower[k];
            const Matrix XdA = terms.at(lower).lazyProduct(problem.dA[k].cast<Scalar>());
            f.W += XdA + XdA.transpose();
            f.size += 2 * XdA.norm();
        }
    }
    Powers other;
    for (const auto &[beta, X] : terms) {
        if (degree(beta) > 0 && degree(beta) < degree(alpha) && difference(alpha, beta, other)) {
            const Matrix XGX = Matrix(X.lazyProduct(G)).lazyProduct(terms.at(other));
            f.W -= XGX;
            f.size += XGX.norm();
        }
    }
    f.W = extended::symmetric_part(f.W);
    return f;
}

Matrix rounded(const Matrix &X)
{
    return X.cast<double>().cast<Scalar>();
}

Matrix closed_loop_matrix(const SdreProblem &problem, const Matrix &X)
{
    return problem.A0.cast<Scalar>() - problem.G.cast<Scalar>().lazyProduct(X);
}

/// Rounding error of X in double, from the residual of EQ-CARE-1.
Matrix newton_step(const SdreProblem &problem, const Matrix &X, const Matrix &Acl)
{
    const Matrix XA = X.lazyProduct(problem.A0.cast<Scalar>());
    const Matrix R  = XA + XA.transpose() -
                     Matrix(X.lazyProduct(problem.G.cast<Scalar>())).lazyProduct(X) +
                     problem.Q.cast<Scalar>();
    return X + extended::LyapunovSolver(Acl).solve(extended::symmetric_part(R));
}

void require_valid(const SdreProblem &problem)
{
    require_square(problem.A0, "A0");
    require_finite(problem.A0, "A0");
    for (std::size_t k = 0; k < problem.dA.size(); ++k) {
        const std::string name = fmt::format("dA[{}]", k);
        require_shape(problem.dA[k], problem.A0.rows(), problem.A0.cols(), name);
        require_finite(problem.dA[k], name);
    }
    require_shape(problem.G, problem.A0.rows(), problem.A0.cols(), "G");
    require_shape(problem.Q, problem.A0.rows(), problem.A0.cols(), "Q");
}

void require_values(std::size_t given, std::size_t variables)
{
    if (given != variables) {
        throw InputError(fmt::format("s has {} values, must have one for each of the {} variables",
                                     given, variables));
    }
}

SeriesTerm make_term(const Powers &alpha, const Matrix &X)
{
    SeriesTerm term{alpha, X.cast<double>(), 0.0};
    if (!term.X.allFinite()) {
        throw DesignError("a term of the series exceeds the range of a double");
    }
    return term;
}

} // namespace

Eigen::MatrixXd SdreSeries::evaluate(const std::vector<double> &s, int max_degree) const
{
    Eigen::MatrixXd X = Eigen::MatrixXd::Zero(care.X.rows(), care.X.cols());
    for (const SeriesTerm &term : terms) {
        require_values(s.size(), term.powers.size());
        if (max_degree >= 0 && degree(term.powers) > max_degree) {
            continue;
        }
        double factor = 1.0;
        for (std::size_t k = 0; k < s.size(); ++k) {
            factor *= std::pow(s[k], term.powers[k]);
        }
        X += factor * term.X; // EQ-SERIES-2
    }
    return X;
}

Eigen::MatrixXd state_matrix(const SdreProblem &problem, const std::vector<double> &s)
{
    require_valid(problem);
    require_values(s.size(), problem.dA.size());
    Eigen::MatrixXd A = problem.A0;
    for (std::size_t k = 0; k < s.size(); ++k) {
        A += s[k] * problem.dA[k]; // EQ-SERIES-1
    }
    return A;
}

SdreSeries solve_sdre_series(const SdreProblem &problem, int order, Precision precision)
{
    if (order < 0) {
        throw InputError(fmt::format("order is {}, must be 0 or more", order));
    }
    require_valid(problem);

    SdreSeries   series;
    const Powers zero(problem.dA.size(), 0);
    series.care     = solve_care(problem.A0, problem.G, problem.Q, CareOptions{precision});
    const Matrix X0 = series.care.X.cast<Scalar>();
    series.terms.push_back(make_term(zero, X0));
    series.terms.back().relative_residual = series.care.relative_residual;

    // Two sets of terms: the exact ones feed the recursion, the rounded ones are what the caller
    // gets, so the reported residual is theirs.
    const Matrix                   Acl_rounded = closed_loop_matrix(problem, X0);
    const Matrix                   X0_exact    = newton_step(problem, X0, Acl_rounded);
    const extended::LyapunovSolver closed_loop(closed_loop_matrix(problem, X0_exact));
    Terms                          exact{{zero, X0_exact}};
    Terms                          delivered{{zero, X0}};
    for (int n = 1; n <= order; ++n) {
        for (const Powers &alpha : multi_indices(zero.size(), n)) {
            const Matrix X     = closed_loop.solve(forcing(problem, exact, alpha).W);
            SeriesTerm   term  = make_term(alpha, X);
            exact[alpha]       = X;
            delivered[alpha]   = rounded(X);
            const Matrix  XA   = delivered[alpha].lazyProduct(Acl_rounded);
            const Forcing f    = forcing(problem, delivered, alpha);
            const Scalar  size = 2 * XA.norm() + f.size;
            if (size > 0) {
                term.relative_residual =
                    static_cast<double>((XA + XA.transpose() + f.W).norm() / size);
            }
            series.terms.push_back(term);
        }
    }
    return series;
}

CareSolution solve_sdre_exact(const SdreProblem &problem, const std::vector<double> &s)
{
    return solve_care(state_matrix(problem, s), problem.G, problem.Q);
}

} // namespace sdre
