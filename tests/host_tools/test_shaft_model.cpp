// SPDX-License-Identifier: MIT
#include "design/shaft_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/verdict.hpp"
#include "linalg/expm.hpp"
#include "load_response.hpp"
#include "shipped_drive.hpp"
#include "sil/setup/board_reader.hpp"
#include "temp_dir.hpp"

namespace {

using Eigen::MatrixXd;

sdre::Drive with(const std::string &mechanics, const std::string &name = "ipmsm_390w")
{
    std::string       text = support::read_file(support::shipped_drive(name));
    const std::size_t own  = text.find("[mechanics]");
    if (own != std::string::npos) {
        text.erase(own, text.find("\n[", own) + 1 - own);
    }
    return sdre::read_drive_text(text + "\n[mechanics]\n" + mechanics,
                                 support::shipped_drive(name));
}

std::string error_of(const std::string &mechanics)
{
    try {
        with(mechanics);
    } catch (const sdre::InputError &e) {
        return e.what();
    }
    return "";
}

std::string known(const std::string &resonance_Hz)
{
    return "resonance_Hz = " + resonance_Hz + "\ndamping = 0.02\nload_inertia_share = 0.5\n";
}

/// The quick load estimate of the shipped drive for couplings, without positions.
sdre::Design speed_drive(const std::string &resonance_Hz)
{
    sdre::Drive d = with(known(resonance_Hz), "ipmsm_390w_elastic");
    d.position.reset();
    return sdre::design_drive(d);
}

sdre::Shaft shaft_of(const sdre::Design &d)
{
    const sdre::Mechanics &m = d.drive.mechanics;
    return {m.resonance_Hz, m.least_damping, m.load_inertia_share};
}

} // namespace

/// The oracle: both masses in SI units with a stiffness and a damping, mechanical speeds.
TEST(ShaftModel, PlantIsTwoMassesInSiUnits)
{
    const sdre::Drive          d  = sdre::read_drive_file(support::shipped_drive("ipmsm_390w"));
    const sdre::Motor         &m  = d.motor;
    const double               ts = sdre::control_period_s(d);
    const double               np = m.pole_pairs;
    const double               Ld = m.d_axis_inductance_H;
    const double               Lq = m.q_axis_inductance_H;
    const sdre::Shaft          shaft{220.0, 0.02, 0.3};
    const sdre::OperatingPoint at{300.0, 1.2, -0.3};

    const double Jl      = 0.3 * m.inertia_kgm2;
    const double Jm      = 0.7 * m.inertia_kgm2;
    const double reduced = Jm * Jl / (Jm + Jl);
    const double w_r     = 2.0 * 3.14159265358979 * 220.0;
    const double K       = w_r * w_r * reduced;
    const double D       = 2.0 * 0.02 * w_r * reduced;
    MatrixXd     A       = MatrixXd::Zero(7, 7); // w_m iq id theta_e w_load twist | load torque
    A.row(0) << -(m.viscous_friction_Nms + D) / Jm,
        1.5 * np * (m.pm_flux_Wb + (Ld - Lq) * at.id_A) / Jm, 1.5 * np * (Ld - Lq) * at.iq_A / Jm,
        0.0, D / Jm, -K / Jm, 0.0;
    A.row(1) << -np * (m.pm_flux_Wb + Ld * at.id_A) / Lq, -m.stator_resistance_Ohm / Lq,
        -Ld * at.omega_e_radps / Lq, 0.0, 0.0, 0.0, 0.0;
    A.row(2) << np * Lq * at.iq_A / Ld, Lq * at.omega_e_radps / Ld, -m.stator_resistance_Ohm / Ld,
        0.0, 0.0, 0.0, 0.0;
    A(3, 0) = np;
    A.row(4) << D / Jl, 0.0, 0.0, 0.0, -D / Jl, K / Jl, -1.0 / Jl;
    A(5, 0)                = 1.0;
    A(5, 4)                = -1.0;
    MatrixXd to_electrical = MatrixXd::Identity(7, 7);
    to_electrical(0, 0) = to_electrical(4, 4) = to_electrical(5, 5) = np;
    const MatrixXd expected =
        to_electrical * sdre::exponential(MatrixXd(ts * A)) * to_electrical.inverse();
    const sdre::HeldPlant found = held_with_shaft(sdre::reduced_parameters(m), at, ts, shaft);
    const auto            near  = [&](double x, int row, int column) {
        EXPECT_NEAR(x, expected(row, column), 1e-9 * (1.0 + std::abs(expected(row, column))))
            << row << " " << column;
    };
    ASSERT_EQ(found.held.Phi.rows(), 6);
    for (int row = 0; row < 6; row++) {
        for (int column = 0; column < 6; column++) {
            near(found.held.Phi(row, column), row, column);
        }
        near(found.held.Gamma(row, 2), row, 6);
    }
}

