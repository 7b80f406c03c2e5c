// SPDX-License-Identifier: MIT
#include "sil/f28335/gate_edges.hpp"

#include <algorithm>
#include <initializer_list>

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
constexpr int aq_none = 12; // reserved: no action

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

struct Candidate {
    bool happens;
    int  field;
};

/// Action of the first event in order of priority that happens and has an action.
int field_of(std::uint16_t aqctl, std::initializer_list<Candidate> by_priority)
{
    for (const Candidate &c : by_priority) {
        if (c.happens && has_action(aqctl, c.field)) {
            return c.field;
        }
    }
    return aq_none;
}

/// Action at TBPRD. There the counter counts down, as its definition says.
int field_at_top(std::uint16_t aqctl, int tbprd, int cmpa, int cmpb)
{
    const bool a = cmpa >= tbprd;
    const bool b = cmpb >= tbprd;
    return field_of(aqctl, {{b, aq_cbd}, {a, aq_cad}, {true, aq_prd}, {b, aq_cbu}, {a, aq_cau}});
}

/// Action at ZERO. There the counter counts up, as its definition says.
int field_at_zero(std::uint16_t aqctl, int cmpa, int cmpb)
{
    const bool a = cmpa == 0;
    const bool b = cmpb == 0;
    return field_of(aqctl, {{b, aq_cbu}, {a, aq_cau}, {true, aq_zero}, {b, aq_cbd}, {a, aq_cad}});
}

struct Action {
    int time_cnt;
    int field;
};

/// All actions on a signal in the period, in order of time.
std::vector<Action> actions_of(const LegRegisters &r, std::uint16_t aqctl, Count count)
{
    std::vector<Action> actions;
    const bool          down = count != Count::up;
    const bool          up   = count != Count::down;
    const int           zero = down ? r.tbprd : 0; // time of ZERO
    const int           a    = r.cmpa_at_start.value_or(r.cmpa);
    const int           b    = r.cmpb_at_start.value_or(r.cmpb);
    if (down) {
        actions.push_back({0, field_at_top(aqctl, r.tbprd, a, b)});
    }
    if (up) {
        actions.push_back(
            {zero, down ? field_at_zero(aqctl, r.cmpa, r.cmpb) : field_at_zero(aqctl, a, b)});
    }
    const auto add_compare = [&](int value, int field_down, int field_up) {
        if (value <= 0 || value >= r.tbprd) {
            return;
        }
        if (down) {
            actions.push_back({zero - value, field_down});
        }
        if (up) {
            actions.push_back({zero + value, field_up});
        }
    };
    add_compare(r.cmpa, aq_cad, aq_cau);
    add_compare(r.cmpb, aq_cbd, aq_cbu);
    std::stable_sort(actions.begin(), actions.end(),
                     [](const Action &x, const Action &y) { return x.time_cnt < y.time_cnt; });
    return actions;
}

/// EQ-GATES-1
std::vector<SignalEdge> qualified(const LegRegisters &r, std::uint16_t aqctl, Count count,
                                  SignalMemory &memory)
{
    std::vector<SignalEdge> edges;
    edges.push_back({0, memory.level});
    for (const Action &action : actions_of(r, aqctl, count)) {
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

/// One output of the action qualifier over the period, and what it was before.
struct Signal {
    std::vector<SignalEdge> edges;
    SignalMemory            before;

    bool level(int t) const
    {
        return level_at(edges, t);
    }
    int since_rise(int t) const
    {
        return t - last_change(edges, t, true, before.last_rise, before.level);
    }
    int since_fall(int t) const
    {
        return t - last_change(edges, t, false, before.last_fall, before.level);
    }
};

Signal signal_of(const LegRegisters &r, std::uint16_t aqctl, Count count, SignalMemory &memory)
{
    const SignalMemory before = memory;
    return {qualified(r, aqctl, count, memory), before};
}

/// EQ-GATES-2
bool upper_at(const DeadBand &d, const Signal &a, const Signal &b, int t)
{
    if (!d.a_delayed) {
        return a.level(t);
    }
    const Signal &in = d.red_from_b ? b : a;
    return (in.level(t) && in.since_rise(t) >= d.red) != d.a_inverted;
}

/// EQ-GATES-3
bool lower_at(const DeadBand &d, const Signal &a, const Signal &b, int t)
{
    if (!d.b_delayed) {
        return b.level(t);
    }
    const Signal &in = d.fed_from_b ? b : a;
    return (in.level(t) || in.since_fall(t) < d.fed) != d.b_inverted;
}

/// All times at which a gate may change, in order; some are outside of the period.
std::vector<int> possible_times(const DeadBand &d, const Signal &a, const Signal &b)
{
    std::vector<int> times{0};
    for (const Signal *s : {&a, &b}) {
        for (const SignalEdge &e : s->edges) {
            times.insert(times.end(), {e.time_cnt, e.time_cnt + d.red, e.time_cnt + d.fed});
        }
        times.insert(times.end(), {s->before.last_rise + d.red, s->before.last_fall + d.fed});
    }
    std::sort(times.begin(), times.end());
    return times;
}

std::vector<GateEdge> gates_of(const DeadBand &d, const Signal &a, const Signal &b, int period)
{
    std::vector<GateEdge> gates;
    for (const int t : possible_times(d, a, b)) {
        if (t < 0 || t >= period) {
            continue;
        }
        const GateEdge now{t, upper_at(d, a, b, t), lower_at(d, a, b, t)};
        if (gates.empty() || gates.back().upper != now.upper || gates.back().lower != now.lower) {
            gates.push_back(now);
        }
    }
    return gates;
}

} // namespace

LegPeriod leg_period(const LegRegisters &r, Count count, LegMemory &memory)
{
    const Signal   a      = signal_of(r, r.aqctla, count, memory.a);
    const Signal   b      = signal_of(r, r.aqctlb, count, memory.b);
    const DeadBand d      = dead_band_of(r);
    const int      period = period_counts(r.tbprd, count);

    LegPeriod out;
    out.a             = a.edges;
    out.gates         = gates_of(d, a, b, period);
    out.complementary = d.a_delayed && d.b_delayed && !d.a_inverted && d.b_inverted &&
                        !d.red_from_b && !d.fed_from_b;
    out.rise_delay_cnt = d.red;
    out.fall_delay_cnt = d.fed;
    for (SignalMemory *m : {&memory.a, &memory.b}) {
        m->last_rise = std::max(m->last_rise - period, long_ago_cnt);
        m->last_fall = std::max(m->last_fall - period, long_ago_cnt);
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
