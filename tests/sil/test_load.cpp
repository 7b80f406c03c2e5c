// SPDX-License-Identifier: MIT
#include "sil/plant/load.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "sil/setup/scenario.hpp"

using namespace sdre;

TEST(Load, StepsMatchTheLookup)
{
    const std::vector<Step> steps{{0.0, 0.75}, {0.4, 1.5}, {0.5, -1.0}};
    LoadProfile             load(steps, {}, {});
    for (int k = 0; k < 4000; k++) {
        const double t = 2e-4 * k;
        ASSERT_DOUBLE_EQ(load.at(t, 1e-4), value_at(steps, t, 0.0));
    }
}

TEST(Load, NothingBeforeTheFirstStep)
{
    LoadProfile load({{0.1, 2.0}}, {}, {});
    EXPECT_DOUBLE_EQ(load.at(0.0999, 1e-4), 0.0);
    EXPECT_DOUBLE_EQ(load.at(0.1, 1e-4), 2.0);
}

TEST(Load, RampIsAStraightLineFromWhatWas)
{
    LoadProfile load({{0.0, 0.5}, {0.4, -1.0}}, {{0.1, 0.2, 1.5}, {0.5, 0.6, 0.0}}, {});
    EXPECT_DOUBLE_EQ(load.at(0.05, 0.0), 0.5);
    EXPECT_NEAR(load.at(0.125, 0.0), 0.75, 1e-12);
    EXPECT_NEAR(load.at(0.15, 0.025), 1.25, 1e-12);
    EXPECT_DOUBLE_EQ(load.at(0.3, 0.0), 1.5);
    EXPECT_DOUBLE_EQ(load.at(0.45, 0.0), -1.0);
    EXPECT_NEAR(load.at(0.55, 0.0), -0.5, 1e-12);
    EXPECT_DOUBLE_EQ(load.at(0.9, 0.0), 0.0);
}

TEST(Load, BackToBackRamps)
{
    LoadProfile load({}, {{0.0, 0.1, 1.0}, {0.1, 0.2, 0.0}}, {});
    EXPECT_NEAR(load.at(0.05, 0.0), 0.5, 1e-12);
    EXPECT_NEAR(load.at(0.15, 0.0), 0.5, 1e-12);
}

TEST(Load, SineStartsAtItsTimeAndCanBeSwitched)
{
    LoadProfile load({{0.0, 1.0}}, {}, {0.5, 25.0, 0.1});
    EXPECT_DOUBLE_EQ(load.at(0.05, 0.0), 1.0);
    EXPECT_NEAR(load.at(0.11, 0.0), 1.5, 1e-12); // a quarter of 40 ms after the start
    EXPECT_NEAR(load.at(0.13, 0.0), 0.5, 1e-12);
    load.set_sine({});
    EXPECT_DOUBLE_EQ(load.at(0.15, 0.0), 1.0);
}