/// A load of hardly any inertia: the loop of one mass (EQ-CERT-6) and an oscillation beside it.
TEST(ShaftModel, HardlyAnyLoadIsTheRigidLoop)
{
    const sdre::Design          d = speed_drive("220");
    const sdre::TwoMasses       masses(d);
    const sdre::OperatingPoint  at    = masses.point(300.0, 0.0);
    const sdre::LoopGains       gains = sdre::encoder_form_gains(d, at.iq_A, d.nosc.gain[0]);
    const sdre::IdReference     id    = id_reference(d, *sdre::current_references(d));
    const sdre::MovingReference moving =
        moving_reference(id, d.l, gains.Lambda, state_at(d.l, d.l, at));
    const MatrixXd rigid =
        sampled_model(d.l, d.l, gains, at, sdre::control_period_s(d.drive), &moving).A;
    const auto all = sdre::eigenvalues(masses.loop({300.0, 0.3, 1e-7}, at, gains).A);
    for (const auto &pole : sdre::eigenvalues(rigid)) {
        EXPECT_LT((all.array() - pole).abs().minCoeff(), 1e-4) << pole;
    }
}

/// The oracle: the control core on a motor with this shaft, in time.
TEST(ShaftModel, SmallLoadStepIsThatOfTheControlCore)
{
    for (const char *resonance_Hz : {"90", "220"}) {
        const sdre::Design          d = speed_drive(resonance_Hz);
        const support::StepResponse found =
            support::nonlinear_step(d, 300.0, 0.75, 0.05, 0.3, effects_of_drive(d.drive));
        ASSERT_FALSE(found.limited);
        const sdre::TwoMasses masses(d);
        const sdre::LoopGains gains =
            sdre::encoder_form_gains(d, found.before.iq_A, d.nosc.gain[0]);
        const std::vector<double> expected =
            support::linear_step(masses.loop(shaft_of(d), found.before, gains), 0.05);
        double dip = 0.0;
        for (const double x : expected) {
            dip = std::max(dip, std::abs(x));
        }
        for (std::size_t k = 0; k < expected.size(); k++) {
            EXPECT_NEAR(found.deviation_e_radps[k], expected[k], 0.08 * dip)
                << resonance_Hz << " " << k;
        }
    }
}

/// The control core decides too: what the certificate takes for stable comes to rest, and what it refuses oscillates.
TEST(ShaftModel, VerdictIsWhatTheControlCoreDoes)
{
    for (const char *resonance_Hz : {"90", "220", "300", "350", "420"}) {
        const sdre::Design d = speed_drive(resonance_Hz);
        support::Loop      loop(d, 260.0, 0.3, effects_of_drive(d.drive));
        double             largest = 0.0;
        bool               tripped = false;
        for (int k = 0; k < 3000 && !tripped; k++) {
            tripped = !loop.tick(1.4);
            if (k >= 2900) {
                largest = std::max(largest, std::abs(loop.plant().omega_e_radps() - 260.0));
            }
        }
        const bool certified = d.certificate.loop->shaft->everywhere();
        EXPECT_EQ(certified, !tripped && largest < 0.05) << resonance_Hz << " Hz: " << largest;
        EXPECT_EQ(certified, std::stod(resonance_Hz) <= 300.0) << resonance_Hz;
    }
}

