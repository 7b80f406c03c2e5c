// SPDX-License-Identifier: MIT
#include "sil/commission/faults.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/parallel.hpp"

namespace sdre {
namespace {

const std::vector<int> sensors{1, 2, 3};
const std::vector<int> wires{1, 2, 4};
constexpr int          channels = 3;
// Chosen: where a time lies in its part of a stage.
constexpr double place = 0.37;
// A jump within a period.
constexpr double at_once_1ps = 2.5e5;

using Spans = std::map<int, std::pair<double, double>>;

/// Begin and end of each stage of a healthy run.
Spans healthy_spans(const Drive &d, CommissionOptions o)
{
    o.trace_every            = 1;
    const CommissionRun good = commission(d, o);
    if (!good.finished()) {
        throw InputError(fmt::format("{}: the commissioning without a fault ends in {}: {}", d.name,
                                     commission_stage_name(good.during),
                                     commission_reason_text(good.reason)));
    }
    Spans spans;
    for (const CommissionRow &row : good.trace) {
        spans.emplace(row.stage, std::make_pair(row.time_s, row.time_s)).first->second.second =
            row.time_s;
    }
    return spans;
}

Scenario scenario_of(const Drive &d, const CommissionOptions &o, const CommissionCase &c)
{
    Scenario s = commission_scenario(d, o);
    if (c.fault.encoder_dead) {
        PlantChange change;
        change.time_s                = c.time_s;
        change.changes_plant         = false;
        change.sensors               = s.sensors;
        change.sensors->encoder_dead = true;
        s.changes                    = {change};
        return s;
    }
    for (std::size_t phase = 0; phase < channels; phase++) {
        if ((c.phases & (1 << phase)) != 0) {
            s.faults.push_back({c.time_s, c.fault.kind, phase, c.fault.value, c.fault.limit});
        }
    }
    return s;
}

std::string phases_text(const CommissionCase &c)
{
    std::string s;
    for (int phase = 0; c.fault.phases.size() > 1 && phase < channels; phase++) {
        if ((c.phases & (1 << phase)) != 0) {
            s += fmt::format(" {}", "abc"[phase]);
        }
    }
    return s;
}

} // namespace

std::vector<CommissionFault> commission_faults(const Drive &d)
{
    const double                 most_A = d.motor.max_current_A;
    std::vector<CommissionFault> all{
        {"sensor reads nothing", FaultKind::current_zero, 0.0, 0.0, sensors},
        {"sensor frozen", FaultKind::current_frozen, 0.0, 0.0, sensors}};
    for (const double rate_1ps : {5.0, 50.0, 250.0, at_once_1ps}) {
        for (const double sign : {1.0, -1.0}) {
            const double rate_Aps = sign * rate_1ps * most_A;
            all.push_back({rate_1ps == at_once_1ps
                               ? fmt::format("sensor off by {:+g} A", sign * most_A)
                               : fmt::format("sensor drifts {:+g} A/s", rate_Aps),
                           FaultKind::current_drift, rate_Aps, most_A, sensors});
        }
    }
    for (const double gain : {0.3, 0.5, 2.0, -1.0}) {
        all.push_back({fmt::format("sensor's gain x{:g}", gain), FaultKind::current_gain, gain, 0.0,
                       sensors, false, COMMISSION_LOOK});
    }
    all.push_back({"motor wire broken", FaultKind::phase_open, 0.0, 0.0, wires});
    all.push_back({"encoder stands still", FaultKind::encoder_losing, 0.0, 0.0, {1}, true});
    for (const double rate_1ps : {300.0, 5000.0}) {
        all.push_back({fmt::format("encoder loses {:g} counts/s", rate_1ps),
                       FaultKind::encoder_losing, rate_1ps});
    }
    return all;
}

std::vector<CommissionCase> commission_with_faults(const Drive &d, const CommissionOptions &o,
                                                   const std::vector<CommissionFault> &faults,
                                                   int                                 times)
{
    std::vector<CommissionCase> cases;
    for (const auto &[stage, span] : healthy_spans(d, o)) {
        for (int k = 0; k < times; k++) {
            const double time_s = span.first + (k + place) / times * (span.second - span.first);
            for (const CommissionFault &f : faults) {
                for (const int phases : f.phases) {
                    if (stage >= f.from_stage && stage <= COMMISSION_RING) {
                        cases.push_back({f, phases, stage, time_s});
                    }
                }
            }
        }
    }
    parallel_for(cases.size(), [&](std::size_t k) {
        CommissionCase     &c = cases[k];
        const CommissionRun r = commission_in(scenario_of(d, o, c), o);
        c.share               = r.peak_share();
        c.finished            = r.finished();
    });
    return cases;
}

const CommissionCase *worst_case(const std::vector<CommissionCase> &cases, int stage)
{
    const CommissionCase *worst = nullptr;
    for (const CommissionCase &c : cases) {
        if (c.stage == stage && (worst == nullptr || c.share > worst->share)) {
            worst = &c;
        }
    }
    return worst;
}

std::string case_text(const CommissionCase &c)
{
    return fmt::format("{:.2f} of the bound: {}{}, at {:.4f} s in {}{}", c.share, c.fault.name,
                       phases_text(c), c.time_s,
                       commission_stage_name(static_cast<commission_stage_t>(c.stage)),
                       c.finished ? ", finishes" : "");
}

std::string commission_fault_table(const std::vector<CommissionCase> &cases)
{
    std::vector<std::string>                     names;
    std::map<std::string, std::map<int, double>> rows;
    for (const CommissionCase &c : cases) {
        if (rows.find(c.fault.name) == rows.end()) {
            names.push_back(c.fault.name);
        }
        double &share = rows[c.fault.name][c.stage];
        share         = std::max(share, c.share);
    }
    std::string s = fmt::format("  {:<26}", "of the bound");
    for (int stage = COMMISSION_WATCH; stage <= COMMISSION_RING; stage++) {
        s += fmt::format(" {:>10}", commission_stage_name(static_cast<commission_stage_t>(stage)));
    }
    s += "\n";
    for (const std::string &name : names) {
        s += fmt::format("  {:<26}", name);
        for (int stage = COMMISSION_WATCH; stage <= COMMISSION_RING; stage++) {
            const auto at = rows[name].find(stage);
            s += at == rows[name].end() ? fmt::format(" {:>10}", "-")
                                        : fmt::format(" {:>10.2f}", at->second);
        }
        s += "\n";
    }
    return s;
}

} // namespace sdre
