// SPDX-License-Identifier: MIT
/// The conventional law's series in two variables against equations formed here, and against the exact SDRE.
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "command.hpp"
#include "common/errors.hpp"
#include "design/design.hpp"
#include "drive_text.hpp"
#include "temp_dir.hpp"

namespace {

using Eigen::MatrixXd;
using support::DriveText;
using support::TempDir;

using Powers = std::pair<int, int>;

constexpr double residual_tolerance =
    1e-12; // double products of matrices of very different entries

DriveText drive_text(const std::string &disturbances, int order)
{
    const bool load = disturbances == "load";
    return DriveText()
        .set("", "law", "\"conventional_noc\"")
        .set("nosc", "order", std::to_string(order))
        .set("nodo", "order", std::to_string(order))
        .set("nodo", "disturbances", "\"" + disturbances + "\"")
        .set("nodo", "Q",
             load ? "[1.0e8, 85.0, 86.0, 90.0]" : "[1.0e8, 1.1e8, 1.2e8, 85.0, 86.0, 90.0]");
}

sdre::Drive drive(const std::string &disturbances, int order)
{
    const TempDir dir;
    return sdre::read_drive_file(dir.write("d.toml", drive_text(disturbances, order).str()));
}

std::map<Powers, MatrixXd> terms_of(const sdre::GainSeries &g)
{
    std::map<Powers, MatrixXd> terms;
    for (const sdre::SeriesTerm &term : g.series.terms) {
        terms[{term.powers.at(0), term.powers.at(1)}] = term.X;
    }
    return terms;
}

/// Relative residual of the equation of P_mn, every sum written out for two variables.
double residual(const sdre::GainSeries &g, const std::map<Powers, MatrixXd> &P, int m, int n)
{
    const sdre::SdreProblem &p    = g.problem;
    const MatrixXd           A    = p.A0 - p.G * P.at({0, 0});
    MatrixXd                 R    = P.at({m, n}) * A + A.transpose() * P.at({m, n});
    double                   size = (P.at({m, n}) * A).norm();
    const auto               add  = [&](const MatrixXd &X) {
        R += X;
        size += X.norm();
    };
    if (m > 0) {
        const MatrixXd X = P.at({m - 1, n}) * p.dA[0];
        add(X + X.transpose());
    }
    if (n > 0) {
        const MatrixXd X = P.at({m, n - 1}) * p.dA[1];
        add(X + X.transpose());
    }
    for (int i = 0; i <= m; i++) {
        for (int j = 0; j <= n; j++) {
            if (i + j > 0 && i + j < m + n) {
                add(-P.at({i, j}) * p.G * P.at({m - i, n - j}));
            }
        }
    }
    return R.norm() / size;
}

} // namespace

TEST(Conventional, StateMatrixHoldsTheProductsThatTheFeedForwardLeaves)
{
    const sdre::Drive             d  = drive("load", 1);
    const sdre::ReducedParameters l  = sdre::reduced_parameters(d.motor);
    const sdre::SdreProblem       p  = sdre::conventional_nosc_problem(l, d.nosc);
    const double                  ew = 7.0, eq = 1.3, ed = -0.6;
    const Eigen::Vector3d         e(ew, eq, ed);
    const Eigen::Vector3d         expected(-l[2] * ew + l[1] * eq + l[11] * eq * ed,
                                           -l[5] * ew - l[4] * eq - l[10] * ed * ew,
                                           -l[7] * ed + l[9] * eq * ew);
    EXPECT_LT((sdre::state_matrix(p, {eq, ed}) * e - expected).norm(), 1e-12 * expected.norm());
}

