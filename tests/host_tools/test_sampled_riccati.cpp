// SPDX-License-Identifier: MIT
#include "linalg/sampled_riccati.hpp"

#include <cmath>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "reference_gains.hpp"

namespace {

using Eigen::MatrixXd;
using sdre::SampledObserverGain;
using sdre::SampledObserverProblem;

/// Relative distance from another solver in double precision.
constexpr double tolerance_K0 = 1e-9;
/// The same of a difference quotient with steps of 1e-4: its own error.
constexpr double tolerance_K1 = 1e-6;

/// Made with SciPy: P = solve_discrete_are(A', C', Q, R), K = P C' (C P C' + R)^-1. K1 is the
/// difference quotient of fourth order of K at A0 + s A1, Q0 + s Q1, with steps 1e-4 and 2e-4.
support::Json reference()
{
    return support::Json::read(std::string(SDRE_TEST_DATA_DIR) + "/sampled_riccati.json");
}

SampledObserverProblem problem_of(const support::Json &c)
{
    return {support::matrix_of(c.at("A0")), support::matrix_of(c.at("A1")),
            support::matrix_of(c.at("Q0")), support::matrix_of(c.at("Q1")),
            support::matrix_of(c.at("C")),  support::matrix_of(c.at("R"))};
}

SampledObserverProblem scalar(double a, double q, double r)
{
    const MatrixXd zero = MatrixXd::Zero(1, 1);
    const MatrixXd one  = MatrixXd::Identity(1, 1);
    return {a * one, zero, q * one, zero, one, r * one};
}

double relative(const MatrixXd &found, const MatrixXd &expected)
{
    return (found - expected).norm() / expected.norm();
}

} // namespace

TEST(SampledRiccati, AgreesWithSciPy)
{
    const support::Json cases = reference().at("cases");
    ASSERT_EQ(cases.size(), 7U);
    for (const support::Json &c : cases) {
        const std::string         name = c.at("name").text();
        const SampledObserverGain g    = sdre::solve_sampled_observer(problem_of(c));

        EXPECT_LT(relative(g.P0, support::matrix_of(c.at("P0"))), tolerance_K0) << name;
        EXPECT_LT(relative(g.K0, support::matrix_of(c.at("K0"))), tolerance_K0) << name;
        EXPECT_LT(relative(g.K1, support::matrix_of(c.at("K1"))), tolerance_K1) << name;
        EXPECT_LT(g.riccati_residual, 1e-14) << name;
        EXPECT_LT(g.stein_residual, 1e-14) << name;
        EXPECT_LT(g.spectral_radius, 1.0) << name;
    }
}

/// EQ-DARE-1 with one state: P^2 + P (R (1 - a^2) - Q) - Q R = 0.
TEST(SampledRiccati, OneStateHasAClosedForm)
{
    for (const double a : {0.5, 0.99, 1.0, 1.2}) {
        for (const double q : {1e-4, 1.0, 30.0}) {
            const double r    = 0.7;
            const double half = 0.5 * (r * (1.0 - a * a) - q);
            const double P    = -half + std::sqrt(half * half + q * r);

            const SampledObserverGain g = sdre::solve_sampled_observer(scalar(a, q, r));

            EXPECT_NEAR(g.P0(0, 0), P, 1e-12 * P) << a << " " << q;
            EXPECT_NEAR(g.K0(0, 0), P / (P + r), 1e-12);
            EXPECT_NEAR(g.spectral_radius, a * r / (P + r), 1e-12);
        }
    }
}

/// EQ-DARE-2 against exact solutions beside s = 0, of a series that is not linear.
TEST(SampledRiccati, FirstOrderTermIsTheDerivative)
{
    const SampledObserverProblem p  = problem_of(reference().at("cases").at(4));
    const SampledObserverGain    g  = sdre::solve_sampled_observer(p);
    const auto                   at = [&p](double s) {
        SampledObserverProblem moved = p;
        moved.A0 += s * p.A1;
        moved.Q0 += s * p.Q1;
        return sdre::solve_sampled_observer(moved).K0;
    };
    const double   h     = 1e-3;
    const MatrixXd wide  = (at(2 * h) - at(-2 * h)) / (4 * h);
    const MatrixXd close = (at(h) - at(-h)) / (2 * h);

    const double of_wide  = relative(wide, g.K1);
    const double of_close = relative(close, g.K1);
    EXPECT_LT(of_close, 1e-3);
    EXPECT_NEAR(of_wide / of_close, 4.0, 0.1); // second order: the limit is K1
}

TEST(SampledRiccati, NothingToScheduleGivesNoFirstOrderTerm)
{
    const SampledObserverGain g = sdre::solve_sampled_observer(scalar(0.9, 1.0, 1.0));
    EXPECT_TRUE(g.K1.isZero(0.0));
    EXPECT_EQ(g.stein_residual, 0.0);
}

/// Units of the states do not matter: rows of K scale as the states do.
TEST(SampledRiccati, ScalesOfTheStatesDoNotMatter)
{
    const SampledObserverProblem p = problem_of(reference().at("cases").at(6));
    const Eigen::VectorXd        scale =
        (Eigen::VectorXd(7) << 1e6, 1e6, 1e-3, 1e-3, 1, 1e4, 1e5).finished();
    const MatrixXd T = scale.asDiagonal();
    const MatrixXd U = scale.cwiseInverse().asDiagonal();

    const MatrixXd K = sdre::solve_sampled_observer(p).K0;
    const MatrixXd L = sdre::solve_sampled_observer(
                           {T * p.A0 * U, T * p.A1 * U, T * p.Q0 * T, T * p.Q1 * T, p.C * U, p.R})
                           .K0;

    EXPECT_LT(relative(U * L, K), 1e-12);
}

TEST(SampledRiccati, UnstableModeThatNothingMeasuresIsRefused)
{
    SampledObserverProblem p = scalar(0.9, 1.0, 1.0);
    p.A0 = p.A1 = p.Q0 = p.Q1 = MatrixXd::Zero(2, 2);
    p.A0.diagonal() << 0.9, 1.1;
    p.Q0.diagonal() << 1.0, 1.0;
    p.C       = MatrixXd::Zero(1, 2);
    p.C(0, 0) = 1.0;
    EXPECT_THROW(sdre::solve_sampled_observer(p), sdre::DesignError);

    p.Q0(1, 1) = 0.0; // not even excited: the equation has a solution, but it stabilises nothing
    EXPECT_THROW(sdre::solve_sampled_observer(p), sdre::DesignError);
}

TEST(SampledRiccati, UnexcitedIntegratorIsRefused)
{
    EXPECT_THROW(sdre::solve_sampled_observer(scalar(1.0, 0.0, 1.0)), sdre::DesignError);
}
