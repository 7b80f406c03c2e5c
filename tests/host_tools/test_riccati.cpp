// SPDX-License-Identifier: MIT
#include "linalg/care.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "json.hpp"
#include "linalg/eigenvalues.hpp"
#include "linear.hpp"

namespace {

using Eigen::MatrixXd;
using Extended = support::LongMatrix;
using support::Json;

MatrixXd scalar(double value)
{
    return MatrixXd::Constant(1, 1, value);
}

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, std::mt19937 &generator)
{
    std::normal_distribution<double> normal;
    return MatrixXd::NullaryExpr(rows, cols, [&] { return normal(generator); });
}

MatrixXd random_semidefinite(Eigen::Index n, Eigen::Index rank, std::mt19937 &generator)
{
    const MatrixXd F = random_matrix(n, rank, generator);
    return F * F.transpose();
}

/// Result of a call: "solved", or the kind of error and its message.
template <class Call> std::string outcome(Call call)
{
    try {
        call();
    } catch (const sdre::DesignError &error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return std::string("design error: ") + error.what();
    } catch (const sdre::InputError &error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return std::string("input error: ") + error.what();
    }
    return "solved";
}

// Plain functions, not one lambda per expectation: that many matrix temporaries in one test body
// cost minutes and gigabytes to compile under the sanitizers.
std::string care(const MatrixXd &A, const MatrixXd &G, const MatrixXd &Q)
{
    return outcome([&] { (void)sdre::solve_care(A, G, Q); });
}

std::string care(const MatrixXd &A, const MatrixXd &B, const MatrixXd &R, const MatrixXd &Q)
{
    return outcome([&] { (void)sdre::solve_care(A, B, R, Q); });
}

std::string weight(const MatrixXd &B, const MatrixXd &R)
{
    return outcome([&] { (void)sdre::control_weight(B, R); });
}

void expect_design_error(const std::string &outcome, const std::string &message)
{
    EXPECT_EQ(outcome.rfind("design error: ", 0), 0U) << outcome;
    EXPECT_NE(outcome.find(message), std::string::npos) << outcome;
}

void expect_input_error(const std::string &outcome)
{
    EXPECT_EQ(outcome.rfind("input error: ", 0), 0U) << outcome;
}

