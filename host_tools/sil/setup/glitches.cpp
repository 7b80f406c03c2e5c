// SPDX-License-Identifier: MIT
#include "sil/setup/glitches.hpp"

#include "sil/setup/sorted_times.hpp"

namespace sdre {
namespace {

constexpr Range  time_range_s{0.0, 1e4};
constexpr Range  samples_range{1, 1e6};
constexpr Range  counts_range{-1e6, 1e6};
constexpr Range  current_range_A{-1e4, 1e4};
constexpr double early_periods = 1e-6; // an entry and a tick that mean the same instant

} // namespace

std::vector<Glitch> read_glitches(TomlReader &t)
{
    std::vector<Glitch> glitches;
    for (TomlReader &entry : t.tables("glitch")) {
        Glitch g;
        g.time_s      = entry.number("time_s", time_range_s);
        g.samples     = entry.integer_or("samples", samples_range, g.samples);
        g.encoder_cnt = entry.integer_or("encoder_cnt", counts_range, g.encoder_cnt);
        g.ia_A        = entry.number_or("ia_A", current_range_A, g.ia_A);
        g.ib_A        = entry.number_or("ib_A", current_range_A, g.ib_A);
        entry.reject_unknown_keys();
        glitches.push_back(g);
    }
    require_sorted(t, "glitch", glitches);
    return glitches;
}

Glitch glitch_at(const std::vector<Glitch> &glitches, double time_s, double period_s)
{
    for (const Glitch &g : glitches) {
        const double since = (time_s - g.time_s) / period_s + early_periods;
        if (since >= 0.0 && since < g.samples) {
            return g;
        }
    }
    return {};
}

} // namespace sdre
