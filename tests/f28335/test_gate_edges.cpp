// SPDX-License-Identifier: MIT
// Register values of one leg to the edges of its two gates. Times in counts since the counter's top.
#include <gtest/gtest.h>

#include "sil/f28335/gate_edges.hpp"

namespace {

using namespace sdre::f28335;

constexpr int prd = 7500;

/// Up-down, upper switch on around ZERO, dead band of 3 us at 75 MHz.
LegRegisters leg(int compare)
{
    LegRegisters r;
    r.tbprd  = prd;
    r.cmpa   = compare;
    r.aqctla = 0x0094; // PRD clears, CAU clears, CAD sets
    r.dbctl  = 0x000B; // both delays, B inverted, from A
    r.dbred  = 225;
    r.dbfed  = 225;
    return r;
}

std::vector<GateEdge> gates_of(const LegRegisters &r, LegMemory &memory)
{
    return leg_period(r, Count::down_up, memory).gates;
}

void expect_gates(const std::vector<GateEdge> &got, const std::vector<GateEdge> &want)
{
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t n = 0; n < got.size(); n++) {
        EXPECT_EQ(got[n].time_cnt, want[n].time_cnt) << n;
        EXPECT_EQ(got[n].upper, want[n].upper) << n;
        EXPECT_EQ(got[n].lower, want[n].lower) << n;
    }
}

TEST(GateEdges, PulseIsCentredAndEachSwitchComesOnThreeMicrosecondsLate)
{
    LegMemory  memory;
    const auto gates = gates_of(leg(3000), memory);

    // The input rises at 7500 - 3000 and falls at 7500 + 3000.
    expect_gates(gates, {{0, false, true},
                         {4500, false, false},
                         {4725, true, false},
                         {10500, false, false},
                         {10725, false, true}});
    EXPECT_EQ(shortest_gap_cnt(gates), 225);
    EXPECT_DOUBLE_EQ(225 / 75e6, 3e-6);
}

TEST(GateEdges, DelaysOfTheTwoEdgesAreApart)
{
    LegRegisters r = leg(3000);
    r.dbred        = 100;
    r.dbfed        = 400;
    LegMemory memory;

    expect_gates(gates_of(r, memory), {{0, false, true},
                                       {4500, false, false},
                                       {4600, true, false},
                                       {10500, false, false},
                                       {10900, false, true}});
}

TEST(GateEdges, DeadTimeRunsOnIntoTheNextPeriod)
{
    LegMemory memory;
    gates_of(leg(7400), memory); // falls at 14900, lower switch at 15125 = 125 of the next period

    expect_gates(gates_of(leg(3000), memory), {{0, false, false},
                                               {125, false, true},
                                               {4500, false, false},
                                               {4725, true, false},
                                               {10500, false, false},
                                               {10725, false, true}});
}

TEST(GateEdges, PulseShorterThanTheDeadTimeNeverTurnsTheUpperSwitchOn)
{
    LegMemory memory;

    expect_gates(gates_of(leg(100), memory),
                 {{0, false, true}, {7400, false, false}, {7825, false, true}});
}

TEST(GateEdges, NoDutyAndFullDutyDoNotSwitch)
{
    LegMemory low;
    expect_gates(gates_of(leg(0), low), {{0, false, true}});

    LegMemory high;
    gates_of(leg(prd), high);
    expect_gates(gates_of(leg(prd), high), {{0, true, false}});
}

TEST(GateEdges, AfterFullDutyThePeriodActionEndsThePulse)
{
    LegMemory memory;
    gates_of(leg(prd), memory);
    const LegPeriod with = leg_period(leg(3000), Count::down_up, memory);
    EXPECT_FALSE(with.a.front().level);

    // Without that action the output would stay high until the counter comes up again.
    LegRegisters r = leg(prd);
    r.aqctla       = 0x0090;
    LegMemory other;
    leg_period(r, Count::down_up, other);
    r.cmpa                  = 3000;
    const LegPeriod without = leg_period(r, Count::down_up, other);
    ASSERT_EQ(without.a.size(), 2U);
    EXPECT_TRUE(without.a[0].level);
    EXPECT_EQ(without.a[1].time_cnt, 10500);
}

/// Counts of the period in which the action qualifier's output is high.
int high_counts(const LegPeriod &p, int counts)
{
    int high = 0;
    for (std::size_t n = 0; n < p.a.size(); n++) {
        const int until = n + 1 < p.a.size() ? p.a[n + 1].time_cnt : counts;
        high += p.a[n].level ? until - p.a[n].time_cnt : 0;
    }
    return high;
}

// The old value counts at the instant of its load: full duty begins half a period late and ends half a period late.
TEST(GateEdges, CompareOfTbprdLoadedAtPrdIsWrongByHalfAPeriod)
{
    LegRegisters r = leg(prd);
    r.aqctla       = 0x0096; // and ZERO sets
    LegMemory memory;
    r.cmpa_at_start = 3000;
    EXPECT_EQ(high_counts(leg_period(r, Count::down_up, memory), 2 * prd), prd);
    r.cmpa_at_start = prd;
    EXPECT_EQ(high_counts(leg_period(r, Count::down_up, memory), 2 * prd), 2 * prd);
    r.cmpa = 3000;
    EXPECT_EQ(high_counts(leg_period(r, Count::down_up, memory), 2 * prd), prd + 3000);
}

