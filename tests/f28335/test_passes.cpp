// SPDX-License-Identifier: MIT
// Firmware without a stack of its own, as in a browser: what its master reads is the same.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drive/drive_file.hpp"
#include "modbus_pdu.hpp"
#include "sil/served/serial_bus.hpp"
#include "sil/served/served_f28335.hpp"

extern "C" {
#include "app_control.h"
#include "app_modes.h"
#include "app_registers.h"
}

using namespace sdre;

namespace {

constexpr double look_s = 0.04; // of a page

/// A master that looks again and again, and commands meanwhile; all that it was told.
class Master {
public:
    explicit Master(bool own_stack)
        : drive_file_(read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml")),
          drive_(drive_file_, drive_file_, 1, {}, own_stack)
    {
    }

    void look_for(double time_s)
    {
        for (const double end_s = drive_.time_s() + time_s; drive_.time_s() < end_s;) {
            ask({4, 0, APP_REGISTERS_STATUSWORD, 0, 48}, look_s);
        }
    }
    void write(unsigned first, const std::vector<std::uint16_t> &words)
    {
        ask(support::write_pdu(first, words), look_s / 4.0);
    }
    void start(std::uint16_t tenths)
    {
        write(APP_REGISTERS_SPEED, {0, tenths});
        write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_SHUT_DOWN});
        write(APP_REGISTERS_CONTROLWORD, {APP_CONTROL_ENABLE_OPERATION});
    }
    /// Reads word `number` of the last answer, which begins with unit, function and octets.
    unsigned word(std::size_t number) const
    {
        const Octets &last = answers_.back();
        return 256U * last.at(3 + 2 * number) + last.at(4 + 2 * number);
    }
    unsigned mode() const
    {
        return word(APP_REGISTERS_MODE);
    }
    ServedF28335 &drive()
    {
        return drive_;
    }
    const std::vector<Octets> &answers() const
    {
        return answers_;
    }

private:
    void ask(const Octets &pdu, double time_s)
    {
        Octets frame{1};
        frame.insert(frame.end(), pdu.begin(), pdu.end());
        bus_.push({0, 0, 1, rtu_frame(frame)});
        for (const double end_s = drive_.time_s() + time_s; drive_.time_s() < end_s;) {
            drive_.period();
            bus_.step(drive_, [this](const BusRequest &, const Octets &answer) {
                answers_.push_back(answer);
            });
        }
    }

    Drive               drive_file_;
    ServedF28335        drive_;
    SerialBus           bus_;
    std::vector<Octets> answers_;
};

/// A run with a load. Then a hung control interrupt, a reset, and a run after it.
std::vector<Octets> told(bool own_stack)
{
    Master master(own_stack);
    master.look_for(0.4);
    EXPECT_EQ(master.mode(), APP_MODE_READY) << own_stack;
    master.start(3142);
    master.look_for(2.0);
    EXPECT_EQ(master.mode(), APP_MODE_RUN) << own_stack;
    master.drive().dynamometer().brake(1.0);
    master.look_for(0.5);
    EXPECT_NEAR(master.drive().plant_state().omega_e_radps, 314.2, 5.0) << own_stack;
    const std::vector<Octets> answers = master.answers();
    master.drive().break_part({0.0, FaultKind::tick_hung});
    master.look_for(1.0);
    EXPECT_EQ(master.drive().resets(), 1) << own_stack;
    EXPECT_EQ(master.mode(), APP_MODE_READY) << own_stack;
    EXPECT_EQ(master.word(APP_REGISTERS_RESET_CAUSE), BOARD_RESET_WATCHDOG) << own_stack;
    master.drive().mend();
    master.start(1000);
    master.look_for(2.0);
    EXPECT_EQ(master.mode(), APP_MODE_RUN) << own_stack;
    EXPECT_TRUE(master.drive().findings().empty())
        << own_stack << master.drive().findings().front();
    return answers;
}

} // namespace

TEST(Passes, AMasterIsToldTheSame)
{
    const std::vector<Octets> with    = told(true);
    const std::vector<Octets> without = told(false);
    ASSERT_GT(with.size(), 70U);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t n = 0; n < with.size(); n++) {
        ASSERT_EQ(with[n], without[n]) << "answer " << n;
    }
}
