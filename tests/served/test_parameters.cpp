// SPDX-License-Identifier: MIT
// Parameters over power and over restarts.
#include "parameters_client.hpp"

using namespace sdre;

namespace {

class Parameters : public ParametersClient {};

} // namespace

TEST_F(Parameters, AreThereAfterEveryStart)
{
    EXPECT_EQ(window(), 50);
    EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_STATE), 0);
    ASSERT_TRUE(window(77));
    ASSERT_TRUE(write(APP_REGISTERS_MODBUS_ADDRESS, {9}));
    unit = 9;
    ASSERT_TRUE(store());
    pass(restart_s);
    EXPECT_EQ(served.resets(), 1);
    EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_DONE), 1);
    for (int power = 0; power < 2; power++) {
        EXPECT_EQ(window(), 77);
        EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_STATE), 1);
        EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_NUMBER + 1), 1);
        served.power_cycle();
        pass(0.5);
    }
    ASSERT_TRUE(window(78));
    ASSERT_TRUE(store());
    for (const int resets = served.resets(); served.resets() == resets;) {
        served.period();
    }
    served.power_cycle(); // while it is erased, and not the other sector
    EXPECT_EQ(window(), 77);
    ASSERT_TRUE(write(APP_REGISTERS_RESTORE_PARAMETERS, {0x6461, 0x6F6C}));
    pass(restart_s + 2.0); // two sectors
    unit = 1;
    EXPECT_EQ(window(), 50);
    EXPECT_EQ(input(APP_REGISTERS_PARAMETERS_DONE), 1);
    EXPECT_TRUE(served.findings().empty()) << served.findings().front();
}

TEST_F(Parameters, AMotorThatRunsOrCoastsStoresNothingAndKeepsItsLine)
{
    run_at(2000);
    EXPECT_FALSE(store());
    EXPECT_FALSE(write(APP_REGISTERS_BAUD_RATE, {0, 9600}));
    EXPECT_FALSE(write(APP_REGISTERS_DIRECTION_PIN, {1}));
    EXPECT_TRUE(window(60)) << "this one needs no stop";
    ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_DISABLE_VOLTAGE}));
    pass(0.002);
    EXPECT_FALSE(served.bridge_on());
    EXPECT_FALSE(store()) << "it coasts";
    for (int n = 0; n < 100 && !store(); n++) {
        pass(0.1);
    }
    pass(restart_s);
    EXPECT_EQ(served.resets(), 1);
    EXPECT_EQ(window(), 60);
    EXPECT_TRUE(served.findings().empty());
}
