// SPDX-License-Identifier: MIT
#include "emit/report.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "emit/report_loops.hpp"
#include "linalg/eigenvalues.hpp"
#include "reference_gains.hpp"

namespace {

using support::Json;

constexpr double gain_tolerance_0 = 1e-9; // asked for; measured 1e-12
constexpr double gain_tolerance_n = 1e-7; // asked for; measured 1e-12

const sdre::Design &certified()
{
    static const sdre::Design design = [] {
        sdre::Drive drive = sdre::read_drive_file(support::shipped_drive("ipmsm_390w_speed"));
        drive.nosc.T      = {1.2e-3, 1.2e-3};
        std::fill_n(drive.nodo.Q.begin(), 3, 1e7);
        drive.reproduces.clear();
        return sdre::design_drive(drive);
    }();
    return design;
}

const sdre::Design &refused()
{
    static const sdre::Design design = [] {
        sdre::Drive drive               = certified().drive;
        drive.inverter.pwm_frequency_Hz = 1000.0;
        return sdre::design_drive(drive);
    }();
    return design;
}

Json report_of(const sdre::Design &design)
{
    return Json::parse(sdre::report_json(design));
}

bool contains(const std::string &text, const std::string &piece)
{
    return text.find(piece) != std::string::npos;
}

} // namespace

TEST(Report, GainsInJsonEqualTheReference)
{
    const Json cases = support::reference_gains();
    for (const auto &[name, reference] : cases.items()) {
        const Json r = report_of(sdre::design_drive(support::drive_of(name, reference)));

        const std::vector<std::tuple<const char *, const char *, const char *>> series{
            {"nosc", "lambda", "lambda_"},
            {"nosc", "gamma", "gamma"},
            {"nodo", "gain", "L"},
            {"nodo", "pi", "pi"}};
        for (const auto &[loop, key, reference_key] : series) {
            const Json &found = r.at(loop).at(key);
            ASSERT_EQ(found.size(), 4U) << name << " " << key;
            const double scale = support::matrix_of(found[0]).norm();
            for (std::size_t n = 0; n < 4; n++) {
                Eigen::MatrixXd expected = support::matrix_of(reference.at(reference_key)[n]);
                if (std::string(key) == "gain") {
                    expected = expected.rightCols(3).eval(); // the measured ones act
                }
                const Eigen::MatrixXd M = support::matrix_of(found[n]);
                ASSERT_EQ(M.rows(), expected.rows());
                ASSERT_EQ(M.cols(), expected.cols());
                EXPECT_LT(support::relative_error(M, expected, scale),
                          n == 0 ? gain_tolerance_0 : gain_tolerance_n)
                    << name << " " << key << " " << n;
            }
        }
        for (std::size_t i = 1; i <= 11; i++) {
            const double l        = r.at("reduced_parameters").at("l" + std::to_string(i)).number();
            const double expected = reference.at("l")[i - 1].number();
            EXPECT_NEAR(l, expected, 1e-14 * std::abs(expected)) << name << " l" << i;
        }
    }
}

TEST(Report, JsonHasEveryKeyInItsShape)
{
    const Json r = report_of(certified());

    EXPECT_EQ(r.at("drive"), "ipmsm_390w_speed");
    EXPECT_EQ(r.at("digest"), sdre::drive_digest(certified().drive));
    EXPECT_EQ(r.at("control_period_s"), 2e-4);
    EXPECT_EQ(r.at("reduced_parameters").size(), 11U);
    EXPECT_EQ(r.at("nosc").at("order"), 2);
    EXPECT_EQ(r.at("nosc").at("closed_loop_eigenvalues").size(), 3U);
    EXPECT_EQ(r.at("nosc").at("closed_loop_eigenvalues")[0].size(), 2U);
    EXPECT_EQ(r.at("nosc").at("residuals").size(), 3U);
    EXPECT_EQ(r.at("nodo").at("order"), 2);
    EXPECT_EQ(r.at("nodo").at("eigenvalues").size(), 6U);
    EXPECT_EQ(r.at("nodo").at("residuals").size(), 3U);
    const Json &c = r.at("certificate");
    EXPECT_EQ(c.at("certified"), true);
    EXPECT_EQ(c.at("failures"), Json::array());
    EXPECT_EQ(c.at("range").at("e_iq_A"), Json(std::vector<double>{-8.0, 8.0}));
    EXPECT_EQ(c.at("range").at("i_q_hat_A"), Json(std::vector<double>{-8.0, 8.0}));
    for (const std::string loop : {"nosc", "nodo"}) {
        EXPECT_EQ(c.at("series_error").at(loop).size(), 3U); // orders 0 .. order
        EXPECT_LT(c.at("worst_pole").at(loop + "_1ps").number(), 0.0);
    }
}

