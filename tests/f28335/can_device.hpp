// SPDX-License-Identifier: MIT
/// A device with the driver of can_firmware.c, and what its tests look at.
#pragma once

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "can_firmware.h"
#include "plain_surroundings.hpp"
#include "sil/f28335/device.hpp"

namespace sdre::f28335 {

constexpr std::uint32_t abo     = 0x80;
constexpr std::uint32_t dbo     = 0x400;
constexpr std::uint32_t btc_500 = 0x00090152; // 15 quanta, sampled at 80 %
constexpr double        bit_s   = 2e-6;
constexpr double        boot_s  = 6e-3;

inline CanFrame standard(std::uint32_t id, std::uint8_t length = 0, std::uint8_t first = 0)
{
    CanFrame f;
    f.id     = id;
    f.length = length;
    for (unsigned n = 0; n < length; n++) {
        f.data[n] = static_cast<std::uint8_t>(first + n);
    }
    return f;
}

class F28335Can : public ::testing::Test {
protected:
    F28335Can()
    {
        can_firmware_mistake = CAN_MISTAKE_NONE;
        can_firmware_mc      = dbo | abo;
        can_firmware_btc     = btc_500;
        can_firmware_echo    = 0;
        can_firmware_heard   = 0;
        can_firmware_joined  = 0;
    }
    void start()
    {
        device.emplace(around, can_firmware_main, DeviceOptions{});
        device->run_for(boot_s);
    }
    void expect_clean()
    {
        for (const Findings::Entry &e : device->findings().all()) {
            ADD_FAILURE() << e.text;
        }
    }
    bool finds(const std::string &part, Finding kind = Finding::can)
    {
        for (const Findings::Entry &e : device->findings().all()) {
            if (e.kind == kind && e.text.find(part) != std::string::npos) {
                return true;
            }
        }
        return false;
    }
    static void request(std::uint32_t boxes)
    {
        ECanaRegs.CANTRS_word[f28335_ecan_access()].all = boxes; // as the firmware does
    }
    static std::uint32_t flag(const volatile Uint64 &reg)
    {
        return static_cast<std::uint32_t>(reg);
    }
    static std::uint32_t pending()
    {
        return flag(ECanaRegs.CANRMP_word[0].all);
    }
    void pass_bits(double bits)
    {
        device->run_for(bits * bit_s);
    }
    void receive(const CanFrame &frame)
    {
        ASSERT_TRUE(device->can().send(frame));
        pass_bits(170);
    }

    PlainSurroundings     around;
    std::optional<Device> device;
};

} // namespace sdre::f28335
