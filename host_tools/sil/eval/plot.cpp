// SPDX-License-Identifier: MIT
#include "sil/eval/plot.hpp"

#include <cstdlib>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "common/child_process.hpp"
#include "common/data_files.hpp"
#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "common/json.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/eval/results.hpp"

namespace sdre {
namespace {

/// A directory for what the script reads and writes.
class Workplace {
public:
    Workplace()
    {
        std::error_code error;
        std::string name = (std::filesystem::temp_directory_path(error) / "sdre-XXXXXX").string();
        if (error || mkdtemp(name.data()) == nullptr) {
            throw InputError("--plot: there is no directory for temporary files (TMPDIR)");
        }
        path_ = name;
    }
    ~Workplace()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Workplace(const Workplace &)            = delete;
    Workplace &operator=(const Workplace &) = delete;

    std::filesystem::path operator/(const std::string &name) const
    {
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

/// The build's Python, unless the environment names another: a wheel's tools draw with the Python that they stand in.
std::string python()
{
    const char *named = std::getenv("SDRE_PYTHON");
    return named ? named : SDRE_PYTHON;
}

std::string drawn(const char *script, const std::string &csv, const std::string &title,
                  const std::filesystem::path &picture, const std::string &marks = {})
{
    const Workplace             work;
    const std::filesystem::path data = work / "data.csv";
    const std::filesystem::path out  = work / ("picture" + picture.extension().string());
    std::vector<std::string>    arguments{
        python(), data_file(std::string("host_tools/python/sdre_plot/") + script).string(),
        data.string(), title, out.string()};
    write_files({{data, csv}});
    if (!marks.empty()) {
        arguments.push_back((work / "marks.json").string());
        write_files({{arguments.back(), marks}});
    }
    if (run_program(arguments) != 0) {
        throw InputError(fmt::format("{}: cannot draw", picture.string()));
    }
    return read_text_file(out);
}

/// The marks of a trace for draw_trace.py.
Json marks_of(const Scenario &scenario, const Trace &trace)
{
    Json       measures = Json::array();
    const auto windows  = windows_of(scenario, trace);
    const auto metrics  = measure(scenario, trace);
    for (std::size_t i = 0; i < windows.size(); i++) {
        Json one{{"name", metrics[i].name},
                 {"time_s", metrics[i].time_s},
                 {"end_s", (windows[i].end - 1)->time_s},
                 {"dip_e_radps", metrics[i].dip_e_radps}};
        if (metrics[i].settling_time_s) {
            one["settling_time_s"] = *metrics[i].settling_time_s;
        }
        measures.push_back(one);
    }
    return Json{{"pole_pairs", scenario.drive.motor.pole_pairs}, {"measures", measures}};
}

/// The drawn columns of all runs, one below the other.
std::string comparison_traces(const std::vector<Trace> &traces)
{
    std::string s = "run,time_s,omega_ref_e_radps,omega_e_radps,iq_A,vq_V\n";
    for (std::size_t run = 0; run < traces.size(); run++) {
        for (const TraceRow &row : traces[run]) {
            fmt::format_to(std::back_inserter(s), "{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", run,
                           row.time_s, row.omega_ref_e_radps, row.omega_e_radps, row.iq_A,
                           row.vq_V);
        }
    }
    return s;
}

/// Whether the Python that draws has what it draws with.
bool has_matplotlib()
{
    return run_program({python(), "-c",
                        "import importlib.util, sys; "
                        "sys.exit(importlib.util.find_spec('matplotlib') is None)"}) == 0;
}

} // namespace

void require_plot(const std::filesystem::path &picture)
{
    const std::string kind = picture.extension().string();
    if (kind != ".png" && kind != ".svg") {
        throw InputError(fmt::format("{}: a plot is a .png or a .svg", picture.string()));
    }
    if (python().empty()) {
        throw InputError("--plot: this build found no Python with matplotlib; name one in the "
                         "environment, as SDRE_PYTHON");
    }
    if (!has_matplotlib()) {
        throw InputError(fmt::format("--plot: {} has no matplotlib; install it there, or name "
                                     "another Python in the environment, as SDRE_PYTHON",
                                     python()));
    }
}

std::string trace_marks(const Scenario &scenario, const Trace &trace)
{
    return marks_of(scenario, trace).text();
}

std::string trace_picture(const Scenario &scenario, const Trace &trace, const std::string &title,
                          const std::filesystem::path &picture)
{
    return drawn("draw_trace.py", trace_csv(trace), title, picture, trace_marks(scenario, trace));
}

std::string spectrum_picture(const std::string &csv, const std::string &title,
                             const std::filesystem::path &picture)
{
    return drawn("draw_spectrum.py", csv, title, picture);
}

std::string comparison_picture(const Comparison &comparison, const std::string &title,
                               const std::filesystem::path &picture)
{
    Json marks = Json::array();
    for (std::size_t i = 0; i < comparison.runs.size(); i++) {
        Json one        = marks_of(comparison.as_run[i], comparison.traces[i]);
        one["scenario"] = comparison.runs[i].scenario;
        one["drive"]    = comparison.runs[i].column;
        marks.push_back(one);
    }
    return drawn("draw_compare.py", comparison_traces(comparison.traces), title, picture,
                 marks.text());
}

} // namespace sdre
