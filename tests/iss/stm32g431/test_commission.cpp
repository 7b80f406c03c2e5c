// SPDX-License-Identifier: MIT
// The image finds the simulated motor by itself, as the application on board.h does, and no control interrupt is too long.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sil/board/board_scenario.hpp"
#include "sil/commission/board_bench.hpp"
#include "sil/commission/report.hpp"
#include "stm32g431/image_scenario.hpp"

using namespace iss::stm32g431;

namespace {

/// The longest control interrupt of each stage.
class StageTicks : public iss::HandlerWatch {
public:
    explicit StageTicks(ImageRun &run) : run_(run)
    {
        run.chip().core().watch_handlers(this);
    }
    void begins(int exception, std::uint64_t cycle) override
    {
        if (exception == control_interrupt) {
            began_ = cycle;
            stage_ = run_.status().commission.stage;
        }
    }
    void ends(int exception, std::uint64_t cycle) override
    {
        if (exception == control_interrupt) {
            std::uint64_t &most = longest_.at(static_cast<std::size_t>(stage_));
            most                = std::max(most, cycle - began_);
        }
    }
    std::uint64_t longest(commission_stage_t stage) const
    {
        return longest_.at(static_cast<std::size_t>(stage));
    }

private:
    ImageRun                                           &run_;
    std::uint64_t                                       began_ = 0;
    commission_stage_t                                  stage_ = COMMISSION_IDLE;
    std::array<std::uint64_t, COMMISSION_FINISHED + 2U> longest_{};
};

} // namespace

TEST(IssCommission, TheImageFindsTheMotorOfItsDrive)
{
    const Program               program = read_program(ISS_IMAGE);
    const sdre::Drive           truth   = sdre::read_drive_file(ISS_DRIVE);
    std::unique_ptr<StageTicks> ticks;
    const sdre::CommissionRun   image =
        sdre::commission_on_board(truth, {}, [&](const sdre::BoardScenario &b, long start_tick) {
            auto run = std::make_unique<ImageRun>(with_three_shunts(b.scenario), start_tick,
                                                  program, b.dead_time_s <= 0.0);
            ticks    = std::make_unique<StageTicks>(*run);
            return run;
        });
    const sdre::CommissionRun host = sdre::commission_on_board(truth, {}, sdre::BoardKind::api);

    const std::string text = sdre::commission_text(truth, image);
    std::printf("%s", text.c_str());
    ASSERT_TRUE(image.finished());
    ASSERT_TRUE(host.finished());
    const auto of_image = sdre::commission_lines(truth, image);
    const auto of_host  = sdre::commission_lines(truth, host);
    ASSERT_EQ(of_image.size(), of_host.size());
    for (std::size_t n = 0; n < of_host.size(); n++) {
        const std::string &name = of_image[n].name;
        // Measured: 0.5 % of the truth at most, and 3 % of the friction.
        const double most = name.find("friction") != std::string::npos ? 0.1 : 0.01;
        EXPECT_LE(std::abs(of_image[n].error), name == "offset" ? 1.0 : most) << text;
        EXPECT_NEAR(of_image[n].error, of_host[n].error, name == "offset" ? 0.2 : most) << name;
    }
    const double period_cycles = sdre::control_period_s(truth) * core_Hz;
    for (const commission_stage_t stage :
         {COMMISSION_WATCH, COMMISSION_LOOK, COMMISSION_RESISTANCE, COMMISSION_DRAG, COMMISSION_MAP,
          COMMISSION_SPIN, COMMISSION_RING}) {
        std::printf("%-12s %5.0f %% of a period at most\n", sdre::commission_stage_name(stage),
                    100.0 * static_cast<double>(ticks->longest(stage)) / period_cycles);
        EXPECT_LE(static_cast<double>(ticks->longest(stage)), period_cycles);
    }
}
