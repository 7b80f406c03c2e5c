// SPDX-License-Identifier: MIT
// The image in closed loop, and the same application in the host's build. The same inputs give the same duty ratios, state
// and estimates, tick by tick and bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "sil/f28335/modbus_master.hpp"
#include "sil/run/controller.hpp"
#include "sil/setup/board_reader.hpp"
#include "stm32g431/cycle_meter.hpp"
#include "stm32g431/image_board.hpp"
#include "stm32g431/serial_line.hpp"
#include "stm32g431/shadow.h"

extern "C" {
#include "app_control.h"
#include "app_registers.h"
}

using namespace iss;
using namespace iss::stm32g431;

namespace {

bool same(const shadow_output_t &x, const shadow_output_t &y)
{
    // Members one by one: what is between them is nothing.
    const auto bits = [](const auto &a, const auto &b) {
        return std::memcmp(&a, &b, sizeof a) == 0;
    };
    return bits(x.duty, y.duty) && x.mode == y.mode && x.fault == y.fault && x.state == y.state &&
           x.drive_fault == y.drive_fault && bits(x.v_V, y.v_V) && bits(x.i_ref_A, y.i_ref_A) &&
           bits(x.d_omega, y.d_omega) && bits(x.d_q, y.d_q) && bits(x.d_d, y.d_d) &&
           x.gate_on == y.gate_on;
}

std::string text(const shadow_output_t &o)
{
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(),
                  "duty %u %u %u, mode %d, faults %d %d, v %a %a, i %a %a, d %a %a %a",
                  unsigned{o.duty.a_cnt}, unsigned{o.duty.b_cnt}, unsigned{o.duty.c_cnt},
                  static_cast<int>(o.mode), static_cast<int>(o.fault),
                  static_cast<int>(o.drive_fault), static_cast<double>(o.v_V.d),
                  static_cast<double>(o.v_V.q), static_cast<double>(o.i_ref_A.d),
                  static_cast<double>(o.i_ref_A.q), static_cast<double>(o.d_omega),
                  static_cast<double>(o.d_q), static_cast<double>(o.d_d));
    return line.data();
}

/// Gives each tick of the image to the host's build, and compares.
class Shadow : public HandlerWatch {
public:
    explicit Shadow(ImageBoard &image)
        : image_(image), sample_at_(image.program.image.symbols.at("sample"))
    {
        if (!shadow_start()) {
            throw std::runtime_error("the host's build refuses the constants");
        }
        image_.chip.core().watch_handlers(this);
    }
    void begins(int exception, std::uint64_t /*cycle*/) override
    {
        if (exception == control_interrupt) {
            in_.has_command = image_.memory.get<bool>("shared", "command_full");
            in_.command     = image_.memory.get<app_objects_t>("shared", "command");
        }
    }
    void ends(int exception, std::uint64_t /*cycle*/) override
    {
        if (exception != control_interrupt) {
            return;
        }
        image_.chip.core().read_octets(sample_at_, &in_.sample, sizeof in_.sample);
        note_age();
        in_.board_faults            = image_.memory.get<std::uint16_t>("shared", "board_faults");
        const shadow_output_t host  = shadow_tick(&in_);
        const shadow_output_t image = seen();
        ticks_++;
        runs_ += image.state == DRIVE_RUN ? 1 : 0;
        if (!same(host, image) && differences_++ == 0) {
            first_ = "tick " + std::to_string(ticks_) + "\n  host:  " + text(host) +
                     "\n  image: " + text(image);
        }
    }

    long ticks() const
    {
        return ticks_;
    }
    long run_ticks() const ///< with the control core in force
    {
        return runs_;
    }
    long differences() const
    {
        return differences_;
    }
    const std::string &first() const
    {
        return first_;
    }

    double worst_age_cnt() const ///< of the ages of edges, off what they were
    {
        return worst_age_cnt_;
    }

private:
    void note_age()
    {
        const auto &edges = image_.bench.edges();
        if (in_.sample.edge_seen && !edges.empty()) {
            const double true_cnt =
                (image_.bench.period_s() - edges.back().time_s) * BOARD_CAPTURE_Hz;
            worst_age_cnt_ = std::max(worst_age_cnt_, std::abs(true_cnt - in_.sample.edge_age_cnt));
        }
    }
    shadow_output_t seen() const
    {
        const std::array<int, 3> duty = image_.chip.written_cnt();
        shadow_output_t          o{};
        o.duty        = {static_cast<std::uint16_t>(duty[0]), static_cast<std::uint16_t>(duty[1]),
                         static_cast<std::uint16_t>(duty[2])};
        o.mode        = image_.memory.get<app_mode_t>("tick_side", "mode");
        o.fault       = image_.memory.get<app_fault_t>("tick_side", "fault");
        o.state       = image_.memory.get<drive_state_t>("tick_side", "drive_state");
        o.drive_fault = image_.memory.get<drive_fault_t>("tick_side", "drive_fault");
        o.v_V         = image_.memory.get<dq_t>("tick_side", "v_V");
        o.i_ref_A     = image_.memory.get<dq_t>("tick_side", "i_ref_A");
        o.d_omega     = image_.memory.get<float>("tick_side", "d_omega");
        o.d_q         = image_.memory.get<float>("tick_side", "d_q");
        o.d_d         = image_.memory.get<float>("tick_side", "d_d");
        o.gate_on     = image_.memory.get<bool>("tick_side", "gate_on");
        return o;
    }