TEST(ShaftModel, CouplingThatNobodyHasMeasuredHasToBeStableEverywhere)
{
    const sdre::Design d =
        sdre::design_drive(with("coupling = \"elastic\"\n", "ipmsm_390w_elastic"));
    ASSERT_TRUE(d.certificate.loop->shaft);
    const sdre::ShaftVerdict &v = *d.certificate.loop->shaft;
    EXPECT_EQ(v.mechanics.from_Hz, 40.0);
    EXPECT_EQ(v.mechanics.to_Hz, 600.0);
    EXPECT_EQ(v.mechanics.least_damping, 0.02);
    ASSERT_EQ(d.certificate.failures.size(), 1U);
    const std::string why = d.certificate.failures[0];
    EXPECT_NE(why.find("elastic shaft: unstable with a resonance of 5"), std::string::npos) << why;
    EXPECT_NE(why.find(" .. 296 Hz of 40 .. 600 Hz, damping ratio 0.02 .. 0.1, 0.5 of the inertia"),
              std::string::npos)
        << why;
    EXPECT_TRUE(sdre::design_drive(with("coupling = \"elastic\"\nresonance_from_Hz = 60\n"
                                        "resonance_to_Hz = 290\n",
                                        "ipmsm_390w_elastic"))
                    .certificate.passed());
}

TEST(ShaftModel, MoreDampingIsNoHarderCase)
{
    const std::string rest =
        "coupling = \"elastic\"\nresonance_from_Hz = 60\nresonance_to_Hz = 400\n";
    const auto radius = [&](const std::string &damping) {
        const sdre::Design d = sdre::design_drive(with(rest + damping, "ipmsm_390w_elastic"));
        return d.certificate.loop->shaft->radius;
    };
    EXPECT_GT(radius("damping = 0.01\n"), radius("damping = 0.02\n"));
    EXPECT_GT(radius("damping = 0.02\n"), radius("damping = 0.06\n"));
}

TEST(ShaftModel, KnownCouplingHasToBeStableNearItsResonance)
{
    const sdre::Design good = speed_drive("220");
    EXPECT_TRUE(good.certificate.passed());
    EXPECT_EQ(good.certificate.loop->shaft->mechanics.to_Hz, 231.0);
    const sdre::Design bad = speed_drive("400");
    ASSERT_EQ(bad.certificate.failures.size(), 1U);
    EXPECT_NE(bad.certificate.failures[0].find("stable with none of 380 .. 420 Hz"),
              std::string::npos)
        << bad.certificate.failures[0];
}

TEST(ShaftModel, RigidCouplingHasNoShaftAndNoTableDependsOnIt)
{
    EXPECT_FALSE(sdre::design_drive(with("coupling = \"rigid\"\n")).certificate.loop->shaft);
    EXPECT_TRUE(shafts_of(sdre::Mechanics{}, 1.1).empty());
    EXPECT_EQ(sdre::drive_digest(with("coupling = \"elastic\"\n")),
              sdre::drive_digest(with("coupling = \"rigid\"\n")));
}

TEST(ShaftModel, WrongMechanicsAreRefusedByTheirKey)
{
    const auto says = [](const std::string &mechanics, const std::string &what) {
        const std::string e = error_of(mechanics);
        EXPECT_NE(e.find(what), std::string::npos) << mechanics << e;
    };
    says("coupling = \"soft\"\n", "must be \"rigid\" or \"elastic\"");
    says("resonance_Hz = 220\nload_inertia_share = 0.5\n", "damping");
    says("coupling = \"rigid\"\ndamping = 0.1\n", "damping");
    says("coupling = \"elastic\"\ndamping = 0.0\n", "damping");
    says("coupling = \"elastic\"\nresonance_to_Hz = 40\n", "must be above resonance_from_Hz = 40");
}
