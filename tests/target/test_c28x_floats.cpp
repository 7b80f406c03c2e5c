// SPDX-License-Identifier: MIT
// The control core with the C28x's rules for floats: what is no number is refused, or opens the bridge in the same call.
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "c28x_float.hpp"

#include "drive_tick.h"
#include "gain_tables.h"
#include "law_noc.h"
#include "near_optimal.h"

namespace {

const std::array<std::uint32_t, 6> not_numbers = {
    0x7FC00000U, 0xFFC00000U, 0x7F800001U, 0xFF800001U, // NaN of either sign, quiet and signalling
    0x7F800000U, 0xFF800000U};                          // infinities

c28x_float from_bits(std::uint32_t bits)
{
    c28x_float x;
    std::memcpy(static_cast<void *>(&x), &bits, sizeof bits);
    return x;
}

/// The words of an object that hold a number of a size that a constant or a state has.
template <typename T> std::vector<std::size_t> numbers_in(const T &object)
{
    std::vector<std::size_t> words;
    for (std::size_t at = 0; at + 4 <= sizeof(T); at += 4) {
        c28x_float x;
        std::memcpy(static_cast<void *>(&x), reinterpret_cast<const char *>(&object) + at, 4);
        const double size = std::abs(static_cast<double>(x));
        if (size > 1e-12 && size < 1e12) {
            words.push_back(at);
        }
    }
    return words;
}

void put(void *object, std::size_t at, std::uint32_t bits)
{
    std::memcpy(static_cast<char *>(object) + at, &bits, sizeof bits);
}

bool closed_and_whole(const bridge_t &out)
{
    const auto whole = [](c28x_float duty) { return base_in_range(duty, 0.0F, 1.0F); };
    return out.gate_enable && whole(out.duty.a) && whole(out.duty.b) && whole(out.duty.c);
}

class C28xFloats : public ::testing::Test {
protected:
    C28xFloats()
    {
        sample.dc_link_V   = 295.0F;
        sample.theta_e_rad = 0.3F;
        sample.valid       = true;
        command.run        = true;
        EXPECT_EQ(drive_init(&drive, &gain_tables_drive), CTL_OK);
        for (int n = 0; n < 20; n++) {
            command.omega_e_radps = 0.0F; // asks for no current, and the sample shows none
            EXPECT_TRUE(closed_and_whole(drive_tick(&drive, &sample, &command)));
        }
    }

    drive_t         drive{}; // a word that nothing writes is no number
    drive_sample_t  sample{};
    drive_command_t command{};
};

TEST_F(C28xFloats, NanIsAnInfinityOfItsSign)
{
    EXPECT_TRUE(from_bits(0x7FC00000U) > c28x_float(1e30F));
    EXPECT_TRUE(from_bits(0xFFC00000U) < c28x_float(-1e30F));
    EXPECT_TRUE(from_bits(0x00000001U) == c28x_float(0.0F));
}

TEST_F(C28xFloats, EveryConstantIsChecked)
{
    drive_config_t   config = gain_tables_drive;
    law_noc_config_t constants =
        *static_cast<const law_noc_config_t *>(gain_tables_drive.constants);
    config.constants = &constants;
    ASSERT_EQ(drive_config_check(&config), CTL_OK);

    const law_noc_config_t good = constants;
    const auto             all  = numbers_in(constants);
    EXPECT_GT(all.size(), 50U); // symmetry leaves zeros
    for (const std::size_t at : all) {
        for (const std::uint32_t bits : not_numbers) {
            put(&constants, at, bits);
            EXPECT_EQ(drive_config_check(&config), CTL_BAD_CONFIG) << at << ' ' << bits;
            constants = good;
        }
    }
    const std::size_t hardware = offsetof(drive_config_t, hardware);
    for (const std::size_t at : numbers_in(gain_tables_drive)) {
        if (at >= hardware) {
            continue; // compared by the application; pointers
        }
        for (const std::uint32_t bits : not_numbers) {
            put(&config, at, bits);
            EXPECT_EQ(drive_config_check(&config), CTL_BAD_CONFIG) << at << ' ' << bits;
            config           = gain_tables_drive;
            config.constants = &constants;
        }
    }
}

TEST_F(C28xFloats, EverySampleAndCommandIsChecked)
{
    c28x_float *const values[] = {
        &sample.ia_A,          &sample.ib_A,       &sample.dc_link_V,
        &sample.theta_e_rad,   &sample.band_rad,   &sample.edge_gap_s,
        &sample.omega_e_radps, &sample.edge_age_s, &command.omega_e_radps};
    const drive_t running = drive;
    for (c28x_float *value : values) {
        const c28x_float good = *value;
        for (const std::uint32_t bits : not_numbers) {
            *value = from_bits(bits);
            drive  = running;
            EXPECT_FALSE(drive_tick(&drive, &sample, &command).gate_enable)
                << value - values[0] << ' ' << bits;
            EXPECT_EQ(drive.state, DRIVE_FAULT);
        }
        *value = good;
    }
}

TEST_F(C28xFloats, AStateThatIsNoNumberOpensTheBridgeOrDoesNotReachIt)
{
    sample.ia_A = 0.2F; // without currents most states are zero
    sample.ib_A = 0.1F;
    for (int n = 0; n < 5; n++) {
        ASSERT_TRUE(closed_and_whole(drive_tick(&drive, &sample, &command))) << drive.fault;
    }
    const drive_t running = drive;
    int           opened  = 0;
    const auto    all     = numbers_in(running.law);
    EXPECT_GT(all.size(), 10U);
    for (const std::size_t at : all) {
        for (const std::uint32_t bits : not_numbers) {
            drive = running;
            put(&drive.law, at, bits);
            const bridge_t out = drive_tick(&drive, &sample, &command);
            EXPECT_TRUE(!out.gate_enable || closed_and_whole(out)) << at << ' ' << bits;
            opened += out.gate_enable ? 0 : 1;
        }
    }
    EXPECT_GT(opened, 0);
}

TEST_F(C28xFloats, LimitsHoldForEverything)
{
    for (const std::uint32_t bits : not_numbers) {
        const c28x_float x = from_bits(bits);
        EXPECT_TRUE(base_in_range(base_clamp(x, -2.0F, 3.0F), -2.0F, 3.0F)) << bits;
        EXPECT_FALSE(base_in_range(x, -1e30F, 1e30F)) << bits;
        EXPECT_FALSE(base_within(x, 1e30F)) << bits;
    }
}

} // namespace
