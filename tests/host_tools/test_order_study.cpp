// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "command.hpp"
#include "design/design.hpp"
#include "gains/order_study.hpp"
#include "json.hpp"
#include "temp_dir.hpp"

namespace {

const std::string drives = std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/";

sdre::Drive shipped(const std::string &name)
{
    return sdre::read_drive_file(drives + name + ".toml");
}

} // namespace

TEST(OrderStudy, ErrorsAreThoseOfTheGainAgainstTheExactSolution)
{
    const sdre::Drive      drive = shipped("ipmsm_390w_speed");
    const sdre::OrderStudy study = sdre::study_orders(drive, 3);
    ASSERT_EQ(study.loops.size(), 2U);
    sdre::Drive cubic = drive;
    cubic.nosc.order = cubic.nodo.order = 3;
    const sdre::Design    d             = sdre::design_drive(cubic);
    const Eigen::MatrixXd controller =
        Eigen::Vector2d(drive.nosc.T[0], drive.nosc.T[1]).cwiseInverse().asDiagonal() *
        sdre::nosc_input_matrix(d.l).transpose();
    const Eigen::MatrixXd observer =
        sdre::nodo_model(d.l, drive.nodo.form).C.transpose() *
        Eigen::Vector3d(drive.nodo.T[0], drive.nodo.T[1], drive.nodo.T[2])
            .cwiseInverse()
            .asDiagonal();
    for (std::size_t i = 0; i < 2; i++) {
        const sdre::GainSeries &g    = i == 0 ? d.nosc : d.nodo;
        const sdre::LoopOrders &loop = study.loops[i];
        EXPECT_EQ(loop.lyapunov, (std::vector<int>{0, 1, 2, 3}));
        EXPECT_EQ(loop.within_A.front(), 0.0);
        EXPECT_EQ(loop.within_A.back(), 8.0);
        for (std::size_t order = 0; order < 4; order++) {
            double worst = 0.0; // at 2 A the error is largest at an end of the range or inside it
            for (int k = -16; k <= 16; k++) {
                const double          s     = 0.125 * k;
                const Eigen::MatrixXd X     = sdre::solve_sdre_exact(g.problem, {s}).X;
                const Eigen::MatrixXd exact = i == 0 ? controller * X : X * observer;
                Eigen::MatrixXd       K     = Eigen::MatrixXd::Zero(exact.rows(), exact.cols());
                for (std::size_t n = 0; n <= order; n++) {
                    K += std::pow(s, n) * g.gain[n];
                }
                worst = std::max(worst, (K - exact).norm() / exact.norm());
            }
            EXPECT_NEAR(loop.errors[order][16] / worst, 1.0, 1e-9) << loop.name << order;
            EXPECT_TRUE(std::is_sorted(loop.errors[order].begin(), loop.errors[order].end()));
        }
        EXPECT_LT(loop.errors[3][16], loop.errors[0][16]);
    }
}

TEST(OrderStudy, TwoVariablesCountTheirEquations)
{
    const sdre::OrderStudy study = sdre::study_orders(shipped("ipmsm_390w_conventional"), 3);
    for (const sdre::LoopOrders &loop : study.loops) {
        EXPECT_EQ(loop.lyapunov, (std::vector<int>{0, 2, 5, 9}));
    }
}

/// Both variables, apart: every order is nearer to the exact gain than the one before.
TEST(OrderStudy, TwoVariablesConverge)
{
    sdre::Drive drive = shipped("ipmsm_390w_conventional");
    drive.nosc.order = drive.nodo.order = 3;
    const sdre::Design d                = sdre::design_drive(drive);
    for (const sdre::GainSeries *g : {&d.nosc, &d.nodo}) {
        const std::vector<sdre::Schedule> points{{0.8, -0.3}, {-0.3, 0.8}, {0.6, 0.6}};
        const auto                        errors = sdre::series_errors(*g, points);
        ASSERT_EQ(errors.size(), 4U);
        for (std::size_t i = 0; i < points.size(); i++) {
            const Eigen::MatrixXd exact = g->exact(points[i]);
            const Eigen::MatrixXd K     = sdre::series_gain(*g, points[i], 3);
            EXPECT_NEAR(errors[3][i], (K - exact).norm() / exact.norm(), 1e-12);
            EXPECT_LT(errors[1][i], 0.5 * errors[0][i]) << i;
            EXPECT_LT(errors[3][i], 0.5 * errors[1][i]) << i;
        }
    }
    EXPECT_EQ(sdre::reach({0.8, -1.3}), 1.3);
    EXPECT_EQ(sdre::box_grid(2, 3.0, 2).size(), 25U);
    EXPECT_EQ(sdre::box_grid(2, 3.0, 2).front(), (sdre::Schedule{-3.0, -3.0}));
    EXPECT_EQ(sdre::box_grid(2, 3.0, 2).at(1), (sdre::Schedule{-3.0, -1.5}));
}

TEST(OrderStudy, CommandPrintsAndWrites)
{
    const support::TempDir dir;
    const auto r = support::run_command({SDRE_GAINS_EXE, "orders", drives + "ipmsm_390w.toml",
                                         "--highest", "1", "--csv", dir / "o.csv"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    for (const char *piece : {"controller", "observer", "order 1", "8 A"}) {
        EXPECT_NE(r.out.find(piece), std::string::npos) << piece;
    }
    EXPECT_EQ(r.out.find("order 2"), std::string::npos);
    const std::string csv = support::read_file(dir / "o.csv");
    EXPECT_EQ(csv.rfind("loop,order,within_A,error\n", 0), 0U);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2 * 64);
    const auto json = support::run_command(
        {SDRE_GAINS_EXE, "orders", drives + "ipmsm_390w.toml", "--highest", "0", "--json"});
    EXPECT_EQ(support::Json::parse(json.out).at("loops").at("observer").at("errors").size(), 1U);
}

TEST(OrderStudy, LawsWithoutASeriesAreRefused)
{
    support::expect_refused(
        support::run_command({SDRE_GAINS_EXE, "orders", drives + "servo_200w_pid.toml"}), 1,
        "sdre-gains", {"pid", "has no series"});
    support::expect_refused(support::run_command({SDRE_GAINS_EXE, "orders",
                                                  drives + "ipmsm_390w.toml", "--highest", "9"}),
                            1, "sdre-gains", {"--highest"});
}