    ImageBoard    &image_;
    std::uint32_t  sample_at_;
    shadow_input_t in_{};
    long           ticks_         = 0;
    long           runs_          = 0;
    long           differences_   = 0;
    double         worst_age_cnt_ = 0.0;
    std::string    first_;
};

/// The drive at rest with the sensors and the dead time of its file, three shunts, and the dry friction of a small machine.
sdre::Scenario at_rest(const sdre::Drive &drive)
{
    sdre::Scenario s;
    s.drive                             = drive;
    s.dc_link_V                         = drive.inverter.dc_link_V;
    s.sensors                           = sdre::sensors_of_drive(drive);
    s.sensors.ideal                     = false;
    s.sensors.current_sensors           = 3;
    s.inverter.dead_time_s              = drive.inverter.dead_time_s;
    s.motor_effects.coulomb_friction_Nm = 0.02 * drive.motor.rated_torque_Nm;
    return s;
}

/// The application of the host cannot be in a program with that of a served drive: this client has no other surroundings.
class IssShadow : public ::testing::Test {
protected:
    void pass(double time_s)
    {
        for (const double end_s = image.chip.time_s() + time_s; image.chip.time_s() < end_s;) {
            image.chip.run_for(bench.period_s());
            master.poll();
        }
    }
    /// Asks now and then, as a drive whose client is silent stops.
    void talk(double time_s)
    {
        for (const double end_s = image.chip.time_s() + time_s; image.chip.time_s() < end_s;) {
            master.read_input(APP_REGISTERS_LIVE_FIRST, 8);
            pass(std::min(0.05, end_s - image.chip.time_s()));
        }
    }
    void write(std::uint16_t number, const std::vector<std::uint16_t> &words)
    {
        master.write(number, words);
        pass(0.02);
        ASSERT_FALSE(master.busy());
        ASSERT_EQ(master.errors(), 0);
    }
    void set_speed(double e_radps)
    {
        const auto tenths = static_cast<std::uint32_t>(std::lround(10.0 * e_radps));
        write(APP_REGISTERS_SPEED, {static_cast<std::uint16_t>(tenths >> 16U),
                                    static_cast<std::uint16_t>(tenths & 0xFFFFU)});
    }
    void control(std::uint16_t word)
    {
        write(APP_REGISTERS_CONTROLWORD, {word});
    }
    app_mode_t mode() const
    {
        return image.memory.get<app_mode_t>("tick_side", "mode");
    }
    double speed_e_radps() const
    {
        return bench.plant_state().omega_e_radps;
    }

    Program                    program{read_elf(ISS_IMAGE), read_elf(ISS_LAYOUT)};
    sdre::Scenario             scenario = at_rest(sdre::read_drive_file(ISS_DRIVE));
    sdre::MotorBench           bench{scenario, 0}; // the shaft is free: the drive aligns
    ImageBoard                 image{bench, scenario.drive, program, false};
    SerialLine                 line{image.chip.serial()};
    sdre::f28335::ModbusMaster master{line, 1};
    Shadow                     shadow{image};
};

} // namespace

// Boot, calibration, alignment, speed steps, stop; and a trip.
TEST_F(IssShadow, AnswersAsTheHostsBuildBitForBit)
{
    const double speed = 0.3 * scenario.drive.motor.rated_speed_e_radps;
    pass(0.32);
    EXPECT_EQ(mode(), APP_MODE_READY);
    set_speed(speed);
    control(APP_CONTROL_SHUT_DOWN);
    control(APP_CONTROL_ENABLE_OPERATION);
    for (int n = 0; n < 80 && mode() != APP_MODE_RUN; n++) {
        talk(0.05);
    }
    talk(0.2);
    EXPECT_NEAR(speed_e_radps(), speed, 0.02 * speed);
    set_speed(-speed);
    talk(0.2);
    EXPECT_NEAR(speed_e_radps(), -speed, 0.02 * speed);
    control(APP_CONTROL_SHUT_DOWN);
    talk(0.3);
    EXPECT_EQ(mode(), APP_MODE_READY);
    image.chip.set_over_current(true);
    pass(0.01);

    EXPECT_EQ(shadow.differences(), 0) << shadow.first();
    EXPECT_GT(shadow.worst_age_cnt(), 0.0);
    EXPECT_LE(shadow.worst_age_cnt(), 6.0) << "four cycles of the reads, and rounding";
    for (const std::string &finding : image.chip.core().findings()) {
        ADD_FAILURE() << finding;
    }
    std::printf("%ld ticks compared, %ld of them in a run\n", shadow.ticks(), shadow.run_ticks());
    EXPECT_GT(shadow.run_ticks(), 5000);
}
