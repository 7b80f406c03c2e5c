// SPDX-License-Identifier: MIT
// The firmware's CANopen node: driver, node and motor.
#include <cmath>
#include <cstdio>

#include "can_client.hpp"

namespace {

using namespace sdre;

constexpr unsigned emergency = 0x81;
constexpr int      velocity  = 3;
constexpr unsigned enabled   = 0x27;

class Canopen : public CanClient {
protected:
    /// Mean of some readings: one is off by 34 r/min at times, with 1000 lines.
    double speed_rpm()
    {
        const int readings = 8;
        double    sum_rpm  = 0.0;
        for (int n = 0; n < readings; n++) {
            sum_rpm += 0.1 * static_cast<std::int32_t>(get(0x606C).value_or(0));
        }
        return sum_rpm / readings;
    }
    void run_at(double rpm)
    {
        ASSERT_EQ(put(0x60FF, 0, static_cast<std::uint32_t>(std::lround(10.0 * rpm)), 4), no_abort);
        enable(velocity);
        pass(1.0);
        ASSERT_NEAR(speed_rpm(), rpm, speed_band_rpm);
    }
    int take_emergency(double longest_s)
    {
        const std::optional<Data> a = take(emergency, longest_s);
        return a && a->size() == 8 ? (*a)[0] | ((*a)[1] << 8U) : -1;
    }
};

TEST_F(Canopen, TellsItsStartOnceTheBusIsThere)
{
    const std::optional<Data> start = take(0x701, 0.1);
    ASSERT_TRUE(start);
    EXPECT_EQ(*start, Data{0});
    EXPECT_FALSE(take(0x701, 0.5));
    EXPECT_EQ(get(0x1000), 0x20192U);
    expect_no_findings();
}

TEST_F(Canopen, RunsWithoutModbus)
{
    run_at(600.0);
    pass(3.0); // MODBUS_TIMEOUT is half a second
    EXPECT_NEAR(speed_rpm(), 600.0, speed_band_rpm);
    EXPECT_EQ(state(), enabled);
    EXPECT_EQ(put(0x6040, 0, 0, 2), no_abort);
    pass(0.5);
    EXPECT_EQ(state(), 0x40U);
    std::printf("slowest answer to an SDO request: %.2f ms\n", 1e3 * slowest_s);
    EXPECT_LT(slowest_s, 3e-3);
    expect_no_findings();
}

TEST_F(Canopen, ModbusTakesTheCommandAndItsSilenceThenCounts)
{
    run_at(600.0);
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {0x0F}));
    pass(0.3);
    EXPECT_EQ(state(), enabled);
    pass(0.5);
    EXPECT_NE(state(), enabled);
}

TEST_F(Canopen, ALostHeartbeatActsAsLostOptionSays)
{
    for (const int option : {2, 3}) { // disable voltage, quick stop
        ASSERT_EQ(put(0x6007, 0, static_cast<std::uint32_t>(option), 2), no_abort);
        ASSERT_EQ(put(0x1016, 1, (0x7FU << 16U) | 50U, 4), no_abort);
        nmt(1);
        run_at(600.0);
        for (int n = 0; n < 20; n++) {
            send(0x77F, {5});
            pass(0.04);
        }
        EXPECT_EQ(state(), enabled);
        come.clear();
        pass(0.045);
        EXPECT_EQ(take_emergency(0.05), 0x8130);
        pass(coasting_s);
        EXPECT_NE(state(), enabled);
        std::printf("LOST_OPTION %d: %.0f r/min after %.2f s\n", option, speed_rpm(), coasting_s);
        EXPECT_EQ(std::abs(speed_rpm()) < 20.0, option == 3); // else it coasts
        EXPECT_EQ(put(0x6040, 0, 0, 2), no_abort);
        pass(to_rest_s);
    }
    expect_no_findings();
}

TEST_F(Canopen, BusOffStopsTheDriveAndItComesBack)
{
    nmt(1);
    run_at(600.0);
    ASSERT_EQ(put(0x1017, 0, 10, 2), no_abort);
    served.can_bus().set_fault(f28335::CanFault::dominant);
    pass(0.5);
    EXPECT_FALSE(served.bridge_on());
    served.can_bus().set_fault(f28335::CanFault::none);
    come.clear();
    EXPECT_EQ(take_emergency(0.5), 0x8120);
    EXPECT_EQ(take_emergency(0.5), 0x8140);
    EXPECT_EQ(take_emergency(0.5), 0);
    EXPECT_NE(state(), enabled);
    EXPECT_EQ(get(0x1001), 0U);
}

TEST_F(Canopen, APulledCableIsErrorPassiveAndNoReasonToStop)
{
    run_at(600.0);
    ASSERT_EQ(put(0x1017, 0, 10, 2), no_abort);
    served.can_bus().set_fault(f28335::CanFault::open);
    pass(2.0);
    EXPECT_TRUE(served.bridge_on());
    served.can_bus().set_fault(f28335::CanFault::none);
    come.clear();
    EXPECT_EQ(take_emergency(0.5), 0x8120);
    EXPECT_EQ(take_emergency(0.5), 0);
    EXPECT_EQ(state(), enabled);
}