TEST(GateEdges, CompareOfZeroLoadedAtZeroIsWrongByHalfAPeriod)
{
    LegRegisters r = leg(0);
    r.aqctla       = 0x0096;
    LegMemory memory;
    r.cmpa_at_start = 3000;
    EXPECT_EQ(high_counts(leg_period(r, Count::up, memory), prd), prd);
    r.cmpa          = 3000;
    r.cmpa_at_start = 0;
    EXPECT_EQ(high_counts(leg_period(r, Count::up, memory), prd), 0);
}

/// At its top the counter goes down: CAD, then PRD, then CAU; at zero it goes up: CAU, then ZERO, then CAD.
TEST(GateEdges, TheOtherDirectionsComparesComeLast)
{
    const auto level_at_start = [](std::uint16_t aqctl, int compare, Count count) {
        LegRegisters r = leg(compare);
        r.aqctla       = aqctl;
        LegMemory memory;
        memory.a.level = true;
        return leg_period(r, count, memory).a.front().level;
    };
    EXPECT_TRUE(level_at_start(0x0018, prd, Count::down));  // PRD sets, CAU clears
    EXPECT_FALSE(level_at_start(0x0010, prd, Count::down)); // CAU alone
    EXPECT_TRUE(level_at_start(0x0042, 0, Count::up));      // ZERO sets, CAD clears
    EXPECT_FALSE(level_at_start(0x0040, 0, Count::up));
}

TEST(GateEdges, SevenMicrosecondsAtFullSpeedLeaveTwentySixCounts)
{
    LegRegisters r = leg(3000);
    r.dbred        = 1050;
    r.dbfed        = 1050;
    LegMemory memory;

    EXPECT_EQ(shortest_gap_cnt(gates_of(r, memory)), 1050 - 1024);
}

TEST(GateEdges, WithoutDeadBandBothSwitchesAreNeverOffTogether)
{
    LegRegisters r = leg(3000);
    r.dbctl        = 0x0008; // polarity set, but both outputs pass
    LegMemory       memory;
    const LegPeriod period = leg_period(r, Count::down_up, memory);

    EXPECT_FALSE(period.complementary);
    for (const GateEdge &e : period.gates) {
        EXPECT_FALSE(e.lower); // B follows its own qualifier, which does nothing
    }
}

TEST(GateEdges, SamePolarityOnBothOutputsIsAShootThrough)
{
    LegRegisters r = leg(3000);
    r.dbctl        = 0x0003; // active high both
    LegMemory memory;

    EXPECT_EQ(shortest_gap_cnt(gates_of(r, memory)), -1);
}

TEST(GateEdges, OfTwoComparesAtOnceBWins)
{
    LegRegisters r = leg(3000);
    r.cmpb         = 3000;
    r.aqctla       = 0x0480; // CAD sets, CBD clears
    LegMemory memory;
    for (const SignalEdge &e : leg_period(r, Count::down_up, memory).a) {
        EXPECT_FALSE(e.level) << e.time_cnt;
    }

    r.cmpa = prd; // both at the counter's top
    r.cmpb = prd;
    LegMemory other;
    EXPECT_FALSE(leg_period(r, Count::down_up, other).a.front().level);
    r.aqctla = 0x0840; // the other way round: CAD clears, CBD sets
    EXPECT_TRUE(leg_period(r, Count::down_up, other).a.front().level);
}

TEST(GateEdges, ToggleChangesTheLevelOncePerPeriod)
{
    LegRegisters r = leg(3000);
    r.aqctla       = 0x0030; // CAU toggles
    LegMemory memory;
    for (const bool rises : {true, false, true}) {
        const std::vector<SignalEdge> a = leg_period(r, Count::down_up, memory).a;
        ASSERT_EQ(a.size(), 2U);
        EXPECT_EQ(a[0].level, !rises);
        EXPECT_EQ(a[1].level, rises);
        EXPECT_EQ(a[1].time_cnt, prd + 3000);
    }
}

/// A gate that stays as it is for minutes, a period of 15,000 counts after the other.
TEST(GateEdges, LongAgoStaysLongAgo)
{
    LegRegisters r = leg(3000);
    r.aqctla = r.aqctlb = 0x0000; // nothing changes
    LegMemory memory;
    for (int k = 0; k < 150000; k++) {
        gates_of(r, memory);
    }
    EXPECT_EQ(memory.a.last_rise, long_ago_cnt);
    EXPECT_EQ(memory.b.last_fall, long_ago_cnt);
}

TEST(GateEdges, EitherDelayCanTakeBAsItsInput)
{
    LegRegisters r = leg(3000);
    r.cmpb         = 3000;
    r.aqctlb       = 0x0904; // PRD clears, CBU clears, CBD sets
    r.aqctla       = 0x0000; // A stays low

    r.dbctl = 0x003B; // both from B
    LegMemory both;
    expect_gates(gates_of(r, both), {{0, false, true},
                                     {4500, false, false},
                                     {4725, true, false},
                                     {10500, false, false},
                                     {10725, false, true}});
    r.dbctl = 0x001B; // the rising edge alone: the lower switch follows A and stays on
    LegMemory rising;
    expect_gates(gates_of(r, rising), {{0, false, true}, {4725, true, true}, {10500, false, true}});
    r.dbctl = 0x002B; // the falling edge alone: the upper switch follows A and stays off
    LegMemory falling;
    expect_gates(gates_of(r, falling),
                 {{0, false, true}, {4500, false, false}, {10725, false, true}});
}

} // namespace
