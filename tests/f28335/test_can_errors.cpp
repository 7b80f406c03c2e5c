// SPDX-License-Identifier: MIT
// eCAN-A on a bus that is broken: error counters, bus-off and the way back.
#include "can_device.hpp"

namespace {

using namespace sdre::f28335;

TEST_F(F28335Can, WithoutAcknowledgementItBecomesPassiveAndNoMore)
{
    start();
    device->can().set_far_end(std::nullopt, false);
    request(2);
    device->run_for(20e-3);

    EXPECT_EQ(+ECanaRegs.CANTEC.bit.TEC, 128);
    EXPECT_EQ(+ECanaRegs.CANES.bit.EP, 1);
    EXPECT_EQ(+ECanaRegs.CANES.bit.EW, 1);
    EXPECT_EQ(+ECanaRegs.CANES.bit.ACKE, 1);
    EXPECT_EQ(+ECanaRegs.CANES.bit.BO, 0);
    EXPECT_EQ(flag(ECanaRegs.CANTRS_word[0].all), 2U);
    device->can().set_far_end(std::nullopt);
    pass_bits(400);
    EXPECT_EQ(+ECanaRegs.CANTEC.bit.TEC, 127);
    EXPECT_EQ(flag(ECanaRegs.CANTA_word[0].all), 2U);
    EXPECT_EQ(+ECanaRegs.CANES.bit.EP, 1); // until it is acknowledged
    ECanaRegs.CANES.all = 0x000F0000;
    device->run_for(30e-6);
    EXPECT_EQ(+ECanaRegs.CANES.bit.EP, 0);
    EXPECT_EQ(+ECanaRegs.CANES.bit.EW, 1);
    EXPECT_EQ(+ECanaRegs.CANES.bit.ACKE, 0);
    expect_clean();
}

TEST_F(F28335Can, TheFirstBusErrorStaysUntilItIsAcknowledged)
{
    start();
    device->can().set_far_end(std::nullopt, false);
    request(2);
    device->run_for(1e-3);
    ASSERT_EQ(+ECanaRegs.CANES.bit.ACKE, 1);
    device->can().set_fault(CanFault::shorted);
    device->run_for(0.3e-3);
    EXPECT_EQ(+ECanaRegs.CANES.bit.BE, 0);
    ECanaRegs.CANES.all = 0x00010000; // another flag
    device->run_for(0.3e-3);
    EXPECT_EQ(+ECanaRegs.CANES.bit.ACKE, 1);
    ECanaRegs.CANES.all = 0x00080000;
    device->run_for(0.3e-3);
    EXPECT_EQ(+ECanaRegs.CANES.bit.ACKE, 0);
    EXPECT_EQ(+ECanaRegs.CANES.bit.BE, 1);
    expect_clean();
}

TEST_F(F28335Can, APulledCableLeavesItAlone)
{
    start();
    device->can().set_fault(CanFault::open);
    ASSERT_TRUE(device->can().send(standard(0x123)));
    request(2);
    device->run_for(20e-3);
    EXPECT_EQ(pending(), 0U);
    EXPECT_EQ(+ECanaRegs.CANTEC.bit.TEC, 128);
    EXPECT_EQ(+ECanaRegs.CANES.bit.BO, 0);
    device->can().set_fault(CanFault::none);
    pass_bits(400);
    EXPECT_EQ(pending(), 0x80000000U);
    EXPECT_TRUE(device->can().take());
}

TEST_F(F28335Can, AShortedPairLeadsToBusOffAndBack)
{
    start();
    device->can().set_fault(CanFault::shorted);
    request(2);
    ASSERT_TRUE(device->run_until([&] { return device->can().bus_off(); }, 5e-3));
    EXPECT_EQ(+ECanaRegs.CANES.bit.BO, 1);
    EXPECT_EQ(+ECanaRegs.CANES.bit.BE, 1);
    EXPECT_EQ(+ECanaRegs.CANMC.bit.CCR, 0);
    device->can().set_fault(CanFault::none);
    pass_bits(128 * 11 - 60);
    EXPECT_TRUE(device->can().bus_off());
    EXPECT_NEAR(+ECanaRegs.CANREC.bit.REC, 123, 4);
    pass_bits(60 + 170);
    EXPECT_FALSE(device->can().bus_off());
    EXPECT_EQ(+ECanaRegs.CANES.bit.BO, 0);
    EXPECT_EQ(+ECanaRegs.CANTEC.bit.TEC, 0);
    EXPECT_TRUE(device->can().take()); // the request was still there
    expect_clean();
}

TEST_F(F28335Can, APulledCableDoesNotHastenTheReturn)
{
    start();
    device->can().set_fault(CanFault::shorted);
    request(2);
    ASSERT_TRUE(device->run_until([&] { return device->can().bus_off(); }, 5e-3));
    device->can().set_fault(CanFault::open);
    pass_bits(128 * 11 - 60);
    EXPECT_TRUE(device->can().bus_off());
    pass_bits(90);
    EXPECT_FALSE(device->can().bus_off());
}

TEST_F(F28335Can, WithoutAboTheFirmwareEndsBusOff)
{
    can_firmware_mc = dbo;
    start();
    device->can().set_fault(CanFault::shorted);
    request(2);
    ASSERT_TRUE(device->run_until([&] { return device->can().bus_off(); }, 5e-3));
    device->can().set_fault(CanFault::none);
    device->run_for(10e-3);
    EXPECT_EQ(+ECanaRegs.CANMC.bit.CCR, 1);
    EXPECT_EQ(+ECanaRegs.CANES.bit.CCE, 1);
    EXPECT_TRUE(device->can().bus_off());
    device->instruction(" EALLOW"); // as the firmware would
    ECanaRegs.CANMC.bit.CCR = 0;
    device->instruction(" EDIS");
    pass_bits(250);
    EXPECT_FALSE(device->can().bus_off());
    EXPECT_TRUE(device->can().take());
    expect_clean();
}

TEST_F(F28335Can, ADominantPairCountsErrorsAndHoldsUpTheReturn)
{
    start();
    device->can().set_fault(CanFault::dominant);
    device->run_for(2e-3); // nobody sends
    EXPECT_EQ(+ECanaRegs.CANES.bit.EP, 1);
    EXPECT_EQ(+ECanaRegs.CANES.bit.BO, 0);
    EXPECT_EQ(+ECanaRegs.CANTEC.bit.TEC, 0);
    device->can().set_fault(CanFault::none);
    pass_bits(100);
    device->can().set_far_end(std::nullopt);
    request(2);
    pass_bits(30); // within its frame
    device->can().set_fault(CanFault::dominant);
    device->run_for(20e-3);
    EXPECT_TRUE(device->can().bus_off());
    device->can().set_fault(CanFault::none);
    device->can().set_far_end(std::nullopt);
    pass_bits(128 * 11 + 250);
    EXPECT_FALSE(device->can().bus_off());
    EXPECT_TRUE(device->can().take());
}

// The gap behind each frame has eleven recessive bits.
TEST_F(F28335Can, ItJoinsAFullBusAndReturnsToIt)
{
    CanBus     bus;
    CanNode   *nodes[] = {&bus.join(), &bus.join()};
    const auto fill    = [&] {
        for (CanNode *node : nodes) {
            node->open(500e3);
            while (node->send(standard(0x700))) { // behind what the device sends
            }
        }
    };
    DeviceOptions with_bus;
    with_bus.can_bus = &bus;
    bus.far_end().close();
    fill();
    device.emplace(around, can_firmware_main, with_bus);
    device->run_for(boot_s);
    EXPECT_EQ(can_firmware_joined, 1);
    bus.set_fault(CanFault::shorted);
    request(2);
    ASSERT_TRUE(device->run_until([&] { return device->can().bus_off(); }, 5e-3));
    bus.set_fault(CanFault::none);
    fill();
    device->run_for(100 * 50 * bit_s); // frames of 50 bits and more
    EXPECT_TRUE(device->can().bus_off());
    device->run_for(100 * 60 * bit_s);
    EXPECT_FALSE(device->can().bus_off());
    EXPECT_EQ(flag(ECanaRegs.CANTA_word[0].all), 2U);
    EXPECT_FALSE(bus.idle());
    device.reset(); // before its bus
}

TEST_F(F28335Can, AnotherBitRateDestroysAndDoesNotReceive)
{
    start();
    device->can().set_far_end(250e3);
    ASSERT_TRUE(device->can().send(standard(0x123)));
    device->run_for(20e-3);
    EXPECT_EQ(pending(), 0U);
    EXPECT_GT(+ECanaRegs.CANREC.bit.REC, 0);
    device->can().set_far_end(250e3);
    request(2);
    device->run_for(30e-3);
    EXPECT_FALSE(device->can().take());
    EXPECT_GT(+ECanaRegs.CANTEC.bit.TEC, 95);
    device->can().set_far_end(500.9e3); // 0.2 %
    device->run_for(10e-3);
    EXPECT_TRUE(device->can().take());
}

TEST_F(F28335Can, ABusOutlivesAReset)
{
    CanBus        bus;
    CanNode      &node = bus.join();
    DeviceOptions with_bus;
    with_bus.can_bus = &bus;
    node.open();
    bus.far_end().close();
    for (int run = 0; run < 2; run++) {
        device.reset();
        device.emplace(around, can_firmware_main, with_bus);
        device->run_for(boot_s);
        request(2);
        pass_bits(run == 0 ? 170 : 400); // the second run begins within a frame
        const std::optional<CanFrame> got = node.take();
        ASSERT_TRUE(got);
        EXPECT_EQ(got->id, 0x181U);
        ASSERT_TRUE(node.send(standard(0x123, 1, 5)));
        pass_bits(20);
    }
    device.reset(); // before its bus
}

TEST_F(F28335Can, WithoutPinsNothingGoesOut)
{
    for (const can_firmware_mistake_t m : {CAN_MISTAKE_NO_PINS, CAN_MISTAKE_NO_FUNCTION}) {
        can_firmware_mistake = m;
        start();
        request(2);
        device->run_for(5e-3);
        EXPECT_FALSE(device->can().take());
        EXPECT_EQ(flag(ECanaRegs.CANTRS_word[0].all), 2U);
        receive(standard(0x123));
        EXPECT_EQ(pending(), 0U);
    }
}

} // namespace
