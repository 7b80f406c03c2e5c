// SPDX-License-Identifier: MIT
#include "design/sdre_series.hpp"
#include "json.hpp"

#include <cmath>
#include <random>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "common/errors.hpp"

namespace {

using Eigen::MatrixXd;
using support::Json;

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, std::mt19937 &generator)
{
    std::normal_distribution<double> normal;
    return MatrixXd::NullaryExpr(rows, cols, [&] { return normal(generator); });
}

sdre::SdreProblem random_problem(Eigen::Index n, std::size_t variables, unsigned seed)
{
    std::mt19937      generator(seed);
    sdre::SdreProblem problem;
    problem.A0 = random_matrix(n, n, generator);
    for (std::size_t k = 0; k < variables; ++k) {
        problem.dA.push_back(0.5 * random_matrix(n, n, generator));
    }
    const MatrixXd B = random_matrix(n, 2, generator);
    problem.G        = B * B.transpose();
    problem.Q        = MatrixXd::Identity(n, n);
    return problem;
}

MatrixXd matrix_from(const Json &rows)
{
    MatrixXd M(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows[0].size()));
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
        for (Eigen::Index j = 0; j < M.cols(); ++j) {
            M(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].number();
        }
    }
    return M;
}

MatrixXd diagonal_from(const Json &values, bool inverted)
{
    MatrixXd M = MatrixXd::Zero(static_cast<Eigen::Index>(values.size()),
                                static_cast<Eigen::Index>(values.size()));
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
        const double value = values[static_cast<std::size_t>(i)].number();
        M(i, i)            = inverted ? 1.0 / value : value;
    }
    return M;
}

/// The drive's error dynamics from the reduced parameters l1..l11 of the data set.
struct DriveModel {
    explicit DriveModel(const Json &l_values)
    {
        const auto l = [&](std::size_t i) { return l_values[i - 1].number(); };
        A0 << -l(2), l(1), 0, -l(5), -l(4), 0, 0, 0, -l(7);
        dA(0, 2)          = l(11);
        dA_observer       = dA;
        dA_observer(2, 0) = l(9);
        B(1, 0)           = l(6);
        B(2, 1)           = l(8);
    }

    MatrixXd A0{3, 3};
    MatrixXd dA = MatrixXd::Zero(3, 3);
    MatrixXd dA_observer;
    MatrixXd B = MatrixXd::Zero(3, 2);
};

/// 0 where both are zero: without saliency the drive's higher terms vanish.
double relative_error(const MatrixXd &M, const MatrixXd &expected)
{
    const double error = (M - expected).norm();
    return error > 0.0 ? error / expected.norm() : 0.0;
}

/// Worst difference measured: 3e-13 at degree 0, 7e-12 above.
double tolerance(int degree)
{
    return degree == 0 ? 1e-11 : 1e-10;
}

Json gains_data()
{
    return Json::read(std::string(SDRE_TEST_DATA_DIR) + "/gains_public.json");
}

TEST(sdre_series_drives, controller_gains_match_the_independent_solution)
{
    const Json data = gains_data();
    ASSERT_EQ(data.size(), 4U);
    for (const auto &[id, drive] : data.items()) {
        SCOPED_TRACE(id);
        const DriveModel        model(drive["l"]);
        const MatrixXd          T_inv = diagonal_from(drive["weights"]["t"], true);
        const sdre::SdreProblem problem{model.A0,
                                        {model.dA},
                                        model.B * T_inv * model.B.transpose(),
                                        diagonal_from(drive["weights"]["q"], false)};

        const sdre::SdreSeries series = sdre::solve_sdre_series(problem, 3);

        ASSERT_EQ(series.terms.size(), 4U);
        for (std::size_t n = 0; n < 4; ++n) {
            const MatrixXd &X     = series.terms[n].X;
            const double    bound = tolerance(static_cast<int>(n));
            EXPECT_LE(relative_error(X, matrix_from(drive["gamma"][n])), bound) << n;
            EXPECT_LE(
                relative_error(T_inv * model.B.transpose() * X, matrix_from(drive["lambda_"][n])),
                bound)
                << n;
            EXPECT_LE(series.terms[n].relative_residual, 1e-14) << n;
        }
    }
}