TEST(Report, JsonCarriesTheCertificate)
{
    const Json               r = report_of(certified());
    const sdre::Certificate &c = certified().certificate;
    for (const auto &[name, loop, variable] :
         {std::tuple{"nosc", &c.nosc, "e_iq"}, std::tuple{"nodo", &c.nodo, "i_q_hat"}}) {
        const Json &j = r.at("certificate").at(name);
        EXPECT_EQ(j.at("range").at("variable"), variable);
        EXPECT_EQ(j.at("range").at("min_A"), -loop->range_A);
        EXPECT_EQ(j.at("range").at("max_A"), loop->range_A);
        EXPECT_EQ(j.at("series_range_A"), loop->series_range_A);
        EXPECT_EQ(j.at("worst_pole_1ps"), loop->worst_pole_1ps);
        EXPECT_EQ(j.at("fastest_pole_times_period"), loop->fastest_pole_ts);
        EXPECT_EQ(j.at("spectral_radius"), loop->spectral_radius);
        EXPECT_EQ(j.at("series_error"), Json(loop->series_error));
        EXPECT_EQ(j.at("series_error_full_range"), Json(loop->series_error_full));
        EXPECT_EQ(r.at("certificate").at("series_error").at(name), Json(loop->series_error));
        EXPECT_EQ(r.at("certificate").at("worst_pole").at(std::string(name) + "_1ps"),
                  loop->worst_pole_1ps);
    }
    EXPECT_EQ(r.at("nosc").at("residuals"), Json(certified().nosc.residuals));
    EXPECT_EQ(r.at("nodo").at("residuals"), Json(certified().nodo.residuals));
}

TEST(Report, JsonEigenvaluesAreRealAndImaginaryParts)
{
    const Json  r            = report_of(certified());
    const auto &poles        = certified().nodo.series.care.closed_loop_eigenvalues;
    bool        complex_pair = false;
    for (Eigen::Index i = 0; i < poles.size(); i++) {
        const Json &pole = r.at("nodo").at("eigenvalues")[static_cast<std::size_t>(i)];
        EXPECT_EQ(pole[0], poles(i).real());
        EXPECT_EQ(pole[1], poles(i).imag());
        complex_pair = complex_pair || poles(i).imag() != 0.0;
    }

    EXPECT_TRUE(complex_pair); // otherwise the second column proves nothing
}

TEST(Report, RefusedDriveIsStillAnswered)
{
    const Json r = report_of(refused());

    EXPECT_EQ(r.at("certificate").at("certified"), false);
    EXPECT_EQ(r.at("certificate").at("failures"), Json(refused().certificate.failures));
    EXPECT_FALSE(refused().certificate.failures.empty());
    EXPECT_EQ(r.at("nosc").at("lambda").size(), 3U);
}

TEST(Report, TextSaysTheVerdict)
{
    const std::string good = sdre::report_text(certified());
    const std::string bad  = sdre::report_text(refused());

    EXPECT_TRUE(contains(good, "\nverdict: certified\n"));
    EXPECT_FALSE(contains(good, "not certified"));
    EXPECT_TRUE(contains(bad, "\nverdict: not certified\n  " + refused().certificate.failures[0]));
    sdre::Design printed     = refused();
    printed.drive.reproduces = "paper A, Table 2";
    EXPECT_TRUE(contains(sdre::report_text(printed),
                         "\nverdict: not certified, faithful to paper A, Table 2\n"));
    EXPECT_TRUE(contains(bad, "control period 1000 us"));
}

