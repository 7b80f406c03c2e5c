// SPDX-License-Identifier: MIT
/// The range of inertias that law noc may believe.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "design/laws/noc_inertia.hpp"
#include "drive/drive_file.hpp"
#include "shipped_drive.hpp"

using namespace sdre;

namespace {

Design design(const char *drive, Precision precision)
{
    return design_drive(read_drive_file(support::shipped_drive(drive)), precision);
}

law_noc_inertia_t range_of(const Design &d)
{
    return constants_of<law_noc_config_t>(d.config)->inertia;
}

} // namespace

TEST(NocInertia, RangeEndsBeforeTheFirstNodeThatDoesNotHold)
{
    struct Case {
        std::vector<double> wrong;
        float               least, most;
    };
    for (const Case &c :
         {Case{{}, 0.5F, 5.0F}, Case{{0.5}, 0.6F, 5.0F}, Case{{0.7, 1.4}, 1.0F, 1.0F},
          Case{{0.6, 2.8}, 0.7F, 2.0F}, // 0.5 and 5 hold, and do not count
          Case{{5.0}, 0.5F, 4.0F}}) {
        const law_noc_inertia_t range = outermost([&](double ratio) {
            return std::find(c.wrong.begin(), c.wrong.end(), ratio) == c.wrong.end();
        });
        EXPECT_EQ(range.least, c.least);
        EXPECT_EQ(range.most, c.most);
    }
}

/// The gains that are judged are those that the firmware makes.
TEST(NocInertia, DesignHasTheGainsOfTheFirmware)
{
    const Design own = design("ipmsm_390w", Precision::quick);
    for (const double k : {0.5, 0.8, 2.0, 5.0}) {
        law_noc_config_t c{};
        const Design     d = with_inertia(own, k, c);
        EXPECT_EQ(d.config.constants, &c);
        const auto near = [](double a, float b) {
            EXPECT_NEAR(a, static_cast<double>(b), 1e-6 * std::abs(a));
        };
        near(d.l[1], d.config.motor.l1);
        near(d.l[2], d.config.motor.l2);
        near(d.l[3], d.config.motor.l3);
        near(d.l[11], d.config.motor.l11);
        for (std::size_t n = 0; n < d.nosc.gain.size(); n++) {
            for (int u = 0; u < 2; u++) {
                for (int e = 0; e < 3; e++) {
                    near(d.nosc.gain[n](u, e), c.near_optimal.nosc.lambda[n][u][e]);
                }
            }
        }
        for (std::size_t n = 0; n < d.nodo.gain.size(); n++) {
            for (int x = 0; x < NODO_ENCODER_N_X; x++) {
                for (int y = 0; y < NODO_ENCODER_N_Y; y++) {
                    near(d.nodo.gain[n](x, y), c.nodo.gain[n][x][y]);
                }
            }
        }
        near(d.nosc.gain[0](0, 0) / d.nosc.gain[0](0, 1), c.near_optimal.nosc.speed_A_per_radps);
        const double power = static_cast<double>(
            constants_of<law_noc_config_t>(own.config)->near_optimal.current_ref.regen_max_W_norm);
        near(power / k, c.near_optimal.current_ref.regen_max_W_norm);
        EXPECT_FALSE(d.position.has_value());
        EXPECT_TRUE(d.certificate.failures.empty());
    }
}

TEST(NocInertia, ShippedDrivesHaveTheirRange)
{
    struct Case {
        const char *drive;
        float       least, most;
    };
    for (const Case &c : {Case{"ipmsm_390w", 0.6F, 5.0F}, Case{"ipmsm_390w_10khz", 0.7F, 5.0F},
                          Case{"ipmsm_390w_elastic", 0.5F, 5.0F}}) {
        const law_noc_inertia_t range = range_of(design(c.drive, Precision::extended));
        EXPECT_EQ(range.least, c.least) << c.drive;
        EXPECT_EQ(range.most, c.most) << c.drive;
    }
    const law_noc_inertia_t quick = range_of(design("ipmsm_390w", Precision::quick));
    EXPECT_EQ(quick.least, 1.0F);
    EXPECT_EQ(quick.most, 1.0F);
}

/// With the gains of the drive's own inertia the loop of the true one does not hold everywhere: the condition is not empty.
TEST(NocInertia, GainsThatAreNotScaledDoNotHold)
{
    const Design     own = design("ipmsm_390w", Precision::quick);
    law_noc_config_t c{};
    Design           d = with_inertia(own, 5.0, c);
    certify(d);
    EXPECT_TRUE(d.certificate.passed());
    d.nosc.gain[0].col(0) *= 25.0; // as by k squared
    certify(d);
    EXPECT_FALSE(d.certificate.passed());
}

TEST(NocInertia, DesignThatIsNotCertifiedHasNone)
{
    Drive drive = read_drive_file(support::shipped_drive("ipmsm_390w"));
    drive.nosc.T[0] /= 1e4; // far too fast for the period
    const Design d = design_drive(drive, Precision::extended);
    ASSERT_FALSE(d.certificate.passed());
    EXPECT_EQ(range_of(d).least, 1.0F);
    EXPECT_EQ(range_of(d).most, 1.0F);
}

TEST(NocInertia, LineOfTheTableSaysTheRange)
{
    EXPECT_EQ(inertia_line({1.0F, 1.0F}), "");
    EXPECT_NE(inertia_line({0.6F, 5.0F}).find("x0.6 .. x5"), std::string::npos);
}