TEST(sdre_series_drives, observer_gains_match_the_independent_solution)
{
    const Json data = gains_data();
    for (const auto &[id, drive] : data.items()) {
        SCOPED_TRACE(id);
        const DriveModel model(drive["l"]);
        const MatrixXd   T_inv = diagonal_from(drive["weights"]["td"], true);
        MatrixXd         A     = MatrixXd::Zero(6, 6);
        A.bottomLeftCorner(3, 3).setIdentity();
        A.bottomRightCorner(3, 3)  = model.A0;
        MatrixXd dA                = MatrixXd::Zero(6, 6);
        dA.bottomRightCorner(3, 3) = model.dA_observer;
        MatrixXd C                 = MatrixXd::Zero(6, 6);
        C.bottomRightCorner(3, 3).setIdentity();
        const sdre::SdreProblem dual{A.transpose(),
                                     {dA.transpose()},
                                     C.transpose() * T_inv * C,
                                     diagonal_from(drive["weights"]["qd"], false)};

        const sdre::SdreSeries series = sdre::solve_sdre_series(dual, 3);

        ASSERT_EQ(series.terms.size(), 4U);
        for (std::size_t n = 0; n < 4; ++n) {
            const MatrixXd &X     = series.terms[n].X;
            const double    bound = tolerance(static_cast<int>(n));
            EXPECT_LE(relative_error(X, matrix_from(drive["pi"][n])), bound) << n;
            EXPECT_LE(relative_error(X * C.transpose() * T_inv, matrix_from(drive["L"][n])), bound)
                << n;
            EXPECT_LE(series.terms[n].relative_residual, 1e-14) << n;
        }
    }
}

TEST(sdre_series, scalar_series_has_the_textbook_coefficients)
{
    // x(s) = (a + s) + sqrt((a + s)^2 + 1) = a + s + r + (a/r) s + s^2/(2 r^3) - a s^3/(2 r^5) +
    // ...
    const double   a   = 0.75;
    const double   r   = 1.25;
    const MatrixXd one = MatrixXd::Constant(1, 1, 1.0);

    const sdre::SdreSeries series = sdre::solve_sdre_series({a * one, {one}, one, one}, 3);

    EXPECT_NEAR(series.terms[0].X(0, 0), a + r, 1e-15);
    EXPECT_NEAR(series.terms[1].X(0, 0), 1 + a / r, 1e-15);
    EXPECT_NEAR(series.terms[2].X(0, 0), 0.5 / std::pow(r, 3), 1e-15);
    EXPECT_NEAR(series.terms[3].X(0, 0), -0.5 * a / std::pow(r, 5), 1e-15);
}

TEST(sdre_series, truncation_error_falls_with_the_power_behind_the_order)
{
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const sdre::SdreProblem problem = random_problem(4, 1, seed);
        const sdre::SdreSeries  series  = sdre::solve_sdre_series(problem, 5);
        for (int order = 0; order <= 5; ++order) {
            const auto error = [&](double s) {
                return (series.evaluate({s}, order) - sdre::solve_sdre_exact(problem, {s}).X)
                    .norm();
            };
            const double slope = std::log2(error(0.02) / error(0.01));
            EXPECT_NEAR(slope, order + 1, 0.25) << "seed " << seed;
        }
    }
}

TEST(sdre_series, two_variables_shrink_along_every_direction)
{
    const sdre::SdreProblem problem = random_problem(3, 2, 42);
    const sdre::SdreSeries  series  = sdre::solve_sdre_series(problem, 3);
    for (const double angle : {0.0, 0.7, 1.5, 2.9, 4.0, 5.5}) {
        for (int order = 0; order <= 3; ++order) {
            const auto error = [&](double radius) {
                const std::vector<double> s{radius * std::cos(angle), radius * std::sin(angle)};
                return (series.evaluate(s, order) - sdre::solve_sdre_exact(problem, s).X).norm();
            };
            EXPECT_NEAR(std::log2(error(0.01) / error(0.005)), order + 1, 0.25) << angle;
        }
    }
}

TEST(sdre_series, mixed_term_matches_finite_differences)
{
    const sdre::SdreProblem problem = random_problem(3, 2, 4);
    const sdre::SdreSeries  series  = sdre::solve_sdre_series(problem, 2);
    const auto              exact   = [&](double a, double b) {
        return sdre::solve_sdre_exact(problem, {a, b}).X;
    };
    const double h = 1e-3;

    const MatrixXd mixed =
        (exact(h, h) - exact(h, -h) - exact(-h, h) + exact(-h, -h)) / (4 * h * h);
    const MatrixXd second = (exact(0, h) - 2 * exact(0, 0) + exact(0, -h)) / (2 * h * h);

    ASSERT_EQ(series.terms[4].powers, (std::vector<int>{1, 1}));
    EXPECT_LE(relative_error(series.terms[4].X, mixed), 1e-4);
    ASSERT_EQ(series.terms[5].powers, (std::vector<int>{0, 2}));
    EXPECT_LE(relative_error(series.terms[5].X, second), 1e-4);
}

TEST(sdre_series, equal_directions_collapse_to_one_variable)
{
    // With dA_1 = dA_2 the two-variable series is the one-variable series of s_1 + s_2.
    sdre::SdreProblem      two = random_problem(3, 1, 77);
    const sdre::SdreSeries one = sdre::solve_sdre_series(two, 4);
    two.dA.push_back(two.dA[0]);
    const sdre::SdreSeries series = sdre::solve_sdre_series(two, 4);
    EXPECT_LE(relative_error(series.evaluate({0.03, 0.05}), one.evaluate({0.08})), 1e-14);
}

