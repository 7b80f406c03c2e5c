// SPDX-License-Identifier: MIT
#include "linalg/lyapunov.hpp"

#include <cmath>
#include <random>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "linalg/eigenvalues.hpp"
#include "linear.hpp"

namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, std::mt19937 &generator)
{
    std::normal_distribution<double> normal;
    return MatrixXd::NullaryExpr(rows, cols, [&] { return normal(generator); });
}

/// Moves the spectrum left until the slowest mode is at -margin.
MatrixXd random_hurwitz(Eigen::Index n, double margin, std::mt19937 &generator)
{
    const MatrixXd M       = random_matrix(n, n, generator);
    const double   slowest = sdre::eigenvalues(M).real().maxCoeff();
    return M - (slowest + margin) * MatrixXd::Identity(n, n);
}

/// The n^2 linear equations of EQ-LYAP-1, solved without any structure.
MatrixXd oracle(const MatrixXd &A, const MatrixXd &W)
{
    const Eigen::Index n = A.rows();
    MatrixXd           K = MatrixXd::Zero(n * n, n * n);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            for (Eigen::Index k = 0; k < n; ++k) {
                K(i + n * j, k + n * j) += A(k, i); // (A'X)_ij
                K(i + n * j, i + n * k) += A(k, j); // (XA)_ij
            }
        }
    }
    const Eigen::VectorXd x = support::solve(K, -W.reshaped());
    return x.reshaped(n, n);
}

std::string design_error(const MatrixXd &A)
{
    try {
        (void)sdre::solve_lyapunov(A, MatrixXd::Identity(A.rows(), A.cols()));
    } catch (const sdre::DesignError &error) {
        return error.what();
    }
    return "<nothing thrown>";
}

TEST(lyapunov, scalar_equation_has_the_textbook_solution)
{
    const sdre::LyapunovSolution solution =
        sdre::solve_lyapunov(MatrixXd::Constant(1, 1, -4.0), MatrixXd::Constant(1, 1, 2.0));

    EXPECT_DOUBLE_EQ(solution.X(0, 0), 0.25);
    EXPECT_LE(solution.relative_residual, 1e-16);
}

TEST(lyapunov, second_order_system_has_the_textbook_solution)
{
    // x'' + 2 x' + 3 x = 0 with weight 1 on both states.
    Matrix2d A, X;
    A << 0, 1, -3, -2;
    X << 4.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 3.0;

    EXPECT_LE((sdre::solve_lyapunov(A, Matrix2d::Identity()).X - X).norm(), 1e-15);
}

TEST(lyapunov, random_problems_match_the_unstructured_solution)
{
    std::mt19937 generator(3);
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        const Eigen::Index n = 1 + trial % 7;
        const MatrixXd     A = random_hurwitz(n, 0.3, generator) * std::pow(10.0, trial % 7 - 3);
        const MatrixXd     N = random_matrix(n, n, generator);
        const MatrixXd     W = N + N.transpose();

        const sdre::LyapunovSolution solution = sdre::solve_lyapunov(A, W);

        const MatrixXd expected = oracle(A, W);
        EXPECT_LE((solution.X - expected).norm(), 1e-11 * expected.norm());
        EXPECT_EQ(solution.X, solution.X.transpose());
        EXPECT_LE(solution.relative_residual, 1e-15);
    }
}

TEST(lyapunov, positive_weight_gives_a_positive_solution)
{
    std::mt19937 generator(5);
    for (int trial = 0; trial < 20; ++trial) {
        const MatrixXd A = random_hurwitz(6, 0.1, generator);
        const MatrixXd X = sdre::solve_lyapunov(A, MatrixXd::Identity(6, 6)).X;
        EXPECT_GT(support::least_eigenvalue(X), 0.0);
    }
}

TEST(lyapunov, solution_is_linear_in_the_weight)
{
    std::mt19937   generator(8);
    const MatrixXd A     = random_hurwitz(5, 0.5, generator);
    const MatrixXd N     = random_matrix(5, 5, generator);
    const MatrixXd W     = N + N.transpose();
    const MatrixXd I     = MatrixXd::Identity(5, 5);
    const MatrixXd sum   = sdre::solve_lyapunov(A, 2.0 * W - 3.0 * I).X;
    const MatrixXd parts = 2.0 * sdre::solve_lyapunov(A, W).X - 3.0 * sdre::solve_lyapunov(A, I).X;
    EXPECT_LE((sum - parts).norm(), 1e-14 * parts.norm());
}

