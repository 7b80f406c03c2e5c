// SPDX-License-Identifier: MIT
/// noc_iron's table and loop, against the map, the loop of noc and the control core in time.
#include "design/noc_iron/iron_loop.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/noc_iron/iron_design.hpp"
#include "iron.hpp"
#include "load_response.hpp"
#include "shipped_drive.hpp"
#include "temp_dir.hpp"

namespace {

sdre::Drive shipped_with(const std::string &from, const std::string &to)
{
    const auto        file = support::shipped_drive("ipmsm_390w_iron");
    std::string       text = support::read_file(file);
    const std::size_t at   = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return sdre::read_drive_text(text, "drive.toml", file.string());
}

const sdre::Design &shipped()
{
    static const sdre::Design d =
        sdre::design_drive(sdre::read_drive_file(support::shipped_drive("ipmsm_390w_iron")));
    return d;
}

const iron_map_t &table(const sdre::Design &d)
{
    return sdre::constants_of<law_noc_iron_config_t>(d.config)->iron;
}

sdre::Drive with_law(sdre::Drive drive, sdre::Law law)
{
    drive.law = law;
    return drive;
}

std::string error_of(const std::string &from, const std::string &to)
{
    try {
        shipped_with(from, to);
    } catch (const sdre::InputError &e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST(IronDesign, TableIsTheMap)
{
    EXPECT_LT(sdre::iron_table_error(shipped().drive, table(shipped())), 3e-3);
    EXPECT_GT(sdre::iron_table_error(shipped().drive, table(shipped())), 1e-5);
    const double max_A = shipped().drive.motor.max_current_A;
    for (int i = 0; i < IRON_NODES_D; i++) {
        for (int j = 0; j < IRON_NODES_Q; j++) {
            const auto   f = shipped().drive.saturation->at(-max_A * i / (IRON_NODES_D - 1),
                                                            max_A * j / (IRON_NODES_Q - 1));
            const float *n = table(shipped()).node[i][j];
            EXPECT_NEAR(static_cast<double>(n[IRON_PSI_D]), f.d_Wb, 1e-7);
            EXPECT_NEAR(static_cast<double>(n[IRON_PSI_Q]), f.q_Wb, 1e-7);
            EXPECT_NEAR(static_cast<double>(n[IRON_LD]), f.dd_H, 1e-8);
            EXPECT_NEAR(static_cast<double>(n[IRON_LQ]), f.qq_H, 1e-8);
            EXPECT_NEAR(static_cast<double>(n[IRON_LDQ]), 0.5 * (f.dq_H + f.qd_H), 1e-8);
        }
    }
}

/// Constant inductances in a map: the loop is that of noc, with moving references.
TEST(IronDesign, LoopOfConstantInductancesIsThatOfNoc)
{
    support::Iron linear;
    linear.b          = 0.0;
    sdre::Drive drive = support::saturated_drive(linear);
    drive.position.reset();
    const sdre::Design iron  = sdre::design_drive(with_law(drive, sdre::Law::noc_iron));
    const sdre::Design plain = sdre::design_drive(drive);
    const double       ts    = sdre::control_period_s(drive);
    const auto        &refs  = *sdre::current_references(plain);
    const auto         id    = sdre::id_reference(plain, refs);
    const auto         motor = sdre::true_motor(drive, drive.motor);
    for (const double w : {0.0, 300.0, 900.0}) {
        for (const double share : {0.0, 0.9, -0.9}) {
            const auto at = sdre::loaded_point(id, motor, plain.l, w, share);
            for (const Eigen::MatrixXd &Lambda : sdre::feedback_gains(plain)) {
                const auto moving =
                    sdre::moving_reference(id, plain.l, Lambda, sdre::state_at(motor, plain.l, at));
                const auto gains = sdre::encoder_form_gains(plain, at.iq_A, Lambda);
                const auto a     = sdre::sampled_iron_model(iron, motor, at, gains, &moving);
                const auto b     = sdre::sampled_model(motor, plain.l, gains, at, ts, &moving);
                EXPECT_LT((a.A - b.A).norm(), 1e-5 * b.A.norm()) << w << " " << share;
                EXPECT_LT((a.C_voltage - b.C_voltage).norm(), 1e-5 * b.C_voltage.norm());
            }
        }
    }
}

/// The oracle is the firmware on a plant with the map: a small step of the load at five points, four of them saturated.
TEST(IronDesign, SmallLoadStepIsThatOfTheNonlinearLoop)
{
    constexpr double   step_Nm = 0.02;
    sdre::MotorEffects effects;
    effects.flux     = sdre::saturated_motor(shipped().drive, shipped().drive.motor);
    const auto motor = sdre::true_motor(shipped().drive, shipped().drive.motor);
    const auto id    = sdre::id_reference(shipped(), *sdre::current_references(shipped()));
    struct Case {
        double omega, load_Nm;
    };
    for (const Case c :
         {Case{300.0, 0.1}, {300.0, 1.6}, {300.0, -1.6}, {100.0, 2.0}, {800.0, 0.6}}) {
        const support::StepResponse found =
            support::nonlinear_step(shipped(), c.omega, c.load_Nm, step_Nm, 0.3, effects);
        const auto l      = sdre::believed_motor(shipped(), found.before);
        const auto r      = sdre::believed_reference(id, shipped().l, l);
        const auto moving = sdre::moving_reference(r, l, shipped().nosc.gain[0],
                                                   sdre::state_at(motor, l, found.before));
        const auto model  = sdre::sampled_iron_model(
             shipped(), motor, found.before,
             sdre::encoder_form_gains(shipped(), found.before.iq_A, shipped().nosc.gain[0]),
             &moving);
        const std::vector<double> expected = support::linear_step(model, step_Nm);
        const double              dip      = -*std::min_element(expected.begin(), expected.end());
        EXPECT_FALSE(found.limited) << c.omega;
        EXPECT_GT(dip, 0.0);
        for (std::size_t k = 0; k < expected.size(); k++) {
            ASSERT_NEAR(found.deviation_e_radps[k], expected[k], 0.15 * dip)
                << c.omega << " " << c.load_Nm << " period " << k;
        }
    }
}

TEST(IronDesign, MapIsCertifiedThatNocIsNotCertifiedWith)
{
    EXPECT_TRUE(shipped().certificate.passed());
    ASSERT_TRUE(shipped().certificate.loop);
    EXPECT_LT(shipped().certificate.loop->channels.at(0).worst.peak, 2.2);
    EXPECT_LT(shipped().certificate.loop->channels.at(1).worst.peak, 2.2);
    const sdre::Design plain = sdre::design_drive(with_law(shipped().drive, sdre::Law::noc));
    EXPECT_FALSE(plain.certificate.passed());
}

TEST(IronDesign, WhatTheLawCannotUseIsRefusedInOneLine)
{
    const std::string text = support::read_file(support::shipped_drive("ipmsm_390w_iron"));
    const std::size_t from = text.find("[saturation]");
    const std::string map  = text.substr(from, text.find("[inverter]") - from);
    EXPECT_EQ(error_of(map, ""),
              "drive.toml: [saturation] is missing: noc_iron is for a map of the iron");
    EXPECT_EQ(error_of("form = \"encoder\"\norder = 1", "form = \"encoder\"\norder = 0"),
              "drive.toml: [nodo] order = 0 is not allowed: must be 1 with noc_iron");
}
