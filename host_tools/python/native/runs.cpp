// SPDX-License-Identifier: MIT
/// Scenarios and their runs, as `sdre-sil run`.
#include "bindings.hpp"

#include <filesystem>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "common/errors.hpp"
#include "common/toml_reader.hpp"
#include "sil/eval/plot.hpp"
#include "sil/eval/results.hpp"
#include "sil/run/trace_columns.hpp"

namespace nb = nanobind;

namespace sdre {
namespace {

/// A text, read as if it stood in the directory `where`.
Scenario read_scenario_text(const std::string &text, const std::string &source,
                            const std::string &name, const std::string &where, const Drive *drive)
{
    const toml::table          root = parse_toml_text(text, source);
    std::optional<std::string> named =
        drive == nullptr || root.contains("drive")
            ? std::optional<std::string>(TomlReader(source, "", root).text("drive"))
            : std::nullopt;
    std::optional<Drive> own;
    if (named) {
        own = read_drive_file(
            scenario_drive_path(std::filesystem::path(where) / "scenario.toml", *named));
    }
    const Drive &used = drive != nullptr ? *drive : *own;
    return read_scenario_table(root, source, name, used, own ? own->law : used.law);
}

struct Run {
    Scenario             scenario;
    SimulationResult     result;
    std::vector<Metrics> metrics;
};

Run run(const Scenario &scenario)
{
    const nb::gil_scoped_release free;
    Run                          r{scenario, simulate(scenario), {}};
    r.metrics = measure(scenario, r.result.trace);
    return r;
}

/// One row for each quantity of trace_columns().
nb::object table(const Run &r)
{
    const Trace        &trace = r.result.trace;
    std::vector<double> values;
    values.reserve(trace_columns().size() * trace.size());
    for (const TraceColumn &column : trace_columns()) {
        for (const TraceRow &row : trace) {
            values.push_back(column.of(row));
        }
    }
    return nb::cast(numpy_array(std::move(values), {trace_columns().size(), trace.size()}));
}

std::vector<std::string> column_names()
{
    std::vector<std::string> names;
    for (const TraceColumn &column : trace_columns()) {
        names.emplace_back(column.name);
    }
    return names;
}

} // namespace

void bind_runs(nb::module_ &m)
{
    nb::class_<Scenario>(m, "Scenario")
        .def_ro("name", &Scenario::name)
        .def_ro("drive", &Scenario::drive)
        .def_ro("duration_s", &Scenario::duration_s)
        .def_ro("initial_speed_e_radps", &Scenario::initial_speed_e_radps)
        .def_rw("seed", &Scenario::seed);
    nb::class_<Run>(m, "Run")
        .def_prop_ro("table", &table)
        .def_prop_ro("csv",
                     [](const Run &r) {
                         const nb::gil_scoped_release free;
                         return trace_csv(r.result.trace);
                     })
        .def_prop_ro("json",
                     [](const Run &r) { return result_json(r.scenario, r.result, r.metrics); })
        .def_prop_ro("marks", [](const Run &r) { return trace_marks(r.scenario, r.result.trace); })
        .def_prop_ro("text",
                     [](const Run &r) { return result_text(r.scenario, r.result, r.metrics); });
    m.attr("trace_columns") = column_names();
    m.attr("metric_names")  = metric_names();
    m.def("read_scenario", &read_scenario_text, nb::arg("text"), nb::arg("source"), nb::arg("name"),
          nb::arg("where"), nb::arg("drive").none());
    m.def("run", &run);
}

} // namespace sdre
