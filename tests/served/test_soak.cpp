// SPDX-License-Identifier: MIT
// A long run with random speeds, loads and temporary faults. An operator
// sends Modbus requests and resets trips. Nothing may drift, stay stuck, or leave its limits.
//
// SDRE_SOAK_s sets the simulated seconds.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "sil/board/board_scenario.hpp"
#include "soak_board.hpp"

extern "C" {
#include "app_registers.h"
}

using namespace sdre;

namespace {

constexpr double short_form_s = 4.0;
constexpr double limit_A      = 4.0;
constexpr double period_s     = 200e-6;
constexpr double episode_s    = 1.0; // a speed, a load, perhaps something that breaks
constexpr double breaks_at_s  = 0.4;
constexpr double judged_s     = 0.1; // the end of an episode
constexpr double poll_s       = 20e-3;
constexpr double attempt_s    = 8.0;  // of a shaft that coasts, and an alignment
constexpr double longest_s    = 20.0; // out of RUN: another fault may end some attempts
constexpr double rest_Nm      = 0.5;  // while the drive does not run

class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}
    double between(double lo, double hi)
    {
        return lo + (hi - lo) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    int below(int n)
    {
        return static_cast<int>(random_() % static_cast<std::uint64_t>(n));
    }

private:
    std::mt19937_64 random_;
};

enum class Trouble {
    none,
    calm, // as none: half of all episodes
    encoder_glitch,
    current_glitch,
    dead_encoder,
    lost_counts,
    current_offset,
    current_gain,
    dc_link,
    overload,
    silence,
    kinds
};

struct Episode {
    int     speed_tenths = 0;
    double  load_Nm      = 0.0;
    Trouble trouble      = Trouble::none;
};

/// Sensors or supply differ for a while.
template <typename Change> void differ(Scenario &s, double from_s, double to_s, Change change)
{
    PlantChange one;
    one.time_s        = from_s;
    one.changes_plant = false;
    one.sensors       = s.sensors;
    one.inverter      = s.inverter;
    PlantChange back  = one;
    back.time_s       = to_s;
    change(one);
    s.changes.push_back(one);
    s.changes.push_back(back);
}

void add_trouble(Scenario &s, double at_s, Trouble trouble, Dice &dice)
{
    const double side = dice.below(2) == 0 ? -1.0 : 1.0;
    switch (trouble) {
    case Trouble::encoder_glitch:
        s.glitches.push_back(
            {at_s, 1 + dice.below(4), static_cast<int>(side) * (1 + dice.below(40)), 0.0, 0.0});
        break;
    case Trouble::current_glitch:
        s.glitches.push_back({at_s, 1 + dice.below(3), 0, side * dice.between(1.0, 20.0), 0.0});
        break;
    case Trouble::dead_encoder:
        differ(s, at_s, at_s + dice.between(1e-3, 0.1),
               [](PlantChange &c) { c.sensors->encoder_dead = true; });
        break;
    case Trouble::lost_counts:
        differ(s, at_s, at_s + 0.01, [&](PlantChange &c) { c.lost_counts = 1 + dice.below(30); });
        break;
    case Trouble::current_offset:
        differ(s, at_s, at_s + dice.between(1e-3, 0.05),
               [&](PlantChange &c) { c.sensors->adc_offset_b_A = side * dice.between(0.1, 3.0); });
        break;
    case Trouble::current_gain:
        differ(s, at_s, at_s + dice.between(1e-3, 0.05),
               [&](PlantChange &c) { c.sensors->adc_gain_a = dice.between(0.7, 1.3); });
        break;
    case Trouble::dc_link:
        differ(s, at_s, at_s + dice.between(1e-3, 0.05),
               [&](PlantChange &c) { c.inverter->dc_link_V = dice.between(60.0, 200.0); });
        break;
    case Trouble::none:
    case Trouble::calm:
    case Trouble::overload:
    case Trouble::silence:
    case Trouble::kinds:
        break;
    }
}

/// The operator at the serial line, one request at a time.
class Operator {
public:
    explicit Operator(ModbusRun &run) : run_(run) {}

