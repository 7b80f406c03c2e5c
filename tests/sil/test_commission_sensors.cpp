// SPDX-License-Identifier: MIT
/// Current sensors that fail during the self-commissioning of the shipped motor, at a bound of 3 A.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "shipped_drive.hpp"
#include "sil/commission/bench.hpp"

using namespace sdre;

namespace {

struct SensorFault {
    const char *name;
    FaultKind   kind;
    double      value = 0.0;
    double      limit = 0.0;
};

struct Case {
    SensorFault fault;
    int         sensors = 0; ///< bit 0: a, bit 1: b
    int         stage   = 0;
    double      time_s  = 0.0;
    double      share   = 0.0; ///< largest true current, of the bound
    bool        ended   = false;
};

constexpr double bound_share = 0.75; // 3 A of 4 A

/// Every fault of one sensor or both, at `instants` times of each stage from the check on.
std::vector<Case> cases_of(const Drive &d, const std::vector<SensorFault> &faults, int instants)
{
    CommissionOptions o;
    o.current_share          = bound_share;
    o.trace_every            = 1;
    const CommissionRun good = commission(d, o);
    EXPECT_TRUE(good.finished());
    std::map<int, std::pair<double, double>> stages;
    for (const CommissionRow &row : good.trace) {
        stages.emplace(row.stage, std::make_pair(row.time_s, row.time_s)).first->second.second =
            row.time_s;
    }
    std::vector<Case> cases;
    for (int stage = COMMISSION_WATCH; stage <= COMMISSION_SPIN; stage++) {
        const auto [from_s, to_s] = stages.at(stage);
        for (int k = 0; k < instants; k++) {
            const double time_s = from_s + (k + 0.37) / instants * (to_s - from_s);
            for (const SensorFault &f : faults) {
                for (int sensors = 1; sensors <= 3; sensors++) {
                    cases.push_back({f, sensors, stage, time_s});
                }
            }
        }
    }
    return cases;
}

void run(const Drive &d, std::vector<Case> &cases)
{
    CommissionOptions o;
    o.current_share = bound_share;
    parallel_for(cases.size(), [&](std::size_t k) {
        Case    &c = cases[k];
        Scenario s = commission_scenario(d, o);
        for (std::size_t phase = 0; phase < 2; phase++) {
            if ((c.sensors & (1 << phase)) != 0) {
                s.faults.push_back({c.time_s, c.fault.kind, phase, c.fault.value, c.fault.limit});
            }
        }
        const CommissionRun r = commission_in(s, o);
        c.share               = r.peak_current_A / (bound_share * d.motor.max_current_A);
        c.ended               = !r.finished();
    });
}

/// Prints the largest true current of each stage; each stage has its limit.
void expect_peaks(const std::vector<Case> &cases, const std::map<int, double> &limits)
{
    for (const auto &[stage, limit] : limits) {
        const Case *worst = nullptr;
        for (const Case &c : cases) {
            if (c.stage == stage && (worst == nullptr || c.share > worst->share)) {
                worst = &c;
            }
        }
        ASSERT_NE(worst, nullptr);
        const std::string text =
            fmt::format("{:<10} {:.2f} of the bound: {} {:g}, sensors {}, at {:.4f} s",
                        commission_stage_name(static_cast<commission_stage_t>(stage)), worst->share,
                        worst->fault.name, worst->fault.value, worst->sensors, worst->time_s);
        fmt::print("{}\n", text);
        EXPECT_LE(worst->share, limit) << text;
    }
}

// A tenth above the largest in docs/commissioning.md.
const std::map<int, double> dead_limits{{COMMISSION_WATCH, 0.3},      {COMMISSION_LOOK, 0.9},
                                        {COMMISSION_RESISTANCE, 2.8}, {COMMISSION_DRAG, 1.55},
                                        {COMMISSION_MAP, 1.45},       {COMMISSION_SPIN, 1.15}};
const std::map<int, double> peak_limits{{COMMISSION_WATCH, 0.3},      {COMMISSION_LOOK, 2.2},
                                        {COMMISSION_RESISTANCE, 2.8}, {COMMISSION_DRAG, 1.9},
                                        {COMMISSION_MAP, 1.9},        {COMMISSION_SPIN, 1.2}};

} // namespace

/// A sensor that is dead or frozen never lets the commissioning finish.
TEST(CommissionSensors, DeadAndFrozen)
{
    const Drive       d = read_drive_file(support::shipped_drive("ipmsm_390w"));
    std::vector<Case> cases =
        cases_of(d, {{"zero", FaultKind::current_zero}, {"frozen", FaultKind::current_frozen}}, 2);
    run(d, cases);
    expect_peaks(cases, dead_limits);
    for (const Case &c : cases) {
        EXPECT_TRUE(c.ended) << c.fault.name << " " << c.sensors << " at " << c.time_s;
    }
}

/// Every fault at eight times of each stage. Both sensors with the same wrong gain from the start look like another
/// motor: the first stage has no gains.
TEST(CommissionSensorsAll, EveryFault)
{
    const Drive              d     = read_drive_file(support::shipped_drive("ipmsm_390w"));
    std::vector<SensorFault> drift = {{"zero", FaultKind::current_zero},
                                      {"frozen", FaultKind::current_frozen}};
    for (const double rate_Aps : {20.0, 200.0, 1000.0}) {
        drift.push_back({"drift", FaultKind::current_drift, rate_Aps, 4.0});
        drift.push_back({"drift", FaultKind::current_drift, -rate_Aps, 4.0});
    }
    std::vector<Case> cases = cases_of(d, drift, 8);
    std::vector<Case> gains = cases_of(d,
                                       {{"gain", FaultKind::current_gain, 0.3},
                                        {"gain", FaultKind::current_gain, 0.5},
                                        {"gain", FaultKind::current_gain, 2.0},
                                        {"gain", FaultKind::current_gain, -1.0}},
                                       8);
    std::copy_if(gains.begin(), gains.end(), std::back_inserter(cases),
                 [](const Case &c) { return c.stage != COMMISSION_WATCH; });
    run(d, cases);
    const auto over =
        std::count_if(cases.begin(), cases.end(), [](const Case &c) { return c.share > 1.5; });
    fmt::print("{} of {} above 1.5 of the bound\n", over, cases.size());
    expect_peaks(cases, peak_limits);
}
