// SPDX-License-Identifier: MIT
/// `tune` with an elastic coupling in the drive file.
#include "tune/tune.hpp"

#include <string>

#include <gtest/gtest.h>

#include "design/design.hpp"
#include "shipped_drive.hpp"
#include "temp_dir.hpp"
#include "tune/drive_text.hpp"
#include "tune/shaft_cases.hpp"

namespace {

const std::filesystem::path source = support::shipped_drive("ipmsm_390w");

std::string text_with(const std::string &mechanics)
{
    return support::read_file(source) + "\n[mechanics]\n" + mechanics;
}

/// The nominal case alone, for a short search.
sdre::TuneSpec nominal_spec()
{
    sdre::TuneSpec spec = sdre::read_tune_spec(std::filesystem::path(SDRE_SOURCE_DIR) /
                                               "firmware/config/specs/ipmsm_390w.toml");
    spec.cases.resize(1);
    return spec;
}

sdre::LoopGains gains_of(const sdre::Design &d)
{
    return {d.nosc.gain[0], d.nodo.gain[0]};
}

} // namespace

TEST(TuneShaft, FoundWeightsAreCertifiedWithEveryShaftAndWithPositions)
{
    const std::string text =
        text_with("coupling = \"elastic\"\nresonance_from_Hz = 80\nresonance_to_Hz = 220\n");
    const sdre::Drive own = sdre::read_drive_text(text, source);
    EXPECT_FALSE(sdre::design_drive(own).certificate.passed());

    const sdre::TuneSpec   spec = nominal_spec();
    const sdre::TuneResult r    = sdre::tune_drive(own, spec, [](int, double) {});
    const std::string      out  = sdre::with_sections(text, sdre::tuned_sections(r, spec));
    const sdre::Drive      back = sdre::read_drive_text(out, source);
    const sdre::Design     d    = sdre::design_drive(back);
    EXPECT_TRUE(d.certificate.passed());
    EXPECT_TRUE(d.certificate.loop->shaft->everywhere());
    ASSERT_TRUE(back.position);
    EXPECT_EQ(back.position->Q[1], back.nosc.Q[0]);
    EXPECT_EQ(back.position->Q[2], back.nosc.Q[1]);
    EXPECT_NE(out.find("# Behind an elastic shaft of "), std::string::npos);
    EXPECT_EQ(out.find("[position]"), out.rfind("[position]"));
    EXPECT_LE(r.cases[0].voltage_noise_V, 1.01 * spec.voltage_noise_V);
}

TEST(TuneShaft, SearchAndCertificateAgreeAboutTheShippedDrive)
{
    const std::filesystem::path file  = support::shipped_drive("ipmsm_390w_elastic");
    sdre::Drive                 drive = sdre::read_drive_file(file);
    drive.position.reset();
    const sdre::LoopGains gains = gains_of(sdre::design_drive(drive));
    EXPECT_LT(sdre::radius_with_shafts(drive, gains), 1.0);
    drive.mechanics.to_Hz = 400.0;
    EXPECT_GT(sdre::radius_with_shafts(drive, gains), 1.0);
    drive.mechanics = {};
    EXPECT_EQ(sdre::radius_with_shafts(drive, gains), 0.0);
}

/// The board settles 16 ms after a load step with 220 Hz, and 61 ms with 80 Hz (docs/theory/simulation.md).
TEST(TuneShaft, LoadStepOfAKnownShaftSettlesAsOnTheBoard)
{
    sdre::Drive drive = sdre::read_drive_file(support::shipped_drive("ipmsm_390w_elastic"));
    drive.position.reset();
    const sdre::LoopGains      gains = gains_of(sdre::design_drive(drive));
    const sdre::OperatingPoint at{300.0, 1.9, -0.4};
    for (const auto &[resonance_Hz, settled_s] : {std::pair{80.0, 0.061}, {220.0, 0.016}}) {
        drive.mechanics.coupling   = sdre::Coupling::known;
        drive.mechanics.from_Hz    = resonance_Hz;
        drive.mechanics.to_Hz      = 1.001 * resonance_Hz;
        const sdre::ShaftStep step = sdre::shaft_step(drive, nominal_spec(), gains, at);
        EXPECT_NEAR(step.settling_time_s, settled_s, 0.2 * settled_s) << resonance_Hz;
    }
}
