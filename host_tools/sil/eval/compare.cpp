// SPDX-License-Identifier: MIT
#include "sil/eval/compare.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/json.hpp"
#include "sil/eval/equal_noise.hpp"
#include "sil/eval/results.hpp"
#include "sil/eval/seeds.hpp"

namespace sdre {
namespace {

void require_metrics(const std::vector<std::string> &metrics)
{
    for (const std::string &name : metrics) {
        if (!is_metric_name(name)) {
            throw InputError(
                fmt::format("--metric {}: is not the name of a metric: must be one of {}", name,
                            fmt::join(metric_names(), ", ")));
        }
    }
}

std::map<std::string, CompareCell> cells_of(const SeedMeasure                   &measure,
                                            const std::map<std::string, double> &paper,
                                            const std::vector<std::string>      &metrics)
{
    std::map<std::string, CompareCell> cells;
    for (const std::string &metric : metrics) {
        CompareCell &cell = cells[metric];
        for (const SeedSpread &spread : measure.spread) {
            cell.value = spread.metric == metric ? spread.worst : cell.value;
        }
        if (const auto published = paper.find(metric); published != paper.end()) {
            cell.paper = published->second;
        }
    }
    return cells;
}

CompareRun run_of(const Scenario &scenario, const std::string &column, const SeedRuns &runs,
                  const std::vector<std::string> &metrics)
{
    CompareRun out{scenario.name, column, runs.faults, runs.first.uncertified.empty(), {}, {}};
    for (const SeedMeasure &measure : runs.measures) {
        const auto same = std::find_if(scenario.measures.begin(), scenario.measures.end(),
                                       [&](const Measure &m) { return m.name == measure.name; });
        out.measures.push_back(measure.name);
        out.cells[measure.name] = cells_of(measure, same->paper, metrics);
    }
    return out;
}

/// A column has the drive's name, or its file's without the ending when another drive has that name.
std::vector<std::string> drive_columns(const std::vector<std::filesystem::path> &files,
                                       const std::vector<std::string>           &names)
{
    std::vector<std::string> columns = names;
    for (std::size_t k = 0; k < names.size(); k++) {
        if (std::count(names.begin(), names.end(), names[k]) > 1) {
            columns[k] = files[k].stem().string();
        }
    }
    return columns;
}

/// The scenario as each column sees it: per drive, then per order.
std::vector<std::pair<std::string, Scenario>> variants(const CompareRequest        &request,
                                                       const std::filesystem::path &scenario)
{
    std::vector<std::filesystem::path> drives = request.drives;
    if (drives.empty()) {
        drives.emplace_back(); // the scenario's own
    }
    std::vector<Scenario>    read;
    std::vector<std::string> names;
    for (const std::filesystem::path &drive : drives) {
        read.push_back(read_scenario_file(scenario, drive));
        names.push_back(request.drives.empty() ? "own drive" : read.back().drive.name);
    }
    names = drive_columns(drives, names);
    std::vector<std::pair<std::string, Scenario>> out;
    for (std::size_t k = 0; k < drives.size(); k++) {
        Scenario          &s    = read[k];
        const std::string &name = names[k];
        if (request.orders.empty()) {
            out.emplace_back(name, s);
        }
        for (const int order : request.orders) {
            s.nosc_order = order;
            s.nodo_order = order;
            out.emplace_back(fmt::format("{}, order {}", name, order), s);
        }
    }
    return out;
}

/// The factor of every column, found on the first scenario.
std::vector<double> equal_factors(const CompareRequest &request, Comparison &c)
{
    std::optional<double> wanted_V = request.noise_V;
    std::vector<double>   factors;
    const auto            columns = variants(request, request.scenarios.front());
    for (const auto &[column, scenario] : columns) {
        (void)with_bandwidth(scenario.drive, 1.0); // refuses before anything runs
    }
    for (const auto &[column, scenario] : columns) {
        if (!wanted_V) {
            wanted_V = noise_V(scenario, request.seeds);
        }
        const NoiseMatch match = match_noise(scenario, wanted_V.value_or(0.0), request.seeds);
        factors.push_back(match.factor);
        if (!match.reached) {
            c.missed.push_back(fmt::format(
                "{}: {:.3g} V of noise in v_q cannot be reached; nearest is {:.3g} V with {}",
                column, *wanted_V, match.noise_V,
                knob_text(with_bandwidth(scenario.drive, match.factor))));
        }
    }
    return factors;
}

void require_different(const std::vector<std::string> &columns)
{
    for (const std::string &column : columns) {
        if (std::count(columns.begin(), columns.end(), column) > 1) {
            throw InputError(
                fmt::format("two columns are called \"{}\": every drive and order must "
                            "be there once",
                            column));
        }
    }
}

std::string value_text(const CompareRun &run, const MetricLabel &label, const CompareCell &cell)
{
    std::string s = run.faulted > 0 ? "fault" : metric_text(label, cell.value);
    if (cell.paper) {
        s += fmt::format(" (paper {})", metric_text(label, cell.paper));
    }
    return s;
}

} // namespace

const std::vector<std::string> &compare_default_metrics()
{
    static const std::vector<std::string> names{
        "settling_time_s", "dip_e_radps",    "overshoot_e_radps", "steady_state_error_e_radps",
        "ripple_e_radps",  "peak_current_A", "vq_noise_V",        "vd_noise_V"};
    return names;
}

Comparison compare(const CompareRequest &request)
{
    require_metrics(request.metrics);
    Comparison               c;
    std::set<std::string>    seen;
    std::vector<std::string> columns; ///< of all scenarios
    std::vector<Scenario>    all;
    c.metrics = request.metrics.empty() ? compare_default_metrics() : request.metrics;
    const std::vector<double> factors =
        request.equal_noise ? equal_factors(request, c) : std::vector<double>{};
    for (const std::filesystem::path &scenario : request.scenarios) {
        if (!seen.insert(scenario.stem().string()).second) {
            throw InputError(fmt::format("scenario {} is there twice", scenario.stem().string()));
        }
        c.columns.clear(); // the same of every scenario
        for (auto [column, variant] : variants(request, scenario)) {
            if (request.equal_noise) {
                variant.drive = with_bandwidth(variant.drive, factors[c.columns.size()]);
                column += ", " + knob_text(variant.drive);
            }
            c.columns.push_back(column);
            columns.push_back(column);
            all.push_back(variant);
        }
        require_different(c.columns);
    }
    std::vector<SeedRuns> runs = run_seeds(all, request.seeds);
    for (std::size_t i = 0; i < all.size(); i++) {
        c.runs.push_back(run_of(all[i], columns[i], runs[i], c.metrics));
        c.traces.push_back(std::move(runs[i].first.trace));
    }
    c.as_run = std::move(all);
    return c;
}

std::string compare_markdown(const Comparison &c)
{
    std::string s    = "| scenario | measure | metric |";
    std::string rule = "|---|---|---|";
    for (const std::string &column : c.columns) {
        s += fmt::format(" {} |", column);
        rule += "---:|";
    }
    s += "\n" + rule + "\n";
    const std::size_t width = c.columns.size();
    for (std::size_t first = 0; first < c.runs.size(); first += width) {
        for (const std::string &measure : c.runs[first].measures) {
            for (const std::string &metric : c.metrics) {
                const MetricLabel &label = metric_label(metric);
                s += fmt::format("| {} | {} | {} |", c.runs[first].scenario, measure, label.text);
                for (std::size_t i = first; i < first + width; i++) {
                    const CompareRun &run = c.runs[i];
                    const auto        row = run.cells.find(measure);
                    s += fmt::format(" {} |", row == run.cells.end()
                                                  ? "fault"
                                                  : value_text(run, label, row->second.at(metric)));
                }
                s += "\n";
            }
        }
    }
    for (const CompareRun &run : c.runs) {
        if (run.measures.empty()) {
            s += fmt::format("\n{}: {}", run.scenario, no_measures);
        }
        if (!run.certified) {
            s += fmt::format("\nnot certified: {} on {}\n", run.column, run.scenario);
        }
    }
    for (const std::string &line : c.missed) {
        s += "\n" + line + "\n";
    }
    return s;
}

std::string compare_csv(const Comparison &c)
{
    const auto number = [](const std::optional<double> &x) {
        return x ? fmt::format("{:.9g}", *x) : std::string();
    };
    std::string s = "scenario,measure,metric,drive,value,paper,faulted,certified\n";
    for (const CompareRun &run : c.runs) {
        for (const std::string &measure : run.measures) {
            for (const std::string &metric : c.metrics) {
                const CompareCell &cell = run.cells.at(measure).at(metric);
                s += fmt::format("{},{},{},\"{}\",{},{},{},{}\n", run.scenario, measure, metric,
                                 run.column, number(cell.value), number(cell.paper), run.faulted,
                                 run.certified);
            }
        }
    }
    return s;
}

std::string compare_json(const Comparison &c)
{
    Json runs = Json::array();
    for (const CompareRun &run : c.runs) {
        Json measures = Json::object();
        for (const std::string &measure : run.measures) {
            for (const std::string &metric : c.metrics) {
                const CompareCell &cell   = run.cells.at(measure).at(metric);
                measures[measure][metric] = {{"value", cell.value}, {"paper", cell.paper}};
            }
        }
        runs.push_back({{"scenario", run.scenario},
                        {"drive", run.column},
                        {"faulted", run.faulted},
                        {"certified", run.certified},
                        {"measures", measures}});
    }
    return Json{{"metrics", c.metrics}, {"runs", runs}}.text();
}

} // namespace sdre
