// SPDX-License-Identifier: MIT
// Two drives on one bus, led by the SYNC of one master. Simulated time, in lock step.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "can_client.hpp"
#include "second_drive.hpp"

namespace {

using namespace sdre;

constexpr int    cyclic_position = 8;
constexpr int    per_turn        = 10000;
constexpr double ts_s            = 2e-4;
constexpr double sync_s          = 5e-3;
const double     circle          = 2.0 * std::acos(-1.0);

/// The second one is made first.
class CanopenPair : public SecondDrive, public CanClient {
protected:
    CanopenPair() : SecondDrive(2)
    {
        other_.open();
    }
    void SetUp() override
    {
        to_second(0x601, {0x2B, 0x20, 0x21, 0, 2, 0, 0, 0}); // CAN_NODE
        pass(0.4);
        to_second(0, {130, 1});
        pass(0.01);
        joined_ = true;
    }
    void to_second(std::uint32_t id, const Data &data)
    {
        f28335::CanFrame f;
        f.id     = id;
        f.length = static_cast<std::uint8_t>(data.size());
        std::copy(data.begin(), data.end(), f.data.begin());
        hear(f);
    }
    /// The master's frames reach both at once.
    bool offer(std::uint32_t id, const Data &data) override
    {
        if (joined_) {
            to_second(id, data);
        }
        return CanClient::offer(id, data);
    }
    void after_period() override
    {
        CanClient::after_period();
        const Parcel second = SecondDrive::period();
        for (int n = 0; n < second.frames && joined_; n++) {
            EXPECT_TRUE(other_.send(second.frame.at(static_cast<std::size_t>(n))));
        }
        for (std::optional<f28335::CanFrame> f = other_.take(); f; f = other_.take()) {
            if (joined_ && is_of_first(f->id)) {
                hear(*f);
            }
        }
        findings_ += second.findings;
        shaft_.at(0) += turned_cnt(served.plant_state().omega_e_radps);
        shaft_.at(1) += turned_cnt(second.omega_e_radps);
    }
    static bool is_of_first(std::uint32_t id)
    {
        const unsigned kind = id & 0x780U;
        return (id & 0x7FU) == 1 && (kind == 0x80 || kind == 0x580 || kind == 0x700 ||
                                     (kind >= 0x180 && kind < 0x580 && (kind & 0x80U) != 0));
    }
    static double turned_cnt(double omega_e_radps)
    {
        return omega_e_radps / 2.0 * ts_s * per_turn / circle;
    }
    /// Cyclic position by SYNC, and where it is.
    void prepare(std::uint8_t number)
    {
        node = number;
        ASSERT_EQ(put(0x1402, 2, 1, 1), no_abort);
        ASSERT_EQ(put(0x60C2, 1, static_cast<std::uint32_t>(std::lround(1e3 * sync_s)), 1),
                  no_abort);
        enable(cyclic_position);
        base_.at(number - 1U) = static_cast<std::int32_t>(get(0x6064).value_or(0));
    }
    void lead(std::int32_t way_cnt)
    {
        for (unsigned n = 0; n < 2; n++) {
            const auto x = static_cast<std::uint32_t>(base_.at(n) + way_cnt);
            send(0x401 + n,
                 {0x0F, 0, static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(x >> 8U),
                  static_cast<std::uint8_t>(x >> 16U), static_cast<std::uint8_t>(x >> 24U)});
        }
        send(0x80, {});
    }
    /// Positions that came with each SYNC.
    std::vector<std::int32_t> answers(unsigned number) const
    {
        std::vector<std::int32_t> all;
        for (const f28335::CanFrame &f : come) {
            if (f.id == 0x380U + number) {
                const std::uint32_t x = f.data[2] | (static_cast<std::uint32_t>(f.data[3]) << 8U) |
                                        (static_cast<std::uint32_t>(f.data[4]) << 16U) |
                                        (static_cast<std::uint32_t>(f.data[5]) << 24U);
                all.push_back(static_cast<std::int32_t>(x) - base_.at(number - 1U));
            }
        }
        return all;
    }

    bool                        joined_   = false;
    int                         findings_ = 0;
    std::array<double, 2>       shaft_{};
    std::array<std::int32_t, 2> base_{};

private:
    f28335::CanNode &other_ = served.can_bus().join();
};

TEST_F(CanopenPair, MoveAsOneBySync)
{
    prepare(1);
    prepare(2);
    nmt(1);
    come.clear();
    shaft_              = {};
    double    apart_cnt = 0.0;
    double    load      = 0.0;
    const int length    = 800;
    for (int n = 0; n < length; n++) {
        const double time_s = n * sync_s;
        lead(static_cast<std::int32_t>(
            std::lround(per_turn * (1.0 - std::cos(circle * 0.5 * time_s)))));
        pass(sync_s);
        load      = std::max(load, served.can_bus().load());
        apart_cnt = std::max(apart_cnt, std::abs(shaft_.at(0) - shaft_.at(1)));
    }
    const std::vector<std::int32_t> one = answers(1);
    const std::vector<std::int32_t> two = answers(2);
    ASSERT_EQ(one.size(), static_cast<std::size_t>(length));
    ASSERT_EQ(two.size(), one.size());
    int seen_cnt = 0;
    int way_cnt  = 0;
    for (std::size_t n = 0; n < one.size(); n++) {
        seen_cnt = std::max(seen_cnt, std::abs(one[n] - two[n]));
        way_cnt  = std::max(way_cnt, one[n]);
    }
    std::printf("way %d counts; apart: %d counts as the drives say, %.1f counts the shafts; bus "
                "load %.1f %%\n",
                way_cnt, seen_cnt, apart_cnt, 100.0 * load);
    EXPECT_NEAR(way_cnt, 2 * per_turn, 20);
    EXPECT_LE(seen_cnt, 3);
    EXPECT_LE(apart_cnt, 5.0);
    EXPECT_EQ(findings_, 0);
    expect_no_findings();
}

} // namespace