TEST(lyapunov, sixty_states_are_solved_to_rounding)
{
    std::mt19937   generator(9);
    const MatrixXd A = random_hurwitz(60, 0.01, generator);
    EXPECT_LE(sdre::solve_lyapunov(A, MatrixXd::Identity(60, 60)).relative_residual, 1e-15);
}

TEST(lyapunov, zero_weight_gives_exactly_zero)
{
    const sdre::LyapunovSolution solution =
        sdre::solve_lyapunov(-Matrix2d::Identity(), Matrix2d::Zero());

    EXPECT_EQ(solution.X, Matrix2d::Zero());
    EXPECT_EQ(solution.relative_residual, 0.0);
}

TEST(lyapunov, slow_but_stable_mode_is_accepted)
{
    const MatrixXd A = Eigen::Vector2d(-1e-13, -1e6).asDiagonal();
    const MatrixXd X = sdre::solve_lyapunov(A, Matrix2d::Identity()).X;
    EXPECT_DOUBLE_EQ(X(0, 0), 0.5e13);
    EXPECT_DOUBLE_EQ(X(1, 1), 0.5e-6);
}

TEST(lyapunov_refuses, matrices_that_are_not_hurwitz)
{
    Matrix2d A;
    A << -1, 0, 0, 2;
    EXPECT_EQ(design_error(A), "A is not Hurwitz: eigenvalue at s = 2");
    A << 0, 1, 0, 0;
    EXPECT_EQ(design_error(A), "A is not Hurwitz: eigenvalue at s = 0");
    A << 0, 1, -1, 0;
    EXPECT_NE(design_error(A).find("A is not Hurwitz: eigenvalue at s = 0 "), std::string::npos);
    EXPECT_NE(design_error(MatrixXd::Zero(3, 3)).find("A is not Hurwitz"), std::string::npos);
}

TEST(lyapunov_refuses, a_double_integrator_in_other_coordinates)
{
    // Rounding moves the double eigenvalue 0 by 1e-8, as often into the left half plane as into the
    // right.
    std::mt19937 generator(10);
    for (int trial = 0; trial < 40; ++trial) {
        MatrixXd A       = MatrixXd::Zero(3, 3);
        A(0, 1)          = 1.0;
        A(2, 2)          = -1.0;
        const MatrixXd T = random_matrix(3, 3, generator) + 4.0 * MatrixXd::Identity(3, 3);
        EXPECT_NE(design_error(T * A * support::inverse(T)).find("A is not Hurwitz"),
                  std::string::npos);
    }
}

TEST(lyapunov_refuses, wrong_shapes_and_entries)
{
    const MatrixXd I = MatrixXd::Identity(2, 2);
    Matrix2d       unsymmetric;
    unsymmetric << 1, 1, 0, 1;
    EXPECT_THROW(sdre::solve_lyapunov(MatrixXd(), MatrixXd()), sdre::InputError);
    EXPECT_THROW(sdre::solve_lyapunov(MatrixXd::Ones(2, 3), I), sdre::InputError);
    EXPECT_THROW(sdre::solve_lyapunov(-I, MatrixXd::Identity(3, 3)), sdre::InputError);
    EXPECT_THROW(sdre::solve_lyapunov(-I, unsymmetric), sdre::InputError);
    EXPECT_THROW(sdre::solve_lyapunov(-I, I * HUGE_VAL), sdre::InputError);
    EXPECT_THROW(sdre::solve_lyapunov(I * std::nan(""), I), sdre::InputError);
}

TEST(lyapunov_refuses, a_solution_beyond_the_range_of_a_double)
{
    EXPECT_THROW(sdre::solve_lyapunov(-1e-200 * Matrix2d::Identity(), 1e200 * Matrix2d::Identity()),
                 sdre::DesignError);
}

} // namespace
