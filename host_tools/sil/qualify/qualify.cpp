// SPDX-License-Identifier: MIT
#include "sil/qualify/qualify.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "design/design.hpp"
#include "sil/eval/random_motors.hpp"
#include "sil/eval/seeds.hpp"
#include "sil/qualify/rivals.hpp"
#include "sil/qualify/words.hpp"
#include "sil/run/simulation.hpp"
#include "tune/start_weights.hpp"

namespace sdre {
namespace {

constexpr double share_limit = 0.99; // of random motors

TrialResult result_of(const Trial &trial, const SeedRuns &runs)
{
    TrialResult        r;
    const SeedMeasure &m = runs.measures.back();
    r.what               = trial.what;
    r.faults             = runs.faults;
    r.settling_time_s    = m.worst("settling_time_s");
    r.dip_e_radps        = m.worst("dip_e_radps").value_or(0.0);
    r.ripple_e_radps     = m.worst("ripple_e_radps").value_or(0.0);
    r.voltage_noise_V    = m.worst("vq_noise_V").value_or(0.0);
    r.vd_noise_V         = m.worst("vd_noise_V").value_or(0.0);
    for (const SeedMeasure &each : runs.measures) {
        r.peak_current_A = std::max(r.peak_current_A, each.worst("peak_current_A").value_or(0.0));
    }
    return r;
}

void judge(const Trial &t, int seeds, double limit_A, TrialResult &r)
{
    if (r.faults > 0 && !t.may_trip) {
        r.reasons.push_back(fmt::format("trips in {} of {} seeds", r.faults, seeds));
    }
    if (!r.settling_time_s && t.must_settle && r.faults == 0) {
        r.reasons.push_back("does not settle");
    }
    const double peak = (t.may_trip ? 2.0 : peak_ratio) * limit_A;
    beyond(r.reasons, "peak current", r.peak_current_A, peak, "A");
    beyond(r.reasons, "dip", r.dip_e_radps, t.most_dip_e_radps, "rad/s");
    beyond(r.reasons, "settling", r.settling_time_s.value_or(0.0), t.most_settling_s, "ms", 1e3);
    beyond(r.reasons, "noise of v_q", r.voltage_noise_V, t.most_noise_V, "V");
}

std::vector<TrialResult> run_trials(const std::vector<Trial> &trials, int seeds)
{
    std::vector<Scenario> scenarios;
    for (const Trial &t : trials) {
        scenarios.push_back(t.scenario);
    }
    const std::vector<SeedRuns> runs = run_seeds(scenarios, seeds);
    std::vector<TrialResult>    results;
    for (std::size_t i = 0; i < trials.size(); i++) {
        results.push_back(result_of(trials[i], runs[i]));
        judge(trials[i], seeds, trials[i].scenario.drive.motor.max_current_A, results.back());
    }
    return results;
}

MotorShare share_of(const Scenario &scenario, int count)
{
    MotorShare s{count, 0};
    if (count > 0) {
        s.good = run_random_motors(scenario, count).good();
    }
    return s;
}

/// A drive is not good when the usual law is as quiet and better. A better rival of another law is told (words.hpp).
void compare(Qualification &q, const Trial &load_step, int seeds)
{
    const TrialResult &own = q.trials.front();
    q.rivals               = best_rivals(load_step, own, seeds, [](const Trial &trial, int count) {
        return run_trials({trial}, count).front();
    });
    for (const Rival &rival : q.rivals) {
        if (!rival.law->usual || !rival.load_step || !own.settling_time_s) {
            continue;
        }
        const TrialResult &r = *rival.load_step;
        if (own.dip_e_radps > same_within * r.dip_e_radps) {
            q.reasons.push_back(fmt::format("load step: dip {:.4g} rad/s, {} has {:.4g}",
                                            own.dip_e_radps, rival.law->name, r.dip_e_radps));
        }
        if (*own.settling_time_s > same_within * *r.settling_time_s) {
            q.reasons.push_back(fmt::format("load step: settles in {:.4g} ms, {} in {:.4g}",
                                            1e3 * *own.settling_time_s, rival.law->name,
                                            1e3 * *r.settling_time_s));
        }
    }
}

} // namespace

Qualification qualify(const Drive &drive, const QualifyOptions &o)
{
    const Plan    plan = qualification_plan(drive, o.noise_share);
    Qualification q;
    q.drive                       = drive.name;
    q.inverter                    = drive.inverter;
    q.limit_A                     = drive.motor.max_current_A;
    q.circle_V                    = drive.inverter.dc_link_V / std::sqrt(3.0);
    q.periods_per_edge            = periods_per_edge(drive);
    q.lines                       = drive.encoder.lines;
    const Certificate certificate = design_drive(drive).certificate;
    q.certified                   = certificate.passed();
    if (!q.certified) {
        q.reasons.push_back(
            fmt::format("not certified: {}", fmt::join(certificate.failures, "; ")));
    }
    q.trials = run_trials(plan.trials, o.seeds);
    for (const TrialResult &r : q.trials) {
        for (const std::string &reason : r.reasons) {
            q.reasons.push_back(fmt::format("{}: {}", r.what, reason));
        }
    }
    q.torques = torque_trial(drive, o.seeds);
    for (const std::string &reason : q.torques ? q.torques->reasons : std::vector<std::string>{}) {
        q.reasons.push_back("torques: " + reason);
    }
    q.map = plane_map(drive, o.side, o.seeds);
    for (const std::string &reason : map_reasons(q.map)) {
        q.reasons.push_back(reason);
    }
    q.motors = share_of(plan.motors, o.motors);
    q.wide   = share_of(plan.wide_motors, o.motors / 5);
    if (q.motors.share() < share_limit) {
        q.reasons.push_back(fmt::format("{} of {} motors fail, at least {:g} % have to be good",
                                        q.motors.count - q.motors.good, q.motors.count,
                                        100.0 * share_limit));
    }
    if (o.against && !is_cascade(drive.law)) {
        compare(q, plan.trials.front(), o.seeds);
    }
    return q;
}

} // namespace sdre