TEST(Report, TextHasTheFiguresOfTheJson)
{
    const std::string text = sdre::report_text(
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w_speed"))));

    for (const char *piece :
         {"ipmsm_390w_speed (fnv1a64:", "control period 200 us", "  l1   2757.14286\n",
          "  l11  -556.142857\n", "Lambda_0", "Lambda_2", "L_0", "L_2", "44.5124", "187.167",
          "controller, e_iq in +-8 A", "observer, iq_hat in +-8 A", "series used in +-2.75 A",
          "order 0: gain error", "order 2: gain error"}) {
        EXPECT_TRUE(contains(text, piece)) << piece;
    }
    EXPECT_FALSE(contains(text, "Lambda_3"));
}

TEST(Report, RoundingNoiseIsZeroAsInTheTables)
{
    sdre::Design d       = certified();
    const double size    = d.nodo.gain[0].norm();
    d.nodo.gain[0](0, 0) = 1e-13 * size;
    d.nodo.gain[0](0, 1) = 1e-11 * size;
    d.nodo.gain[0](0, 2) = 0.5 * size;

    const support::Json row = report_of(d).at("nodo").at("gain").at(0).at(0);

    EXPECT_EQ(row.at(0), 0.0);
    EXPECT_EQ(row.at(1), d.nodo.gain[0](0, 1));
    EXPECT_EQ(row.at(2), d.nodo.gain[0](0, 2));
    EXPECT_TRUE(contains(sdre::report_text(d), "\n                 0 ")) << sdre::report_text(d);
}

TEST(Report, LoopsConsistOfTheirParts)
{
    sdre::Drive drive = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    drive.position.reset(); // the points are those of the speed's law
    const sdre::Design d       = sdre::design_drive(drive);
    const Json         written = Json::parse(sdre::loops_json(d));
    double             worst   = 0.0; // with a d-current reference that stands still
    for (const Json &point : written.at("points")) {
        const Eigen::MatrixXd A = support::matrix_of(point.at("A"));
        worst                   = std::max(worst, sdre::spectral_radius(A));
        const Eigen::MatrixXd P = support::matrix_of(point.at("P"));
        const Eigen::MatrixXd K = P * support::matrix_of(point.at("L_Ts"));
        Eigen::MatrixXd       controller =
            P + support::matrix_of(point.at("G")) * support::matrix_of(point.at("F"));
        controller.rightCols(3) -= K; // C of the encoder form is [0 I]
        EXPECT_LT((A.block(4, 4, 6, 6) - controller.topLeftCorner(6, 6)).norm(), 1e-9 * A.norm());
        EXPECT_LT((A.block(4, 1, 6, 3) - K.topRows(6)).norm(), 1e-9 * A.norm());
    }
    EXPECT_GT(worst, 0.8);
    EXPECT_LT(worst, d.certificate.loop->spectral_radius); // its reference moves, slowly
    EXPECT_EQ(written.at("box_points").size(), 2U);
    EXPECT_THROW(sdre::loops_json(certified()), sdre::InputError); // speed form
}

// The oracle of the bound is in test_torque.cpp.
TEST(Report, TorquesHaveTheirBoundInBothForms)
{
    const sdre::Design design =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w")));
    const Json        torque = report_of(design)["torque"];
    const std::string text   = sdre::report_text(design);
    EXPECT_GT(torque["iq_VpA"].number(), 0.0);
    EXPECT_GT(torque["id_VpA"].number(), 0.0);
    const Json &least = torque["least_time_of_rated_step"];
    ASSERT_EQ(least.size(), 3U);
    double before_s = 0.0;
    for (std::size_t k = 0; k < 3; k++) {
        const double time_s = least[k]["time_s"].number();
        EXPECT_DOUBLE_EQ(least[k]["speed_e_radps"].number(),
                         0.5 * static_cast<double>(k) * design.drive.motor.rated_speed_e_radps);
        EXPECT_GT(time_s, before_s);
        EXPECT_TRUE(contains(text, fmt::format("{:.2f} ms at ", 1e3 * time_s))) << text;
        before_s = time_s;
    }

    sdre::Drive low            = design.drive; // less than the resistance takes
    low.inverter.dc_link_V     = 3.0;
    const sdre::Design lowered = sdre::design_drive(low);
    const Json         out     = report_of(lowered)["torque"]["least_time_of_rated_step"];
    EXPECT_TRUE(out[0]["time_s"].is_null());
    EXPECT_TRUE(contains(sdre::report_text(lowered), "out of reach at rest"));

    EXPECT_THROW((void)report_of(certified()).at("torque"), std::exception);
    EXPECT_FALSE(contains(sdre::report_text(certified()), "\ntorque\n"));
}