TEST(Conventional, ObserverModelIsTheMotorWithItsProducts)
{
    const sdre::ReducedParameters l = sdre::reduced_parameters(drive("all", 1).motor);
    const double                  w = 300.0, iq = 1.7, id = -0.8;
    for (const auto form : {sdre::NodoForm::conventional_load, sdre::NodoForm::conventional_all}) {
        const sdre::ObserverModel model = sdre::nodo_model(l, form);
        const bool                load  = form == sdre::NodoForm::conventional_load;
        const Eigen::Index        n     = load ? 4 : 6;
        const double              dw = 11.0, dq = load ? 0.0 : 12.0, dd = load ? 0.0 : 13.0;
        Eigen::VectorXd           x(n);
        Eigen::VectorXd           expected = Eigen::VectorXd::Zero(n);
        x.head(load ? 1 : 3)               = Eigen::Vector3d(dw, dq, dd).head(load ? 1 : 3);
        x.tail(3) << w, iq, id;
        expected.tail(3) << dw - l[2] * w + l[1] * iq + l[11] * iq * id,
            dq - l[5] * w - l[4] * iq - l[10] * id * w, dd - l[7] * id + l[9] * iq * w;
        const MatrixXd A = model.A0 + iq * model.dA + id * model.dA_id.value();
        EXPECT_LT((A * x - expected).norm(), 1e-12 * expected.norm());
        EXPECT_EQ(model.C * x, Eigen::Vector3d(w, iq, id));
    }
    EXPECT_FALSE(sdre::nodo_model(l, sdre::NodoForm::speed).dA_id.has_value());
}

TEST(Conventional, EveryEquationOfTheSeriesHolds)
{
    for (const char *disturbances : {"load", "all"}) {
        const sdre::Design d = sdre::design_drive(drive(disturbances, 3));
        for (const sdre::GainSeries *g : {&d.nosc, &d.nodo}) {
            const auto P = terms_of(*g);
            ASSERT_EQ(P.size(), 10U);
            for (const auto &[powers, X] : P) {
                if (powers.first + powers.second > 0) {
                    EXPECT_LT(residual(*g, P, powers.first, powers.second), residual_tolerance)
                        << disturbances << " " << powers.first << powers.second;
                }
            }
        }
    }
}

TEST(Conventional, SeriesApproachesTheExactSolutionAsItsOrderSays)
{
    for (const char *disturbances : {"load", "all"}) {
        const sdre::Design d = sdre::design_drive(drive(disturbances, 3));
        for (const sdre::GainSeries *g : {&d.nosc, &d.nodo}) {
            const auto worst = [&](double range) {
                std::vector<double> errors;
                for (const auto &at : sdre::series_errors(*g, sdre::box_grid(2, range, 3))) {
                    errors.push_back(*std::max_element(at.begin(), at.end()));
                }
                return errors;
            };
            const std::vector<double> far  = worst(0.4);
            const std::vector<double> near = worst(0.2);
            for (std::size_t order = 0; order < far.size(); order++) {
                const double halved = std::log2(far[order] / near[order]);
                EXPECT_GT(halved, static_cast<double>(order) + 0.7) << disturbances << order;
                EXPECT_LT(far[order], 0.2);
            }
        }
    }
}

TEST(Conventional, FirmwareTablesHoldTheGainAtEveryPoint)
{
    for (const char *disturbances : {"load", "all"}) {
        const sdre::Design d         = sdre::design_drive(drive(disturbances, 2));
        const auto        *constants = sdre::constants_of<law_conventional_config_t>(d.config);
        ASSERT_TRUE(constants != nullptr);
        const conventional_gains_t &c    = constants->gains;
        const nosc_gains_t         &nosc = constants->near_optimal.nosc;
        EXPECT_EQ(nosc.order, 0);
        EXPECT_NEAR(static_cast<double>(nosc.lambda[0][0][1]), d.nosc.gain[0](0, 1), 1e-4);
        const std::vector<double>   s{0.9, -0.7};
        const double_series_point_t at{0.9F, -0.7F};
        const MatrixXd              Lambda = sdre::series_gain(d.nosc, s, 2);
        const MatrixXd              L      = sdre::series_gain(d.nodo, s, 2);
        const std::vector<int>      rows   = std::string(disturbances) == "load"
                                                 ? std::vector<int>{0, 3, 4, 5}
                                                 : std::vector<int>{0, 1, 2, 3, 4, 5};
        for (int column = 0; column < 3; column++) {
            const float x[3] = {column == 0 ? 1.0F : 0.0F, column == 1 ? 1.0F : 0.0F,
                                column == 2 ? 1.0F : 0.0F};
            for (int row = 0; row < 2; row++) {
                EXPECT_NEAR(double_series_row(&c.lambda[row], NOSC_N_U, c.nosc_order, at, x),
                            Lambda(row, column), 1e-5 * Lambda.norm());
            }
            for (std::size_t i = 0; i < rows.size(); i++) {
                EXPECT_NEAR(double_series_row(&c.gain[rows[i]], NODO_N_X, c.nodo_order, at, x),
                            L(static_cast<Eigen::Index>(i), column), 1e-5 * L.norm());
            }
            if (rows.size() == 4U) {
                EXPECT_EQ(double_series_row(&c.gain[1], NODO_N_X, c.nodo_order, at, x), 0.0F);
                EXPECT_EQ(double_series_row(&c.gain[2], NODO_N_X, c.nodo_order, at, x), 0.0F);
            }
        }
    }
}