    void want(int speed_tenths)
    {
        speed_ = speed_tenths;
    }
    bool runs() const
    {
        return mode_ == APP_MODE_RUN && asked_;
    }
    int resets() const
    {
        return resets_;
    }
    /// Every some milliseconds; reads what the drive says and does the next thing.
    void act()
    {
        if (!run_.can_command()) {
            return;
        }
        if (!run_.registers().empty() && read_) {
            mode_ = run_.registers().at(APP_REGISTERS_MODE);
        }
        read_ = false;
        if (mode_ == APP_MODE_FAULT && asked_) {
            write(APP_REGISTERS_CONTROLWORD, 6);
            asked_ = false;
        } else if (mode_ == APP_MODE_FAULT && wait_++ >= 5) { // a tenth of a second and more
            write(APP_REGISTERS_CONTROLWORD, reset_ ? 6 : 128 + 6);
            reset_ = !reset_;
            resets_++;
            wait_ = 0;
        } else if (mode_ == APP_MODE_READY && asked_ && wait_++ >= 5) { // refused, or silent
            write(APP_REGISTERS_CONTROLWORD, 6);
            asked_ = false;
            wait_  = 0;
        } else if (mode_ == APP_MODE_READY && !asked_) {
            write(APP_REGISTERS_CONTROLWORD, shut_down_ ? 15 : 6);
            asked_     = shut_down_;
            shut_down_ = !shut_down_;
            asked_     = true;
            wait_      = 0;
        } else if (speed_ != told_) {
            write_speed();
            told_ = speed_;
        } else {
            run_.chat();
            read_ = true;
        }
        if (!read_) {
            mode_ = -1; // to be read again first
        }
    }

private:
    void write(int address, int value)
    {
        run_.write(static_cast<std::uint16_t>(address), static_cast<std::uint16_t>(value));
    }

    void write_speed()
    {
        const auto both = static_cast<std::uint32_t>(speed_);
        run_.write(APP_REGISTERS_SPEED, {static_cast<std::uint16_t>(both >> 16U),
                                         static_cast<std::uint16_t>(both & 0xFFFFU)});
    }

    ModbusRun &run_;
    int        mode_      = -1;
    int        speed_     = 0;
    int        told_      = 0;
    bool       asked_     = false;
    bool       read_      = false;
    bool       reset_     = false;
    bool       shut_down_ = false; ///< before a start
    int        wait_      = 0;
    int        resets_    = 0;
};

} // namespace

