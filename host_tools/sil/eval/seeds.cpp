// SPDX-License-Identifier: MIT
#include "sil/eval/seeds.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/json.hpp"
#include "common/parallel.hpp"
#include "common/progress.hpp"
#include "sil/eval/results.hpp"

namespace sdre {
namespace {

// Fewer leave nothing beyond the quantile.
constexpr int seeds_for_99_percent = 100;

/// Metrics that have a value of their own rather than a size: their worst is the one furthest from the mean.
bool is_signed(const std::string &metric)
{
    return metric == "d_omega_hat" || metric == "d_q_hat" || metric == "d_d_hat" ||
           metric == "iq_A" || metric == "id_A" || metric == "offset_rpm";
}

/// The value that this share of the sorted ones does not pass.
double quantile(const std::vector<double> &sorted, double share)
{
    const double rank = std::ceil(share * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

SeedSpread spread_of(const std::string &metric, const std::vector<std::vector<Metrics>> &runs,
                     std::size_t measure)
{
    SeedSpread          s{metric, {}, {}, {}, {}, {}, {}};
    std::vector<double> values;
    for (const std::vector<Metrics> &run : runs) {
        for (const auto &[name, value] : metric_values(run[measure])) {
            if (name == metric) {
                values.push_back(value);
            }
        }
    }
    if (values.size() != runs.size()) {
        return s;
    }
    double sum = 0.0;
    for (double x : values) {
        sum += x;
    }
    s.mean              = sum / static_cast<double>(values.size());
    const double centre = is_signed(metric) ? *s.mean : 0.0;
    std::sort(values.begin(), values.end(),
              [centre](double a, double b) { return std::abs(a - centre) < std::abs(b - centre); });
    s.best   = values.front();
    s.worst  = values.back();
    s.median = quantile(values, 0.5);
    s.q95    = quantile(values, 0.95);
    s.q99    = quantile(values, 0.99);
    return s;
}

/// Results of one seed.
struct SeedRun {
    std::vector<Metrics> metrics;
    int                  fault        = 0;
    double               fault_time_s = 0.0;
    SimulationResult     result; ///< of seed 1 only: a trace is large
};

SeedRun run_seed(const Scenario &scenario, std::size_t seed, const Controller &controller,
                 const SeededRun &run_once)
{
    Scenario seeded         = scenario;
    seeded.seed             = seed;
    SimulationResult result = run_once(seeded, controller);
    SeedRun          run{measure(seeded, result.trace), result.fault, result.fault_time_s, {}};
    if (seed == 1) {
        run.result = std::move(result);
    }
    return run;
}

SeedRuns gathered(SeedRun *runs, std::size_t count)
{
    SeedRuns                          out;
    std::vector<std::vector<Metrics>> metrics;
    for (std::size_t i = 0; i < count; i++) {
        metrics.push_back(runs[i].metrics);
        if (runs[i].fault != 0) {
            out.faults++;
            out.fault_codes.insert(runs[i].fault);
            out.last_trip_s = std::max(out.last_trip_s, runs[i].fault_time_s);
        }
    }
    out.seeds         = static_cast<int>(count);
    out.first         = std::move(runs[0].result);
    out.first_metrics = metrics[0];
    for (std::size_t m = 0; m < metrics[0].size(); m++) {
        SeedMeasure entry{metrics[0][m].name, metrics[0][m].time_s, {}};
        for (const std::string &name : metric_names()) {
            entry.spread.push_back(spread_of(name, metrics, m));
        }
        out.measures.push_back(entry);
    }
    return out;
}

SimulationResult on_the_core(const Scenario &scenario, const Controller &controller)
{
    return simulate(scenario, controller);
}

} // namespace

SeedRuns run_seeds(const Scenario &scenario, int count)
{
    return run_seeds(std::vector<Scenario>{scenario}, count).at(0);
}

std::vector<SeedRuns> run_seeds(const std::vector<Scenario> &scenarios, int count)
{
    const auto              n = static_cast<std::size_t>(count);
    std::vector<Controller> controllers(scenarios.size());
    std::vector<SeedRun>    runs(scenarios.size() * n);
    Progress                progress(runs.size(), "runs");

    parallel_for(scenarios.size(),
                 [&](std::size_t i) { controllers[i] = prepare_controller(scenarios[i]); });
    parallel_for(runs.size(), [&](std::size_t i) {
        runs[i] = run_seed(scenarios[i / n], i % n + 1, controllers[i / n], on_the_core);
        progress.step();
    });
    std::vector<SeedRuns> out;
    for (std::size_t i = 0; i < scenarios.size(); i++) {
        out.push_back(gathered(&runs[i * n], n));
    }
    return out;
}

SeedRuns run_seeds_in_turn(const Scenario &scenario, int count, const SeededRun &run_once)
{
    const Controller     controller = prepare_controller(scenario);
    std::vector<SeedRun> runs(static_cast<std::size_t>(count));
    Progress             progress(runs.size(), "runs");
    for (std::size_t i = 0; i < runs.size(); i++) {
        runs[i] = run_seed(scenario, i + 1, controller, run_once);
        progress.step();
    }
    return gathered(runs.data(), runs.size());
}

std::string seeds_json(const Scenario &scenario, const SeedRuns &runs)
{
    Json measures = Json::object();
    for (const SeedMeasure &m : runs.measures) {
        Json worst  = Json::object();
        Json q99    = Json::object();
        Json q95    = Json::object();
        Json median = Json::object();
        Json mean   = Json::object();
        Json best   = Json::object();
        for (const SeedSpread &s : m.spread) {
            worst[s.metric]  = s.worst;
            q99[s.metric]    = s.q99;
            q95[s.metric]    = s.q95;
            median[s.metric] = s.median;
            mean[s.metric]   = s.mean;
            best[s.metric]   = s.best;
        }
        measures[m.name] = {{"time_s", m.time_s}, {"worst", worst}, {"q99", q99},  {"q95", q95},
                            {"median", median},   {"mean", mean},   {"best", best}};
    }
    const std::vector<int> codes(runs.fault_codes.begin(), runs.fault_codes.end());
    const Json             last_trip_s = runs.faults > 0 ? Json(runs.last_trip_s) : Json();
    const Json             out{{"scenario", scenario.name},
                   {"drive", scenario.drive.name},
                   {"gains", runs.first.compiled_table ? "compiled table" : "solved in process"},
                   {"uncertified", runs.first.uncertified},
                   {"seeds", runs.seeds},
                   {"faults", runs.faults},
                   {"fault_codes", codes},
                   {"last_trip_s", last_trip_s},
                   {"measures", measures}};
    return out.text();
}

std::string seeds_text(const Scenario &scenario, const SeedRuns &runs)
{
    std::string s =
        fmt::format("{} on {}, seeds 1 .. {}, gains: {}\n", scenario.name, scenario.drive.name,
                    runs.seeds, runs.first.compiled_table ? "compiled table" : "solved in process");
    for (const std::string &why : runs.first.uncertified) {
        s += fmt::format("not certified: {}\n", why);
    }
    if (runs.faults > 0) {
        s += fmt::format("FAULT {} in {} of {} seeds, the latest at {:.4f} s\n",
                         fmt::join(runs.fault_codes, ", "), runs.faults, runs.seeds,
                         runs.last_trip_s);
    }
    if (runs.measures.empty()) {
        return s + no_measures;
    }
    const bool many = runs.seeds >= seeds_for_99_percent;
    s += fmt::format("{:<26}", "");
    for (const SeedMeasure &m : runs.measures) {
        s += fmt::format("{:>18}{:>9}{:>9}{:>9}", m.name + " worst", many ? "99 %" : "95 %",
                         many ? "95 %" : "median", many ? "median" : "mean");
    }
    s += "\n";
    for (std::size_t row = 0; row < runs.measures[0].spread.size(); row++) {
        const MetricLabel &label = metric_label(runs.measures[0].spread[row].metric);
        s += fmt::format("{:<26}", label.text);
        for (const SeedMeasure &m : runs.measures) {
            const SeedSpread &x = m.spread[row];
            s += fmt::format("{:>18}{:>9}{:>9}{:>9}", metric_text(label, x.worst),
                             metric_text(label, many ? x.q99 : x.q95),
                             metric_text(label, many ? x.q95 : x.median),
                             metric_text(label, many ? x.median : x.mean));
        }
        s += "\n";
    }
    return s;
}

} // namespace sdre
