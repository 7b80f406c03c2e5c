// SPDX-License-Identifier: MIT
#include "sil/eval/seeds.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/parallel.hpp"

namespace sdre {
namespace {

using nlohmann::ordered_json;

/// Metrics that have a value of their own rather than a size: their worst is the one furthest from the mean.
bool is_signed(const std::string &metric)
{
    return metric == "d_omega_hat" || metric == "d_q_hat" || metric == "d_d_hat" ||
           metric == "iq_A" || metric == "id_A" || metric == "offset_rpm";
}

SeedSpread spread_of(const std::string &metric, const std::vector<std::vector<Metrics>> &runs,
                     std::size_t measure)
{
    SeedSpread          s{metric, std::nullopt, std::nullopt};
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
    s.worst = *std::max_element(values.begin(), values.end(), [centre](double a, double b) {
        return std::abs(a - centre) < std::abs(b - centre);
    });
    return s;
}

ordered_json json_of(const std::optional<double> &value)
{
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

std::string text_of(const std::optional<double> &value)
{
    return value ? fmt::format("{:.5g}", *value) : "never";
}

} // namespace

SeedRuns run_seeds(const Scenario &scenario, int count)
{
    const Controller                  controller = prepare_controller(scenario);
    const auto                        n          = static_cast<std::size_t>(count);
    std::vector<std::vector<Metrics>> metrics(n);
    std::vector<int>                  faults(n, 0);
    SeedRuns                          out;

    parallel_for(n, [&](std::size_t i) {
        Scenario seeded         = scenario;
        seeded.seed             = i + 1;
        SimulationResult result = simulate(seeded, controller);
        metrics[i]              = measure(seeded, result.trace);
        faults[i]               = result.fault != 0 ? 1 : 0;
        if (i == 0) {
            out.first = std::move(result);
        }
    });

    out.seeds         = count;
    out.first_metrics = metrics[0];
    for (int fault : faults) {
        out.faults += fault;
    }
    for (std::size_t m = 0; m < metrics[0].size(); m++) {
        SeedMeasure entry{metrics[0][m].name, metrics[0][m].time_s, {}};
        for (const std::string &name : metric_names()) {
            entry.spread.push_back(spread_of(name, metrics, m));
        }
        out.measures.push_back(entry);
    }
    return out;
}

std::string seeds_json(const Scenario &scenario, const SeedRuns &runs)
{
    ordered_json measures = ordered_json::object();
    for (const SeedMeasure &m : runs.measures) {
        ordered_json worst = ordered_json::object();
        ordered_json mean  = ordered_json::object();
        for (const SeedSpread &s : m.spread) {
            worst[s.metric] = json_of(s.worst);
            mean[s.metric]  = json_of(s.mean);
        }
        measures[m.name] = {{"time_s", m.time_s}, {"worst", worst}, {"mean", mean}};
    }
    const ordered_json out{
        {"scenario", scenario.name},
        {"drive", scenario.drive.name},
        {"gains", runs.first.compiled_table ? "compiled table" : "solved in process"},
        {"uncertified", runs.first.uncertified},
        {"seeds", runs.seeds},
        {"faults", runs.faults},
        {"measures", measures}};
    return out.dump(2) + "\n";
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
        s += fmt::format("FAULT in {} of {} seeds\n", runs.faults, runs.seeds);
    }
    s += fmt::format("{:<28}", "");
    for (const SeedMeasure &m : runs.measures) {
        s += fmt::format("{:>16}{:>12}", m.name + " worst", "mean");
    }
    s += "\n";
    for (std::size_t row = 0; !runs.measures.empty() && row < runs.measures[0].spread.size();
         row++) {
        s += fmt::format("{:<28}", runs.measures[0].spread[row].metric);
        for (const SeedMeasure &m : runs.measures) {
            s += fmt::format("{:>16}{:>12}", text_of(m.spread[row].worst),
                             text_of(m.spread[row].mean));
        }
        s += "\n";
    }
    return s;
}

} // namespace sdre