TEST(Soak, NothingDriftsOrSticks)
{
    const char  *wanted = std::getenv("SDRE_SOAK_s");
    const double time_s = wanted != nullptr ? std::atof(wanted) : short_form_s;
    const int    count  = static_cast<int>(std::lround(time_s / episode_s));

    Scenario s = read_scenario_file(
        SDRE_SOURCE_DIR "/host_tools/sil/scenarios/board_load_step.toml", soak_drive);
    s.load_torque.clear();
    s.initial_speed_e_radps = 0.0;
    s                       = for_board(s).scenario;
    Dice                 dice(5); // one in which a trip comes early
    std::vector<Episode> episodes;
    for (int n = 0; n < count; n++) {
        Episode e;
        e.speed_tenths = static_cast<int>(dice.between(-6000.0, 6000.0));
        e.load_Nm      = dice.between(0.1, 1.5);
        e.trouble      = dice.below(2) == 0
                             ? Trouble::calm
                             : static_cast<Trouble>(dice.below(static_cast<int>(Trouble::kinds)));
        add_trouble(s, n * episode_s + breaks_at_s, e.trouble, dice);
        episodes.push_back(e);
    }
    constexpr long start = 1700; // ticks: after the boot and the index
    const auto     board = soak_board(s, start);
    ModbusRun     &run   = *board;
    Operator       op(run);
    const auto     episode_ticks = std::lround(episode_s / period_s);
    const auto     poll_ticks    = std::lround(poll_s / period_s);
    double         peak_A = 0.0, worst_e_radps = 0.0, away_s = 0.0, longest_away_s = 0.0;
    double         trying_s = 0.0, longest_try_s = 0.0;
    std::array<double, static_cast<std::size_t>(Trouble::kinds)> worst_A{};
    double                                                       sum_e_radps = 0.0;
    bool         running = true; // all of the episode
    int          judged = 0, trips = 0, recoveries = 0;
    bool         tripped = false, recovering = false;
    app_mode_t   before = APP_MODE_BOOT;
    const double zero_A = static_cast<double>(run.status().zero_a_cnt);
    while (run.bench().tick() < start) {
        ASSERT_TRUE(run.step());
    }
    for (long k = 0; k < count * episode_ticks; k++) {
        const double   at_s = static_cast<double>(k) * period_s;
        const Episode &e    = episodes.at(static_cast<std::size_t>(k / episode_ticks));
        const double   in_s = static_cast<double>(k % episode_ticks) * period_s;
        if (k % episode_ticks == 0) {
            op.want(e.speed_tenths);
            sum_e_radps = 0.0;
            running     = true;
        }
        if (k % poll_ticks == 0 && !(e.trouble == Trouble::silence && in_s > 0.2 && in_s < 0.8)) {
            op.act();
        }
        const double omega    = run.bench().plant_state().omega_e_radps;
        const bool   on       = run.bench().bridge_on();
        const bool   too_much = e.trouble == Trouble::overload && in_s > 0.4 && in_s < 0.6;
        const double torque   = !on ? rest_Nm : too_much ? 5.0 : e.load_Nm;
        run.bench().board()->set_extra_load_Nm(torque * std::clamp(omega / 20.0, -1.0, 1.0));
        ASSERT_TRUE(run.step()) << "the device was reset at " << at_s << " s";
        ASSERT_FALSE(run.bench().runaway()) << at_s << " s";

        peak_A                 = std::max(peak_A, run.bench().peak_current_A());
        double &by_kind_A      = worst_A.at(static_cast<std::size_t>(e.trouble));
        by_kind_A              = std::max(by_kind_A, run.bench().peak_current_A());
        const app_status_t now = run.status();
        running                = running && now.mode == APP_MODE_RUN;
        trips += now.mode == APP_MODE_FAULT && !tripped ? 1 : 0;
        tripped = now.mode == APP_MODE_FAULT;
        recoveries += recovering && now.mode == APP_MODE_RUN ? 1 : 0;
        recovering = tripped || (recovering && now.mode != APP_MODE_RUN);
        // A trip, or a silent master, ends an attempt to run.
        const bool again = (tripped && before != APP_MODE_FAULT) ||
                           (before == APP_MODE_ALIGN && now.mode == APP_MODE_READY);
        before         = now.mode;
        away_s         = now.mode == APP_MODE_RUN ? 0.0 : away_s + period_s;
        trying_s       = again ? 0.0 : std::min(away_s, trying_s + period_s);
        longest_away_s = std::max(longest_away_s, away_s);
        longest_try_s  = std::max(longest_try_s, trying_s);
        ASSERT_LT(trying_s, attempt_s)
            << at_s << " s: mode " << now.mode << ", fault " << now.fault;
        ASSERT_LT(away_s, longest_s) << at_s << " s: mode " << now.mode << ", fault " << now.fault;
        if (in_s >= episode_s - judged_s) {
            sum_e_radps += omega - 0.1 * e.speed_tenths;
        }
        if (k % episode_ticks == episode_ticks - 1) {
            EXPECT_LT(peak_A, 1.5 * limit_A)
                << at_s << " s: trouble " << static_cast<int>(e.trouble) << " at "
                << 0.1 * e.speed_tenths << " rad/s, " << e.load_Nm << " Nm";
            peak_A           = 0.0;
            const bool quiet = e.trouble == Trouble::calm || e.trouble == Trouble::none;
            if (quiet && running) {
                const double off = std::abs(sum_e_radps) * period_s / judged_s;
                worst_e_radps    = std::max(worst_e_radps, off);
                EXPECT_LT(off, 1.0) << at_s << " s, at " << 0.1 * e.speed_tenths;
                judged++;
            }
        }
    }
    EXPECT_TRUE(run.findings().empty()) << run.findings().front();
    EXPECT_EQ(run.errors(), 0);
    EXPECT_GT(judged, 0);
    EXPECT_GT(op.resets(), 0);
    EXPECT_NEAR(static_cast<double>(run.status().zero_a_cnt), zero_A, 20.0);
    fmt::print("{} s: {} trips, {} recoveries, worst mean speed error of {} quiet seconds {:.3f} "
               "rad/s, longest out of RUN {:.2f} s, longest attempt {:.2f} s, {} answers, peak "
               "current by trouble [A]: {:.2f}\n",
               time_s, trips, recoveries, judged, worst_e_radps, longest_away_s, longest_try_s,
               run.answers(), fmt::join(worst_A, ", "));
}
