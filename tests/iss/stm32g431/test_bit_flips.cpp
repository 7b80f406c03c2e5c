// SPDX-License-Identifier: MIT
// Flips one bit in the RAM of the running image: variables, stack, and the code in the CCM SRAM. The result may be no effect, or
// an open bridge. A current beyond 1.5 times the limit with the bridge on is a failure.
//
// Every flip has its own process and starts from the same instant of the same run. SDRE_BIT_FLIPS sets their number.
#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "bit_flips.hpp"
#include "running_client.hpp"

using namespace sdre;

namespace {

constexpr int short_form  = 60;
constexpr int exit_quiet  = 0;
constexpr int exit_trip   = 1;
constexpr int exit_missed = 2;

constexpr double after_s = 0.08; // several passes over the code in the RAM

struct Region {
    const char   *name;
    std::uint32_t first;
    std::uint32_t end;
};

class IssBitFlips : public RunningClient {
protected:
    /// In the child: flips, goes on, and says by its exit code what came of it.
    [[noreturn]] void flip_and_go_on(std::uint32_t address, unsigned bit)
    {
        iss::Core &core = served.image().chip.core();
        core.set_word(address, core.word(address) ^ (1U << bit));
        const double limit_A = 1.5 * served.drive().motor.max_current_A;
        double       peak_A  = 0.0;
        bool         told    = false;
        for (const double end_s = served.time_s() + after_s; served.time_s() < end_s && !told;) {
            served.period();
            told   = !served.bridge_on() || served.resets() > 0;
            peak_A = std::max(peak_A, served.bench().peak_current_A());
        }
        _exit(told ? exit_trip : peak_A > limit_A ? exit_missed : exit_quiet);
    }
    static std::array<Region, 3> regions()
    {
        const auto &at = ServedBoard::program().image.symbols;
        return {Region{"stack", at.at("image_stack"), at.at("image_stack_top")},
                {"variables", at.at("image_data"), at.at("image_bss_end")},
                {"code", at.at("image_ccm") & ~1U, at.at("image_ccm_end") & ~1U}};
    }
};

} // namespace

TEST_F(IssBitFlips, NoneLeadsToTooMuchCurrentUnnoticed)
{
    ASSERT_TRUE(
        write_two(APP_REGISTERS_SPEED,
                  static_cast<int>(std::lround(3.0 * served.drive().motor.rated_speed_e_radps))));
    enable(APP_CONTROL_PROFILE_VELOCITY);
    served.dynamometer().brake(served.drive().motor.rated_torque_Nm);
    talk(0.15);
    ASSERT_TRUE(served.bridge_on());
    ASSERT_GT(served.bench().peak_current_A(), 0.3 * served.drive().motor.max_current_A);

    std::vector<std::pair<const char *, std::uint32_t>> words;
    for (const Region &r : regions()) {
        for (std::uint32_t at = r.first; at < r.end; at += 4U) {
            words.emplace_back(r.name, at);
        }
    }
    const auto flips = support::flip_bits(32 * words.size(), short_form, [&](std::size_t place) {
        flip_and_go_on(words[place / 32U].second, static_cast<unsigned>(place % 32U));
    });
    std::array<int, 3> of_code{};
    for (const auto &[place, code] : flips) {
        const auto &[region, address] = words[place / 32U];
        ASSERT_TRUE(code >= exit_quiet && code <= exit_missed) << region << ' ' << address;
        of_code[static_cast<std::size_t>(code)]++;
        if (code == exit_missed) {
            std::printf("%s, %08x bit %zu: too much current\n", region, address, place % 32U);
        }
    }
    std::printf("%zu flips in %zu octets: %d trips, %d missed\n", flips.size(), 4U * words.size(),
                of_code[exit_trip], of_code[exit_missed]);
    EXPECT_EQ(of_code[exit_missed], 0);
}
