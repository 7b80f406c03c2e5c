// SPDX-License-Identifier: MIT
#include "sil/plant/dc_link.hpp"

#include <cmath>

#include <gtest/gtest.h>

using namespace sdre;

namespace {

InverterSettings link_with(Regeneration regeneration, double resistance_Ohm, double capacitance_F)
{
    InverterSettings s;
    s.regeneration          = regeneration;
    s.source_resistance_Ohm = resistance_Ohm;
    s.capacitance_F         = capacitance_F;
    return s;
}

} // namespace

TEST(DcLink, DefaultIsStiff)
{
    DcLink link({}, 295.0);
    link.advance(50.0, 1.0);
    link.advance(-50.0, 1.0);
    EXPECT_DOUBLE_EQ(link.voltage_V(), 295.0);
    EXPECT_TRUE(link.stiff());
}

TEST(DcLink, SourceResistanceDropsInSteadyState)
{
    DcLink link(link_with(Regeneration::sinks, 2.0, 1e-3), 300.0);
    link.advance(5.0, 1.0);
    EXPECT_NEAR(link.voltage_V(), 290.0, 1e-9);
    link.advance(-5.0, 1.0);
    EXPECT_NEAR(link.voltage_V(), 310.0, 1e-9);
}

TEST(DcLink, ExponentialIsExactForAnyStep)
{
    DcLink coarse(link_with(Regeneration::sinks, 2.0, 1e-3), 300.0);
    DcLink fine(link_with(Regeneration::sinks, 2.0, 1e-3), 300.0);
    coarse.advance(5.0, 1e-3);
    for (int k = 0; k < 1000; k++) {
        fine.advance(5.0, 1e-6);
    }
    EXPECT_NEAR(coarse.voltage_V(), 290.0 + 10.0 * std::exp(-0.5), 1e-9);
    EXPECT_NEAR(fine.voltage_V(), coarse.voltage_V(), 1e-9);
}

TEST(DcLink, BlockedRegenerationChargesTheCapacitor)
{
    for (double resistance_Ohm : {0.0, 0.5}) {
        DcLink link(link_with(Regeneration::blocks, resistance_Ohm, 470e-6), 295.0);
        link.advance(-2.0, 0.01);
        EXPECT_NEAR(link.voltage_V(), 295.0 + 2.0 * 0.01 / 470e-6, 1e-9); // charge
        link.advance(2.0, 0.01);
        EXPECT_NEAR(link.voltage_V(), 295.0, 1e-9);
    }
}

TEST(DcLink, RectifierTakesOverAgainAtTheSourceVoltage)
{
    DcLink link(link_with(Regeneration::blocks, 1.0, 1e-3), 300.0);
    link.advance(-10.0, 1e-3); // up by 10 V
    ASSERT_NEAR(link.voltage_V(), 310.0, 1e-9);
    link.advance(10.0, 2e-3); // 1 ms down to 300 V, then towards 290 V
    EXPECT_NEAR(link.voltage_V(), 290.0 + 10.0 * std::exp(-1.0), 1e-9);
    link.advance(-10.0, 10e-3); // up through 300 V: exponential below, straight above
    const double on_s = 1e-3 * std::log((310.0 - (290.0 + 10.0 * std::exp(-1.0))) / 10.0);
    EXPECT_NEAR(link.voltage_V(), 300.0 + 1e4 * (10e-3 - on_s), 1e-9);
}

TEST(DcLink, SourceStepChargesThroughTheResistance)
{
    const InverterSettings s = link_with(Regeneration::sinks, 1.0, 1e-3);
    DcLink                 link(s, 300.0);
    link.configure(s, 250.0);
    EXPECT_DOUBLE_EQ(link.voltage_V(), 300.0);
    link.advance(0.0, 1e-3);
    EXPECT_NEAR(link.voltage_V(), 250.0 + 50.0 * std::exp(-1.0), 1e-9);
}