TEST(sdre_series, terms_come_in_the_documented_order)
{
    const sdre::SdreSeries series = sdre::solve_sdre_series(random_problem(2, 3, 5), 2);
    const std::vector<std::vector<int>> expected{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                                 {2, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 2, 0},
                                                 {0, 1, 1}, {0, 0, 2}};
    ASSERT_EQ(series.terms.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(series.terms[i].powers, expected[i]) << i;
        EXPECT_EQ(series.terms[i].X, series.terms[i].X.transpose()) << i;
        EXPECT_LE(series.terms[i].relative_residual, 1e-14) << i;
    }
    EXPECT_EQ(series.terms[0].X, series.care.X);
}

TEST(sdre_series, reported_residual_is_that_of_the_equation)
{
    const sdre::SdreProblem problem = random_problem(4, 1, 6);
    const sdre::SdreSeries  series  = sdre::solve_sdre_series(problem, 2);
    const MatrixXd         &X0      = series.terms[0].X;
    const MatrixXd         &X1      = series.terms[1].X;
    const MatrixXd         &X2      = series.terms[2].X;
    const MatrixXd          Acl     = problem.A0 - problem.G * X0;
    const MatrixXd          XA      = X2 * Acl + X1 * problem.dA[0];

    EXPECT_LE((XA + XA.transpose() - X1 * problem.G * X1).norm(), 1e-12 * XA.norm());
    EXPECT_LE(series.terms[2].relative_residual, 1e-15);
}

TEST(sdre_series, variable_that_changes_nothing_has_zero_terms)
{
    sdre::SdreProblem problem = random_problem(3, 1, 9);
    problem.dA[0].setZero();
    const sdre::SdreSeries series = sdre::solve_sdre_series(problem, 2);
    EXPECT_EQ(series.terms[1].X.norm(), 0.0);
    EXPECT_EQ(series.terms[2].X.norm(), 0.0);
    EXPECT_EQ(series.terms[2].relative_residual, 0.0);
}

TEST(sdre_series, without_variables_it_is_the_riccati_solution)
{
    const sdre::SdreProblem problem = random_problem(3, 0, 10);
    const sdre::SdreSeries  series  = sdre::solve_sdre_series(problem, 3);
    ASSERT_EQ(series.terms.size(), 1U);
    EXPECT_EQ(series.evaluate({}), sdre::solve_care(problem.A0, problem.G, problem.Q).X);
}

TEST(sdre_series, evaluate_keeps_the_requested_degrees)
{
    const sdre::SdreSeries series = sdre::solve_sdre_series(random_problem(2, 2, 12), 2);
    EXPECT_EQ(series.evaluate({0.5, 0.25}, 0), series.terms[0].X);
    const MatrixXd linear = series.terms[0].X + 0.5 * series.terms[1].X + 0.25 * series.terms[2].X;
    EXPECT_LE(relative_error(series.evaluate({0.5, 0.25}, 1), linear), 1e-15);
    const MatrixXd full =
        linear + 0.25 * series.terms[3].X + 0.125 * series.terms[4].X + 0.0625 * series.terms[5].X;
    EXPECT_LE(relative_error(series.evaluate({0.5, 0.25}), full), 1e-15);
    EXPECT_EQ(series.evaluate({0.5, 0.25}, 7), series.evaluate({0.5, 0.25}));
}

TEST(sdre_series, state_matrix_adds_every_direction)
{
    const sdre::SdreProblem problem  = random_problem(3, 2, 14);
    const MatrixXd          expected = problem.A0 + 2.0 * problem.dA[0] - 3.0 * problem.dA[1];
    EXPECT_LE(relative_error(sdre::state_matrix(problem, {2.0, -3.0}), expected), 1e-15);
}

TEST(sdre_series_refuses, wrong_input)
{
    const sdre::SdreProblem good = random_problem(3, 2, 15);
    EXPECT_THROW(sdre::solve_sdre_series(good, -1), sdre::InputError);
    EXPECT_THROW(sdre::state_matrix(good, {1.0}), sdre::InputError);
    EXPECT_THROW(sdre::solve_sdre_exact(good, {1.0, 2.0, 3.0}), sdre::InputError);
    EXPECT_THROW((void)sdre::solve_sdre_series(good, 1).evaluate({1.0}), sdre::InputError);
    sdre::SdreProblem bad = good;
    bad.dA[1]             = MatrixXd::Zero(2, 2);
    EXPECT_THROW(sdre::solve_sdre_series(bad, 1), sdre::InputError);
    bad             = good;
    bad.dA[0](1, 1) = std::nan("");
    EXPECT_THROW(sdre::solve_sdre_series(bad, 1), sdre::InputError);
    bad   = good;
    bad.G = MatrixXd::Identity(2, 2);
    EXPECT_THROW(sdre::solve_sdre_series(bad, 1), sdre::InputError);
    bad = good;
    bad.G.setZero();
    bad.A0.setIdentity();
    EXPECT_THROW(sdre::solve_sdre_series(bad, 1), sdre::DesignError);
    bad = good;
    bad.dA[0] *= 1e300;
    EXPECT_THROW(sdre::solve_sdre_series(bad, 2), sdre::DesignError);
}

} // namespace