TEST_F(Canopen, AnswersAtEveryBitRate)
{
    for (const unsigned rate : {125U, 250U, 1000U, 500U}) {
        ASSERT_EQ(put(0x2121, 0, rate, 2), no_abort);
        nmt(130);
        ASSERT_TRUE(take(0x701, 0.1)) << rate;
        EXPECT_DOUBLE_EQ(served.can_bus().bit_rate_Hz(), 1e3 * rate);
        EXPECT_EQ(get(0x1000), 0x20192U) << rate;
    }
    expect_no_findings();
}

TEST_F(Canopen, StoredNumberHoldsAfterARestart)
{
    ASSERT_EQ(put(0x2120, 0, 7, 2), no_abort);
    ASSERT_EQ(get(0x2120), 7U);
    pass(0.5);
    ASSERT_EQ(put(0x1010, 1, 0x65766173, 4), no_abort); // "save"
    come.clear();
    const std::optional<Data> start = take(0x707, 20.0);
    ASSERT_TRUE(start);
    EXPECT_EQ(*start, Data{0});
    node = 7;
    EXPECT_EQ(get(0x1200, 1), 0x607U);
}

TEST_F(Canopen, ResetNodeRestartsTheDrive)
{
    const int before = served.resets();
    nmt(129);
    pass(1.0);
    EXPECT_EQ(served.resets(), before + 1);
    EXPECT_TRUE(take(0x701, 0.1));
}

TEST_F(Canopen, CommandsOfOnePdoActTogetherWithSync)
{
    ASSERT_EQ(put(0x1403, 2, 1, 1), no_abort);
    nmt(1);
    run_at(300.0);
    for (int n = 0; n < 200; n++) { // 0.5 ms between the PDO and SYNC
        const int  rpm10 = 3000 + 5 * n;
        const auto x     = static_cast<std::uint32_t>(rpm10);
        send(0x501, {0x0F, 0, static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(x >> 8U),
                     static_cast<std::uint8_t>(x >> 16U), static_cast<std::uint8_t>(x >> 24U)});
        pass(0.5e-3);
        send(0x80, {});
        pass(9.5e-3);
    }
    pass(0.5);
    EXPECT_NEAR(speed_rpm(), 399.5, speed_band_rpm);
    int answers = 0;
    for (const f28335::CanFrame &f : come) {
        answers += f.id == 0x481 ? 1 : 0;
    }
    EXPECT_EQ(answers, 200);
    EXPECT_EQ(take_emergency(0.0), -1);
    expect_no_findings();
}

TEST_F(Canopen, AFullBusTakesNothingAway)
{
    run_at(600.0);
    slowest_s = 0.0;
    for (int n = 0; n < 400; n++) { // foreign frames back to back
        for (int k = 0; k < 12; k++) {
            offer(0x100U + static_cast<unsigned>(k), {0, 1, 2, 3, 4, 5, 6, 7});
        }
        if (n % 20 == 0) {
            EXPECT_EQ(state(), enabled) << n;
        } else {
            pass(2.5e-3);
        }
    }
    std::printf("bus load %.0f %%; slowest answer to an SDO request: %.2f ms\n",
                100.0 * served.can_bus().load(), 1e3 * slowest_s);
    EXPECT_GT(served.can_bus().load(), 0.9);
    EXPECT_NEAR(speed_rpm(), 600.0, speed_band_rpm);
    EXPECT_EQ(take_emergency(0.0), -1);
    expect_no_findings();
}

TEST_F(Canopen, ABabblingNodeOnAnIdentifierOfOursIsToldAndDoesNoHarm)
{
    nmt(1);
    run_at(600.0);
    ASSERT_EQ(put(0x2121, 0, 1000, 2), no_abort);
    for (int n = 0; n < 200; n++) {
        for (int k = 0; k < 20; k++) {
            offer(0x201, {0x0F, 0});
        }
        pass(2.0e-3);
    }
    EXPECT_EQ(state(), enabled);
    EXPECT_NEAR(speed_rpm(), 600.0, speed_band_rpm);
    expect_no_findings();
}

TEST_F(Canopen, FaultsAreTold)
{
    run_at(600.0);
    come.clear();
    served.dynamometer().brake(0.3 * served.drive().motor.rated_torque_Nm);
    pass(0.5);
    InjectedFault broken;
    broken.kind = FaultKind::phase_open;
    served.break_part(broken);
    const int code = take_emergency(1.0);
    EXPECT_EQ(code, static_cast<int>(get(0x603F).value_or(0)));
    EXPECT_NE(code, 0);
    EXPECT_NE(get(0x1001).value_or(0), 0U);
}

TEST_F(Canopen, ABrokenEncoderWireIsToldWithTheTrip)
{
    run_at(600.0);
    come.clear();
    InjectedFault broken;
    broken.kind  = FaultKind::encoder_losing;
    broken.value = 1e5; // the counter stands still
    served.break_part(broken);
    const double broken_s = served.time_s();
    double       open_s   = 0.0;
    for (bool told = false; !told && served.time_s() < broken_s + 1.0;) {
        pass(served.period_s());
        open_s = served.bridge_on() ? served.time_s() : open_s;
        for (const f28335::CanFrame &f : come) {
            told = told || f.id == emergency;
        }
    }
    const double told_s = served.time_s();
    EXPECT_NE(take_emergency(0.0), -1);
    std::printf("encoder wire broken: bridge open after %.1f ms, emergency %.1f ms later\n",
                1e3 * (open_s - broken_s), 1e3 * (told_s - open_s));
    EXPECT_LE(told_s - open_s, 1e-3);
}

} // namespace
