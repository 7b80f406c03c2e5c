// SPDX-License-Identifier: MIT
#include "sil/f28335/gate_edges.hpp"

#include <algorithm>

namespace sdre::f28335 {
namespace {

constexpr int delay_mask = 0x3FF;

// Positions of the fields in AQCTLx, and their values.
constexpr int aq_zero = 0;
constexpr int aq_prd  = 2;
constexpr int aq_cau  = 4;
constexpr int aq_cad  = 6;
constexpr int aq_cbu  = 8;
constexpr int aq_cbd  = 10;

bool acted(std::uint16_t aqctl, int field, bool level)
{
    switch ((aqctl >> field) & 3) {
    case 1:
        return false;
    case 2:
        return true;
    case 3:
        return !level;
    default:
        return level;
    }
}

bool has_action(std::uint16_t aqctl, int field)
{
    return ((aqctl >> field) & 3) != 0;
}

/// The compare event beats the counter's own; of the compares B beats A.
int field_at_end(std::uint16_t aqctl, bool a_equal, int a_field, bool b_equal, int b_field,
                 int counter_field)
{
    if (b_equal && has_action(aqctl, b_field)) {
        return b_field;
    }
    return a_equal && has_action(aqctl, a_field) ? a_field : counter_field;
}

/// EQ-GATES-1
std::vector<SignalEdge> qualified(const LegRegisters &r, std::uint16_t aqctl, SignalMemory &memory)
{
    struct Action {
        int time_cnt;
        int field;
    };
    std::vector<Action> actions;
    actions.push_back(
        {0, field_at_end(aqctl, r.cmpa >= r.tbprd, aq_cad, r.cmpb >= r.tbprd, aq_cbd, aq_prd)});
    actions.push_back(
        {r.tbprd, field_at_end(aqctl, r.cmpa == 0, aq_cau, r.cmpb == 0, aq_cbu, aq_zero)});
    const auto add_compare = [&](int value, int down, int up) {
        if (value > 0 && value < r.tbprd) {
            actions.push_back({r.tbprd - value, down});
            actions.push_back({r.tbprd + value, up});
        }
    };
    add_compare(r.cmpa, aq_cad, aq_cau);
    add_compare(r.cmpb, aq_cbd, aq_cbu);
    std::stable_sort(actions.begin(), actions.end(),
                     [](const Action &x, const Action &y) { return x.time_cnt < y.time_cnt; });

    std::vector<SignalEdge> edges;
    edges.push_back({0, memory.level});
    for (const Action &action : actions) {
        const bool level = acted(aqctl, action.field, memory.level);
        if (level == memory.level) {
            continue;
        }
        memory.level                                  = level;
        (level ? memory.last_rise : memory.last_fall) = action.time_cnt;
        if (edges.back().time_cnt == action.time_cnt) {
            edges.back().level = level;
        } else {
            edges.push_back({action.time_cnt, level});
        }
    }
    return edges;
}

bool level_at(const std::vector<SignalEdge> &edges, int time_cnt)
{
    bool level = edges.front().level;
    for (const SignalEdge &e : edges) {
        if (e.time_cnt <= time_cnt) {
            level = e.level;
        }
    }
    return level;
}

/// Last change to `level` at or before a time; the memory's when there is none in this period.
int last_change(const std::vector<SignalEdge> &edges, int time_cnt, bool to_level, int before,
                bool level_before)
{
    int  last  = before;
    bool level = level_before;
    for (const SignalEdge &e : edges) {
        if (e.time_cnt <= time_cnt && e.level != level && e.level == to_level) {
            last = e.time_cnt;
        }
        level = e.level;
    }
    return last;
}

struct DeadBand {
    int  red;
    int  fed;
    bool a_delayed; ///< A is the rising-edge path, otherwise A itself
    bool b_delayed; ///< B is the falling-edge path, otherwise B itself
    bool a_inverted;
    bool b_inverted;
    bool red_from_b;
    bool fed_from_b;
};

DeadBand dead_band_of(const LegRegisters &r)
{
    const unsigned out = r.dbctl & 3U;
    const unsigned pol = (r.dbctl >> 2U) & 3U;
    const unsigned in  = (r.dbctl >> 4U) & 3U;
    return {r.dbred & delay_mask, r.dbfed & delay_mask, (out & 2U) != 0U, (out & 1U) != 0U,
            (pol & 1U) != 0U,     (pol & 2U) != 0U,     (in & 1U) != 0U,  (in & 2U) != 0U};
}

} // namespace

LegPeriod leg_period(const LegRegisters &r, LegMemory &memory)
{
    const LegMemory               before = memory;
    const std::vector<SignalEdge> a      = qualified(r, r.aqctla, memory.a);
    const std::vector<SignalEdge> b      = qualified(r, r.aqctlb, memory.b);
    const DeadBand                d      = dead_band_of(r);
    const int                     period = 2 * r.tbprd;

    const auto rise = [&](bool of_b, int t) {
        return of_b ? last_change(b, t, true, before.b.last_rise, before.b.level)
                    : last_change(a, t, true, before.a.last_rise, before.a.level);
    };
    const auto fall = [&](bool of_b, int t) {
        return of_b ? last_change(b, t, false, before.b.last_fall, before.b.level)
                    : last_change(a, t, false, before.a.last_fall, before.a.level);
    };
    // EQ-GATES-2, EQ-GATES-3
    const auto upper_at = [&](int t) {
        const bool in    = level_at(d.red_from_b ? b : a, t);
        const bool level = d.a_delayed ? in && t - rise(d.red_from_b, t) >= d.red : level_at(a, t);
        return level != (d.a_delayed && d.a_inverted);
    };
    const auto lower_at = [&](int t) {
        const bool in    = level_at(d.fed_from_b ? b : a, t);
        const bool level = d.b_delayed ? in || t - fall(d.fed_from_b, t) < d.fed : level_at(b, t);
        return level != (d.b_delayed && d.b_inverted);
    };

    std::vector<int> times{0};
    for (const auto *edges : {&a, &b}) {
        for (const SignalEdge &e : *edges) {
            times.insert(times.end(), {e.time_cnt, e.time_cnt + d.red, e.time_cnt + d.fed});
        }
    }
    for (const SignalMemory &m : {before.a, before.b}) {
        times.insert(times.end(), {m.last_rise + d.red, m.last_fall + d.fed});
    }
    std::sort(times.begin(), times.end());

    LegPeriod out;
    out.a = a;
    for (const int t : times) {
        if (t < 0 || t >= period) {
            continue;
        }
        const GateEdge now{t, upper_at(t), lower_at(t)};
        if (out.gates.empty() || out.gates.back().upper != now.upper ||
            out.gates.back().lower != now.lower) {
            out.gates.push_back(now);
        }
    }
    out.complementary = d.a_delayed && d.b_delayed && !d.a_inverted && d.b_inverted &&
                        !d.red_from_b && !d.fed_from_b;
    out.rise_delay_cnt = d.red;
    out.fall_delay_cnt = d.fed;
    for (SignalMemory *m : {&memory.a, &memory.b}) {
        m->last_rise -= period;
        m->last_fall -= period;
    }
    return out;
}

std::optional<int> shortest_gap_cnt(const std::vector<GateEdge> &gates)
{
    std::optional<int> shortest;
    int                off_since = 0;
    int                was       = 0; // 1 upper, -1 lower: the last one that was on
    bool               was_off   = false;
    for (const GateEdge &e : gates) {
        if (e.upper && e.lower) {
            return -1;
        }
        const int is = e.upper ? 1 : e.lower ? -1 : 0;
        if (is == 0) {
            off_since = e.time_cnt;
            was_off   = true;
            continue;
        }
        if (was != 0 && is != was) {
            const int gap = was_off ? e.time_cnt - off_since : 0;
            shortest      = shortest ? std::min(*shortest, gap) : gap;
        }
        was     = is;
        was_off = false;
    }
    return shortest;
}

} // namespace sdre::f28335