MatrixXd matrix2(double a, double b, double c, double d)
{
    MatrixXd M(2, 2);
    M << a, b, c, d;
    return M;
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

/// EQ-CARE-2 with G never formed; independent of the solver's own figure.
double residual_of(const Json &problem, const MatrixXd &X)
{
    const Extended A = matrix_from(problem["A"]).cast<long double>();
    const Extended Q = matrix_from(problem["Q"]).cast<long double>();
    const Extended R = matrix_from(problem["R"]).cast<long double>();
    const Extended BX =
        matrix_from(problem["B"]).transpose().cast<long double>() * X.cast<long double>();
    const Extended AX  = A.transpose() * X.cast<long double>();
    const Extended XGX = BX.transpose() * support::solve(R, BX);
    return static_cast<double>((AX + AX.transpose() - XGX + Q).norm() /
                               (2 * AX.norm() + XGX.norm() + Q.norm()));
}

Json read_json(const std::string &name)
{
    return Json::read(std::string(SDRE_TEST_DATA_DIR) + "/carex/" + name + ".json");
}

double best_of(const Json &peers, const char *figure)
{
    double best = HUGE_VAL;
    for (const auto &[name, peer] : peers.items()) {
        best = std::min(best, peer[figure].number());
    }
    return best;
}

/// Properties of every accepted solution.
void expect_stabilising(const MatrixXd &A, const MatrixXd &G, const MatrixXd &Q,
                        const sdre::CareSolution &solution, double residual_bound)
{
    const MatrixXd &X = solution.X;
    EXPECT_EQ(X, X.transpose());
    const Extended Xe  = X.cast<long double>();
    const Extended AX  = A.transpose().cast<long double>() * Xe;
    const Extended XGX = Xe * G.cast<long double>() * Xe;
    const Extended sum = AX + AX.transpose() - XGX + Q.cast<long double>();
    EXPECT_LE(static_cast<double>(sum.norm() / (2 * AX.norm() + XGX.norm() + Q.norm())),
              residual_bound);
    EXPECT_LE(solution.relative_residual, residual_bound);
    EXPECT_GE(support::least_eigenvalue(X), -1e-12 * X.norm());
    const Eigen::VectorXcd modes = sdre::eigenvalues(A - G * X);
    EXPECT_LT(modes.real().maxCoeff(), 0.0);
    ASSERT_EQ(solution.closed_loop_eigenvalues.size(), A.rows());
    for (Eigen::Index i = 0; i < modes.size(); ++i) {
        const auto distance = (solution.closed_loop_eigenvalues.array() - modes(i)).abs();
        EXPECT_LE(distance.minCoeff(), 1e-8 * (A - G * X).norm());
    }
}

TEST(riccati_benchmark, every_case_is_as_good_as_the_better_established_solver)
{
    // Measured on x86: at worst 7e-3 of the residual bound and 4e-4 of the error bound.
    constexpr double factor = 3.0;
    constexpr double floor  = 1e-13;
    const Json       peers  = read_json("peers");
    ASSERT_EQ(peers.size(), 29U);
    for (const auto &[id, peer] : peers.items()) {
        SCOPED_TRACE(id);
        const Json     problem = read_json(id);
        const MatrixXd X_ref   = matrix_from(problem["X_ref"]);

        const sdre::CareSolution solution =
            sdre::solve_care(matrix_from(problem["A"]), matrix_from(problem["B"]),
                             matrix_from(problem["R"]), matrix_from(problem["Q"]));

        const double error    = (solution.X - X_ref).norm() / X_ref.norm();
        const double residual = residual_of(problem, solution.X);
        EXPECT_LE(error, std::max(floor, factor * best_of(peer, "err")));
        EXPECT_LE(residual, std::max(floor, factor * best_of(peer, "res_rel")));
        EXPECT_LE(solution.relative_residual, std::max(floor, factor * best_of(peer, "res_rel")));
        EXPECT_LT(solution.closed_loop_eigenvalues.real().maxCoeff(), 0.0);
    }
}

TEST(riccati_benchmark, the_rounded_weight_loses_no_more_than_its_rounding)
{
    const Json peers = read_json("peers");
    for (const auto &[id, peer] : peers.items()) {
        SCOPED_TRACE(id);
        const Json     problem = read_json(id);
        const MatrixXd X_ref   = matrix_from(problem["X_ref"]);
        const MatrixXd G =
            sdre::control_weight(matrix_from(problem["B"]), matrix_from(problem["R"]));

        const sdre::CareSolution solution =
            sdre::solve_care(matrix_from(problem["A"]), G, matrix_from(problem["Q"]));

        // Case 2.2 has a nearly singular R: its G carries only eight digits, whoever computes it.
        const double floor = id == "carex-2.2-eps1e-8" ? 1e-7 : 1e-13;
        const double error = (solution.X - X_ref).norm() / X_ref.norm();
        EXPECT_LE(error, std::max(floor, 3.0 * best_of(peer, "err")));
        EXPECT_LE(solution.relative_residual, std::max(1e-13, 3.0 * best_of(peer, "res_rel")));
    }
}

TEST(riccati, scalar_equation_has_the_textbook_root)
{
    for (const double a : {-3.0, -1e-3, 0.0, 1e-3, 2.0, 1e6}) {
        for (const double g : {1e-6, 1.0, 1e6}) {
            for (const double q : {1e-6, 1.0, 1e6}) {
                const sdre::CareSolution solution =
                    sdre::solve_care(scalar(a), scalar(g), scalar(q));

                const long double root =
                    std::sqrt(static_cast<long double>(a) * a + static_cast<long double>(g) * q);
                // The form without cancellation for the sign of a.
                const long double x = a > 0 ? (a + root) / g : q / (root - a);
                EXPECT_NEAR(solution.X(0, 0), static_cast<double>(x),
                            1e-15 * static_cast<double>(x));
                EXPECT_NEAR(solution.closed_loop_eigenvalues(0).real(), static_cast<double>(-root),
                            1e-15 * static_cast<double>(root));
            }
        }
    }
}

TEST(riccati, double_integrator_has_the_textbook_solution)
{
    const double r = std::sqrt(2.0);

    const sdre::CareSolution solution =
        sdre::solve_care(matrix2(0, 1, 0, 0), matrix2(0, 0, 0, 1), matrix2(1, 0, 0, 0));

    EXPECT_LE((solution.X - matrix2(r, 1, 1, r)).norm(), 1e-15);
    const std::complex<double> pole(-r / 2, -r / 2);
    EXPECT_LE(std::abs(solution.closed_loop_eigenvalues(0) - pole), 1e-15);
    EXPECT_LE(std::abs(solution.closed_loop_eigenvalues(1) - std::conj(pole)), 1e-15);
}

TEST(riccati, random_problems_are_solved_and_stabilised)
{
    std::mt19937 generator(20240601);
    for (int trial = 0; trial < 150; ++trial) {
        SCOPED_TRACE(trial);
        const Eigen::Index n     = 1 + trial % 8;
        const Eigen::Index m     = 1 + trial % 3;
        const double       scale = std::pow(10.0, trial % 7 - 3);
        const MatrixXd     A     = scale * random_matrix(n, n, generator);
        const MatrixXd     B     = random_matrix(n, m, generator);
        const MatrixXd     N     = random_matrix(m, m, generator);
        const MatrixXd     R     = N * N.transpose() + MatrixXd::Identity(m, m);
        const MatrixXd     Q     = random_semidefinite(n, 1 + trial % 4, generator);
        const MatrixXd     G     = sdre::control_weight(B, R);

        const sdre::CareSolution from_g = sdre::solve_care(A, G, Q);
        const sdre::CareSolution from_b = sdre::solve_care(A, B, R, Q);

        // Slow dynamics under cheap control: X is large, and G X cancels to the size of A.
        // Measured at worst: residual 3e-15, or 3e-10 there.
        const double loss = scale < 0.05 ? 1e5 : 1.0;
        expect_stabilising(A, G, Q, from_g, 1e-14 * loss);
        EXPECT_LE(from_b.relative_residual, 1e-14 * loss);
        EXPECT_LE((from_g.X - from_b.X).norm(), 1e-11 * loss * from_b.X.norm());
    }
}

TEST(riccati, closed_loop_eigenvalues_are_sorted_and_paired)
{
    std::mt19937           generator(7);
    const MatrixXd         A = random_matrix(9, 9, generator);
    const Eigen::VectorXcd modes =
        sdre::solve_care(A, random_semidefinite(9, 2, generator), MatrixXd::Identity(9, 9))
            .closed_loop_eigenvalues;
    for (Eigen::Index i = 0; i + 1 < modes.size(); ++i) {
        EXPECT_LE(modes(i).real(), modes(i + 1).real());
        if (modes(i).imag() < 0) {
            EXPECT_EQ(modes(i + 1), std::conj(modes(i)));
        }
    }
}

TEST(riccati, change_of_state_coordinates_changes_only_the_coordinates_of_x)
{
    std::mt19937 generator(11);
    for (int trial = 0; trial < 20; ++trial) {
        const MatrixXd A = random_matrix(4, 4, generator);
        const MatrixXd B = random_matrix(4, 2, generator);
        const MatrixXd Q = random_semidefinite(4, 2, generator);
        const MatrixXd T = random_matrix(4, 4, generator) + 4.0 * MatrixXd::Identity(4, 4);
        const MatrixXd S = support::inverse(T);
        const MatrixXd R = MatrixXd::Identity(2, 2);

        const MatrixXd X  = sdre::solve_care(A, B, R, Q).X;
        const MatrixXd QT = T.transpose() * Q * T;
        const MatrixXd XT = sdre::solve_care(S * A * T, S * B, R, 0.5 * (QT + QT.transpose())).X;

        EXPECT_LE((XT - T.transpose() * X * T).norm(), 1e-9 * XT.norm());
    }
}

TEST(riccati, scaling_of_weights_time_and_single_states_is_followed)
{
    std::mt19937   generator(13);
    const MatrixXd A = random_matrix(4, 4, generator);
    const MatrixXd G = random_semidefinite(4, 2, generator);
    const MatrixXd Q = random_semidefinite(4, 3, generator);
    const MatrixXd X = sdre::solve_care(A, G, Q).X;
    for (const double c : {1e-100, 1e-9, 1e-3, 1e4, 1e12, 1e100}) {
        SCOPED_TRACE(c);
        EXPECT_LE((sdre::solve_care(A, G / c, Q * c).X / c - X).norm(), 1e-12 * X.norm());
        EXPECT_LE((sdre::solve_care(A * c, G * c, Q * c).X - X).norm(), 1e-12 * X.norm());
        Eigen::VectorXd d(4);
        d << 1, c, 1, 1 / c;
        const Eigen::VectorXd e  = d.cwiseInverse();
        const MatrixXd        XD = sdre::solve_care(e.asDiagonal() * A * d.asDiagonal(),
                                                    e.asDiagonal() * G * e.asDiagonal(),
                                                    d.asDiagonal() * Q * d.asDiagonal())
                                .X;
        EXPECT_LE((e.asDiagonal() * XD * e.asDiagonal() - X).norm(), 1e-12 * X.norm());
    }
}

TEST(riccati, uncontrollable_stable_and_unweighted_antistable_modes_are_no_obstacle)
{
    const sdre::CareSolution solution =
        sdre::solve_care(matrix2(-1, 0, 0, 2), matrix2(0, 0, 0, 1), matrix2(1, 0, 0, 0));

    // Mode -1 costs 1/2, mode 2 is mirrored to -2 at the price 2a/g.
    EXPECT_LE((solution.X - matrix2(0.5, 0, 0, 4)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(solution.closed_loop_eigenvalues(0).real(), -2.0);
    EXPECT_DOUBLE_EQ(solution.closed_loop_eigenvalues(1).real(), -1.0);
}

TEST(riccati, stable_plant_without_weight_needs_no_control)
{
    const sdre::CareSolution solution =
        sdre::solve_care(matrix2(-1, 5, 0, -2), matrix2(1, 0, 0, 1), matrix2(0, 0, 0, 0));

    EXPECT_LE(solution.X.norm(), 1e-18);
}

TEST(riccati, very_different_time_scales_are_solved)
{
    const MatrixXd           A        = Eigen::Vector3d(-1e-6, 1e-2, -1e9).asDiagonal();
    const MatrixXd           I        = MatrixXd::Identity(3, 3);
    const sdre::CareSolution solution = sdre::solve_care(A, 1e-12 * I, 1e-12 * I);
    for (Eigen::Index i = 0; i < 3; ++i) {
        const double a    = A(i, i);
        const double root = std::sqrt(a * a + 1e-24);
        const double x    = a > 0 ? (a + root) / 1e-12 : 1e-12 / (root - a);
        EXPECT_NEAR(solution.X(i, i), x, 1e-15 * solution.X.norm());
    }
    EXPECT_NEAR(solution.closed_loop_eigenvalues(2).real(), -1e-6, 1e-15);
}

TEST(riccati, indefinite_weight_is_accepted_only_with_a_semidefinite_solution)
{
    // x = a + sqrt(a^2 + q) with g = 1: positive for a = 1, negative for a = -2.
    EXPECT_NEAR(sdre::solve_care(scalar(1), scalar(1), scalar(-0.75)).X(0, 0), 1.5, 1e-15);
    expect_design_error(care(scalar(-2), scalar(1), scalar(-1)), "Q is not positive semidefinite");
    expect_design_error(care(scalar(1), scalar(1), scalar(-2)), "Q is not positive semidefinite");
    expect_design_error(care(scalar(1), scalar(1), scalar(-2)),
                        "Hamiltonian has eigenvalues on the imaginary axis (s = 0 + 1j)");
}

TEST(riccati, an_indefinite_solution_is_returned_only_to_who_allows_it)
{
    // x = a + sqrt(a^2 + q) = -2 + sqrt(3) with g = 1: stabilising, and negative.
    const double x = -2.0 + std::sqrt(3.0);
    for (const sdre::Precision precision : {sdre::Precision::quick, sdre::Precision::extended}) {
        const sdre::CareSolution solution =
            sdre::solve_care(scalar(-2), scalar(1), scalar(-1), sdre::CareOptions{precision, true});
        EXPECT_NEAR(solution.X(0, 0), x, 1e-15);
        EXPECT_FALSE(solution.semidefinite);
        EXPECT_LT(solution.closed_loop_eigenvalues(0).real(), 0.0);
        EXPECT_TRUE(sdre::solve_care(scalar(1), scalar(1), scalar(-0.75),
                                     sdre::CareOptions{precision, true})
                        .semidefinite);
    }
    expect_design_error(care(scalar(-2), scalar(1), scalar(-1)), "Q is not positive semidefinite");
}

TEST(riccati_benchmark, case_1_4_has_an_indefinite_weight_and_solution)
{
    const Json     problem = read_json("carex-1.4");
    const MatrixXd A       = matrix_from(problem["A"]);
    const MatrixXd B       = matrix_from(problem["B"]);
    const MatrixXd R       = matrix_from(problem["R"]);
    const MatrixXd Q       = matrix_from(problem["Q"]);
    const MatrixXd X_ref   = matrix_from(problem["X_ref"]);
    for (const sdre::Precision precision : {sdre::Precision::quick, sdre::Precision::extended}) {
        const sdre::CareSolution solution =
            sdre::solve_care(A, B, R, Q, sdre::CareOptions{precision, true});
        EXPECT_LE((solution.X - X_ref).norm(), 1e-15 * X_ref.norm()); // measured 1e-16
        EXPECT_FALSE(solution.semidefinite);
        EXPECT_LT(solution.closed_loop_eigenvalues.real().maxCoeff(), 0.0);
    }
    expect_design_error(care(A, B, R, Q), "Q is not positive semidefinite");
}

TEST(riccati, both_precisions_give_the_same_double)
{
    std::mt19937 generator(23);
    for (int trial = 0; trial < 100; ++trial) {
        SCOPED_TRACE(trial);
        const Eigen::Index n = 1 + trial % 16;
        const MatrixXd     A = random_matrix(n, n, generator);
        const MatrixXd     G = random_semidefinite(n, 1 + trial % 3, generator);
        const MatrixXd     Q = random_semidefinite(n, n, generator);
        const MatrixXd     X =
            sdre::solve_care(A, G, Q, sdre::CareOptions{sdre::Precision::extended}).X;
        // Measured: 1.1e-15 at worst. Both find X from residuals rounded to 64 bits, times the condition.
        EXPECT_LE((sdre::solve_care(A, G, Q).X - X).norm(), 5e-15 * X.norm());
    }
}

TEST(riccati_refuses, unsymmetric_weights)
{
    const MatrixXd bad = matrix2(1, 2e-9, 0, 1);
    const MatrixXd I   = matrix2(1, 0, 0, 1);
    expect_design_error(care(I, I, bad), "Q is not symmetric");
    expect_design_error(care(I, bad, I), "G is not symmetric");
    expect_design_error(weight(I, bad), "R is not symmetric");
    expect_design_error(care(I, I, bad, I), "R is not symmetric");
}

TEST(riccati_refuses, indefinite_control_weights)
{
    const MatrixXd bad = matrix2(1, 2, 2, 1);
    const MatrixXd I   = matrix2(1, 0, 0, 1);
    expect_design_error(care(I, bad, I), "G is not positive semidefinite");
    expect_design_error(care(I, matrix2(-1, 0, 0, -1), I), "G is not positive semidefinite");
    expect_design_error(weight(I, bad), "R is not positive definite");
    expect_design_error(weight(I, matrix2(1, 1, 1, 1)), "R is not positive definite");
    expect_design_error(weight(I, matrix2(0, 0, 0, 0)), "R is not positive definite");
    // A negative weight that no rounding explains is not lost next to a large one.
    const MatrixXd tiny = matrix2(1e10, 0, 0, -1e-8);
    expect_design_error(care(I, tiny, I), "G is not positive semidefinite");
}

TEST(riccati_refuses, unstabilisable_modes_by_name)
{
    const MatrixXd    I      = matrix2(1, 0, 0, 1);
    const MatrixXd    none   = matrix2(0, 0, 0, 0);
    const MatrixXd    second = matrix2(0, 0, 0, 1);
    const std::string start  = "design error: (A,B) is not stabilisable: mode at s = ";
    EXPECT_EQ(care(matrix2(3, 0, 0, -1), second, I), start + "3 cannot be moved");
    EXPECT_EQ(care(matrix2(3, 0, 0, -1), none, I), start + "3 cannot be moved");
    EXPECT_EQ(care(matrix2(0, 0, 0, -1), second, I), start + "0 cannot be moved");
    EXPECT_EQ(care(matrix2(1, 2, -2, 1), none, I), start + "1 + 2j cannot be moved");
}

TEST(riccati_refuses, unweighted_modes_on_the_axis_by_name)
{
    const MatrixXd    I          = matrix2(1, 0, 0, 1);
    const std::string integrator = care(matrix2(0, 1, 0, 0), I, matrix2(0, 0, 0, 1));
    expect_design_error(integrator, "(A,Q) is not detectable: mode at s = 0 ");
    expect_design_error(integrator, "Hamiltonian has eigenvalues on the imaginary axis (s = 0)");
    expect_design_error(care(matrix2(0, 3, -3, 0), I, matrix2(0, 0, 0, 0)),
                        "(A,Q) is not detectable: mode at s = 0 + 3j");
}

TEST(riccati_refuses, broken_assumptions_hidden_by_a_change_of_coordinates)
{
    std::mt19937 generator(17);
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        const Eigen::Index n = 2 + trial % 5;
        const MatrixXd     T = random_matrix(n, n, generator) + 4.0 * MatrixXd::Identity(n, n);
        const MatrixXd     S = support::inverse(T);
        MatrixXd           A = random_matrix(n, n, generator) * std::pow(10.0, trial % 5 - 2);
        A.row(0).setZero();
        A(0, 0)          = 1.0 + trial % 3;
        MatrixXd B       = random_matrix(n, 1, generator);
        B(0, 0)          = 0.0;
        const MatrixXd I = MatrixXd::Identity(n, n);
        const MatrixXd R = scalar(1.0);
        expect_design_error(care(T * A * S, T * B, R, I), "(A,B) is not stabilisable: mode");

        // On the axis rounding puts the mode on either side; both must be named alike.
        A(0, 0) = 0.0;
        expect_design_error(care(T * A * S, T * B, R, I), "(A,B) is not stabilisable: mode");

        MatrixXd F = random_matrix(n, n, generator) * std::pow(10.0, trial % 5 - 2);
        F.col(0).setZero();
        MatrixXd C        = random_matrix(1, n, generator);
        C(0, 0)           = 0.0;
        const MatrixXd CS = C * S;
        expect_design_error(care(T * F * S, I, CS.transpose() * CS),
                            "(A,Q) is not detectable: mode");
    }
}

TEST(riccati_refuses, repeated_unstabilisable_modes_that_rounding_spreads)
{
    // A Jordan block of size k spreads by the k-th root of the rounding, far past any tolerance on a
    // single mode.
    std::mt19937 generator(5);
    for (int trial = 0; trial < 160; ++trial) {
        SCOPED_TRACE(trial);
        const Eigen::Index k = 1 + trial % 4;
        const Eigen::Index n = k + 2;
        MatrixXd           A = random_matrix(n, n, generator);
        A.topRows(k).setZero();
        A.topLeftCorner(k, k).diagonal().setConstant(trial % 8 < 4 ? 1.0 : 1e-3);
        A.topLeftCorner(k, k).diagonal(1).setOnes();
        MatrixXd B = random_matrix(n, 1, generator);
        B.topRows(k).setZero();
        const MatrixXd T = random_matrix(n, n, generator) + 4.0 * MatrixXd::Identity(n, n);
        const MatrixXd S = support::inverse(T);
        expect_design_error(care(T * A * S, T * B, scalar(1.0), MatrixXd::Identity(n, n)),
                            "(A,B) is not stabilisable: mode");
    }
}

TEST(riccati_refuses, wrong_shapes_and_entries)
{
    const MatrixXd I2   = MatrixXd::Identity(2, 2);
    const MatrixXd I3   = MatrixXd::Identity(3, 3);
    const MatrixXd wide = MatrixXd::Ones(2, 3);
    expect_input_error(care(MatrixXd(), MatrixXd(), MatrixXd()));
    expect_input_error(care(wide, I2, I2));
    expect_input_error(care(I2, I3, I2));
    expect_input_error(care(I2, I2, I3));
    expect_input_error(care(I2, I3, I3, I2));
    expect_input_error(care(I2, wide, I2, I2));
    expect_input_error(weight(wide, I2));
    expect_input_error(weight(MatrixXd(), MatrixXd()));
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        MatrixXd M = I2;
        M(0, 1) = M(1, 0) = bad;
        expect_input_error(care(M, I2, I2));
        expect_input_error(care(I2, M, I2));
        expect_input_error(care(I2, I2, M));
        expect_input_error(weight(M, I2));
        expect_input_error(weight(I2, M));
    }
}

TEST(riccati, extreme_magnitudes_give_a_finite_solution_or_a_design_error)
{
    int solved = 0;
    for (const double a : {-1e300, -1.0, 0.0, 1.0, 1e300}) {
        for (const double g : {1e-300, 1.0, 1e300}) {
            for (const double q : {1e-300, 1.0, 1e300}) {
                try {
                    const sdre::CareSolution solution =
                        sdre::solve_care(scalar(a), scalar(g), scalar(q));
                    EXPECT_TRUE(solution.X.allFinite());
                    EXPECT_TRUE(std::isfinite(solution.relative_residual));
                    ++solved;
                } catch (const sdre::DesignError &) {
                }
            }
        }
    }
    EXPECT_GE(solved, 30);
}

TEST(riccati, extreme_control_weights_are_refused_when_they_overflow)
{
    expect_design_error(weight(scalar(1e200), scalar(1e-200)), "exceeds the range");
    EXPECT_DOUBLE_EQ(sdre::control_weight(scalar(1e200), scalar(1e200))(0, 0), 1e200);
}

} // namespace