/// Its margins hold; half the inductance does not.
TEST(Conventional, ShippedDriveFailsForLittleInductanceAlone)
{
    const sdre::Design d = sdre::design_drive(sdre::read_drive_file(
        std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/ipmsm_390w_conventional.toml"));
    ASSERT_EQ(d.certificate.failures.size(), 1U);
    EXPECT_NE(d.certificate.failures[0].find("L x0.50"), std::string::npos);
    for (const sdre::SampledLoop *loop : {&d.certificate.nosc, &d.certificate.nodo}) {
        EXPECT_EQ(loop->range_A, 8.0);
        EXPECT_LT(loop->spectral_radius, 1.0);
        EXPECT_LT(loop->worst_pole_1ps, 0.0);
        EXPECT_LE(loop->series_error.back(), sdre::series_error_limit);
    }
}

TEST(Conventional, WrongKeysAreRefusedInOneLine)
{
    const TempDir dir;
    const auto    message = [&](const DriveText &text) -> std::string {
        try {
            sdre::read_drive_file(dir.write("d.toml", text.str()));
        } catch (const sdre::InputError &e) {
            return e.what();
        }
        return "accepted";
    };
    const auto refused = [&](const DriveText &text, const std::string &piece) {
        const std::string what = message(text);
        EXPECT_NE(what.find(piece), std::string::npos) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos);
    };
    DriveText ok = drive_text("load", 4);
    EXPECT_EQ(message(ok), "accepted");
    refused(drive_text("wind", 2), "must be \"load\" or \"all\"");
    refused(drive_text("load", 5), "order");
    refused(drive_text("load", 2).set("nodo", "form", "\"speed\""), "form");
    refused(drive_text("load", 2).set("nodo", "Q", "[1.0, 2.0]"), "Q");
    refused(drive_text("load", 2).erase("nodo", "disturbances"), "disturbances");
}

TEST(Conventional, OrdersBeyondTheTableAreRefused)
{
    sdre::Drive d = drive("load", 2);
    d.nodo.order  = 5;
    EXPECT_THROW(sdre::design_drive(d), sdre::InputError);
}

TEST(Conventional, GeneratedTablesMatchTheirDriveFileAndNoOther)
{
    const TempDir dir;
    const auto    text = [](const char *disturbances) {
        return drive_text(disturbances, 2).str() + "\n[board]\nname = \"board_390w\"\n";
    };
    const std::string file  = dir.write("d.toml", text("load"));
    const std::string other = dir.write("e.toml", text("all"));
    const auto        gains = [&](const std::string &drive, const char *option) {
        return support::run_command(
                          {SDRE_GAINS_EXE, "generate", drive, option, dir / "t", "--uncertified"})
            .exit_code;
    };
    EXPECT_EQ(gains(file, "--out"), 0);
    EXPECT_EQ(gains(file, "--check"), 0);
    EXPECT_EQ(gains(other, "--check"), 3);
}
