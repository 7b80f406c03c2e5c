// SPDX-License-Identifier: MIT
#include "sil/plant/dc_link.hpp"

#include <algorithm>
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

/// EQ-DC-LINK-3.
TEST(DcLink, RipplesAsItsSource)
{
    InverterSettings s = link_with(Regeneration::sinks, 0.0, 1e-3);
    s.ripple_V         = 30.0;
    s.ripple_Hz        = 250.0;
    DcLink link(s, 300.0);
    EXPECT_FALSE(link.stiff());
    EXPECT_DOUBLE_EQ(link.voltage_V(), 300.0);
    for (const double expected_V : {330.0, 300.0, 270.0, 300.0, 330.0}) { // quarter by quarter
        for (int k = 0; k < 10; k++) {
            link.advance(k % 2 == 0 ? 50.0 : -50.0, 1e-4); // any current
        }
        EXPECT_NEAR(link.voltage_V(), expected_V, 1e-9);
    }
    s.ripple_Hz = 500.0;
    link.configure(s, 200.0); // in flight: the sine goes on from where it is
    EXPECT_NEAR(link.voltage_V(), 230.0, 1e-9);
    link.advance(0.0, 1e-3);
    EXPECT_NEAR(link.voltage_V(), 170.0, 1e-9);
    s.ripple_V = 0.0;
    link.configure(s, 200.0);
    EXPECT_TRUE(link.stiff());
    EXPECT_DOUBLE_EQ(link.voltage_V(), 200.0);
}

TEST(DcLink, ACapacitorSmoothsTheRipple)
{
    InverterSettings s = link_with(Regeneration::sinks, 2.0, 1e-3); // 80 Hz
    s.ripple_V         = 30.0;
    s.ripple_Hz        = 400.0;
    DcLink link(s, 300.0);
    double least_V = 300.0;
    double most_V  = 300.0;
    for (int k = 0; k < 40000; k++) {
        link.advance(0.0, 1e-6);
        if (k > 20000) {
            least_V = std::min(least_V, link.voltage_V());
            most_V  = std::max(most_V, link.voltage_V());
        }
    }
    const double expected_V = 30.0 / std::hypot(1.0, 2.0 * std::acos(-1.0) * 400.0 * 2e-3);
    EXPECT_NEAR(0.5 * (most_V - least_V), expected_V, 1e-2 * expected_V);
    EXPECT_NEAR(0.5 * (most_V + least_V), 300.0, 1e-2 * expected_V);
}

TEST(DcLink, ARectifierWithoutResistanceHoldsThePeak)
{
    InverterSettings s = link_with(Regeneration::blocks, 0.0, 1e-3);
    s.ripple_V         = 30.0;
    s.ripple_Hz        = 250.0;
    DcLink link(s, 300.0);
    for (int k = 0; k < 20; k++) {
        link.advance(0.0, 1e-4);
    }
    EXPECT_NEAR(link.voltage_V(), 330.0, 1e-9); // at half a period, the source is at 300 V
    for (int k = 0; k < 10; k++) {
        link.advance(5.0, 1e-4); // the source falls by 30 V, the capacitor by 5 V
    }
    EXPECT_NEAR(link.voltage_V(), 325.0, 1e-9);
}

namespace {

InverterSettings with_chopper(double on_V, double hysteresis_V, double resistance_Ohm)
{
    InverterSettings s       = link_with(Regeneration::blocks, 0.0, 1e-3);
    s.chopper_on_V           = on_V;
    s.chopper_hysteresis_V   = hysteresis_V;
    s.chopper_resistance_Ohm = resistance_Ohm;
    return s;
}

} // namespace

TEST(DcLink, ChopperSwitchesAtItsLevelsWithTheTimesOfItsCircuit)
{
    // 2 A come back: up in a straight line to 380 V, down towards 2 A x 100 Ohm to 370 V, up again.
    const double up_s   = (380.0 - 300.0) * 1e-3 / 2.0;
    const double down_s = 0.1 * std::log((380.0 - 200.0) / (370.0 - 200.0));
    const double back_s = 10.0 * 1e-3 / 2.0;
    for (const double step_s : {1e-6, 1e-4, 1.0}) { // no step is too long
        const auto at = [&](double time_s) {
            DcLink link(with_chopper(380.0, 10.0, 100.0), 300.0);
            for (double t = 0.0; t < time_s - 1e-12; t += step_s) {
                link.advance(-2.0, std::min(step_s, time_s - t));
            }
            return link;
        };
        EXPECT_NEAR(at(0.5 * up_s).voltage_V(), 340.0, 1e-6);
        EXPECT_FALSE(at(0.99 * up_s).chopping());
        EXPECT_TRUE(at(1.01 * up_s).chopping());
        EXPECT_NEAR(at(up_s + 0.5 * down_s).voltage_V(), 200.0 + 180.0 * std::exp(-5.0 * down_s),
                    1e-3);
        EXPECT_TRUE(at(up_s + 0.99 * down_s).chopping());
        EXPECT_FALSE(at(up_s + 1.01 * down_s).chopping());
        EXPECT_NEAR(at(up_s + down_s + 0.5 * back_s).voltage_V(), 375.0, 1e-3);
        EXPECT_TRUE(at(up_s + down_s + 1.01 * back_s).chopping());
    }
}

TEST(DcLink, ChopperTurnsIntoHeatWhatTheLinkDoesNotHold)
{
    DcLink link(with_chopper(380.0, 10.0, 100.0), 300.0);
    double in_J = 0.0;
    for (int k = 0; k < 100000; k++) {
        const double before = link.voltage_V();
        link.advance(-2.0, 1e-5);
        in_J += 2.0 * 1e-5 * 0.5 * (before + link.voltage_V());
        EXPECT_LE(link.voltage_V(), 380.0 + 1e-9);
    }
    const double held_J = 0.5e-3 * (std::pow(link.voltage_V(), 2) - 300.0 * 300.0);
    EXPECT_GT(link.chopper_J(), 600.0);
    EXPECT_NEAR(link.chopper_J() + held_J, in_J, 1e-3 * in_J);
}

TEST(DcLink, AChopperThatIsTooWeakLetsTheLinkRiseToItsBalance)
{
    DcLink link(with_chopper(380.0, 10.0, 250.0), 300.0);
    link.advance(-2.0, 10.0);
    EXPECT_TRUE(link.chopping());
    EXPECT_NEAR(link.voltage_V(), 500.0, 1e-3); // 2 A x 250 Ohm
}
