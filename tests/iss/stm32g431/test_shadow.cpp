// SPDX-License-Identifier: MIT
// The image in closed loop, and the same application in the host's build. The same inputs give the same duty ratios, state
// and estimates, tick by tick and bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "stm32g431/cycle_meter.hpp"
#include "stm32g431/image_bench.hpp"
#include "stm32g431/shadow.h"

extern "C" {
#include "app_control.h"
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
    explicit Shadow(ImageBench &bench)
        : bench_(bench), sample_at_(bench.program.image.symbols.at("sample"))
    {
        if (!shadow_start()) {
            throw std::runtime_error("the host's build refuses the constants");
        }
        bench_.chip.core().watch_handlers(this);
    }
    void begins(int exception, std::uint64_t /*cycle*/) override
    {
        if (exception == control_interrupt) {
            in_.has_command = bench_.memory.get<bool>("shared", "command_full");
            in_.command     = bench_.memory.get<app_objects_t>("shared", "command");
        }
    }
    void ends(int exception, std::uint64_t /*cycle*/) override
    {
        if (exception != control_interrupt) {
            return;
        }
        bench_.chip.core().read_octets(sample_at_, &in_.sample, sizeof in_.sample);
        note_age();
        in_.board_faults            = bench_.memory.get<std::uint16_t>("shared", "board_faults");
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
        const auto &edges = bench_.bench.edges();
        if (in_.sample.edge_seen && !edges.empty()) {
            const double true_cnt =
                (bench_.bench.period_s() - edges.back().time_s) * BOARD_CAPTURE_Hz;
            worst_age_cnt_ = std::max(worst_age_cnt_, std::abs(true_cnt - in_.sample.edge_age_cnt));
        }
    }
    shadow_output_t seen() const
    {
        const std::array<int, 3> duty = bench_.chip.written_cnt();
        shadow_output_t          o{};
        o.duty        = {static_cast<std::uint16_t>(duty[0]), static_cast<std::uint16_t>(duty[1]),
                         static_cast<std::uint16_t>(duty[2])};
        o.mode        = bench_.mode();
        o.fault       = bench_.fault();
        o.state       = bench_.memory.get<drive_state_t>("tick_side", "drive_state");
        o.drive_fault = bench_.memory.get<drive_fault_t>("tick_side", "drive_fault");
        o.v_V         = bench_.memory.get<dq_t>("tick_side", "v_V");
        o.i_ref_A     = bench_.memory.get<dq_t>("tick_side", "i_ref_A");
        o.d_omega     = bench_.memory.get<float>("tick_side", "d_omega");
        o.d_q         = bench_.memory.get<float>("tick_side", "d_q");
        o.d_d         = bench_.memory.get<float>("tick_side", "d_d");
        o.gate_on     = bench_.memory.get<bool>("tick_side", "gate_on");
        return o;
    }

    ImageBench    &bench_;
    std::uint32_t  sample_at_;
    shadow_input_t in_{};
    long           ticks_         = 0;
    long           runs_          = 0;
    long           differences_   = 0;
    double         worst_age_cnt_ = 0.0;
    std::string    first_;
};

class IssShadow : public ::testing::Test {
protected:
    static constexpr double from_power_up = 0.0; // the shaft is free: the drive aligns

    Program    program{read_elf(ISS_IMAGE), read_elf(ISS_LAYOUT)};
    ImageBench b{at_rest(sdre::read_drive_file(ISS_DRIVE)), from_power_up, program};
    Shadow     shadow{b};
};

} // namespace

// Boot, calibration, alignment, speed steps, stop; and a trip.
TEST_F(IssShadow, AnswersAsTheHostsBuildBitForBit)
{
    const double speed = 0.3 * b.scenario.drive.motor.rated_speed_e_radps;
    b.pass(0.32);
    EXPECT_EQ(b.mode(), APP_MODE_READY);
    ASSERT_TRUE(b.enable(speed, 4.0)) << "mode " << b.mode() << ", fault " << b.fault();
    b.run(0.2);
    EXPECT_NEAR(b.speed_e_radps(), speed, 0.02 * speed);
    ASSERT_TRUE(b.command(APP_CONTROL_ENABLE_OPERATION, -speed));
    b.run(0.2);
    EXPECT_NEAR(b.speed_e_radps(), -speed, 0.02 * speed);
    ASSERT_TRUE(b.command(APP_CONTROL_SHUT_DOWN, 0.0));
    b.run(0.3);
    EXPECT_EQ(b.mode(), APP_MODE_READY);
    b.chip.set_over_current(true);
    b.pass(0.01);

    EXPECT_EQ(shadow.differences(), 0) << shadow.first();
    EXPECT_GT(shadow.worst_age_cnt(), 0.0);
    EXPECT_LE(shadow.worst_age_cnt(), 6.0) << "four cycles of the reads, and rounding";
    for (const std::string &line : b.chip.core().findings()) {
        ADD_FAILURE() << line;
    }
    std::printf("%ld ticks compared, %ld of them in a run\n", shadow.ticks(), shadow.run_ticks());
    EXPECT_GT(shadow.run_ticks(), 5000);
}
