// SPDX-License-Identifier: MIT
/// A client that stores parameters.
#pragma once

#include "served_client.hpp"

extern "C" {
#include "app_control.h"
#include "app_modes.h"
#include "app_registers.h"
}

namespace sdre {

class ParametersClient : public ServedClient {
protected:
    ParametersClient()
    {
        pass(0.5);
    }
    bool store()
    {
        return write(APP_REGISTERS_STORE_PARAMETERS, {0x6576, 0x6173});
    }
    bool window(std::uint16_t tenths)
    {
        return write(APP_REGISTERS_SPEED_WINDOW, {tenths});
    }
    int window()
    {
        return holding(APP_REGISTERS_SPEED_WINDOW);
    }
    void run_at(std::uint16_t tenths)
    {
        ASSERT_TRUE(write(APP_REGISTERS_SPEED, {0, tenths}));
        ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_SHUT_DOWN}));
        pass(0.01);
        ASSERT_TRUE(write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_ENABLE_OPERATION}));
        for (int n = 0; n < 20; n++) { // it aligns first; who does not ask is taken for gone
            pass(0.2);
            input(APP_REGISTERS_MODE);
        }
        ASSERT_EQ(input(APP_REGISTERS_MODE), APP_MODE_RUN);
    }
};

} // namespace sdre
