// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "sil/commands/commands.hpp"
#include "sil/eval/compare.hpp"
#include "sil/eval/plot.hpp"

namespace sdre {
namespace {

struct Options {
    std::vector<std::string> scenarios;
    std::vector<std::string> drives;
    std::vector<int>         orders;
    std::vector<std::string> metrics;
    int                      seeds       = 1;
    bool                     equal_noise = false;
    int                      noise_V     = 0; ///< 0: that of the first drive
    std::string              csv;
    std::string              json;
    std::string              markdown;
    std::string              plot;
};

void declare(OptionList &list, Options &o)
{
    list.required("SCENARIO", o.scenarios, "scenario files (TOML)");
    list.repeated("--drive", o.drives,
                  "a column of its own; again for more (default: the scenario's)");
    list.repeated("--order", o.orders, {0, 8},
                  "order of both series, a column of its own; again for more");
    list.repeated("--metric", o.metrics, "a metric by its JSON name; again for more");
    list.number("--seeds", o.seeds, {1, 100000}, "worst of the seeds 1 .. N (default 1)");
    list.flag("--equal-noise", o.equal_noise,
              "turn each drive's bandwidth until v_q is as noisy as the first drive's in the first "
              "scenario's last measure, mean of the seeds");
    list.number("--noise", o.noise_V, {1, 10000}, "with --equal-noise: this many V rms instead");
    list.text("--csv", o.csv, "write the values, one row each");
    list.text("--json", o.json, "write the values");
    list.text("--markdown", o.markdown, "write the printed table");
    list.text("--plot", o.plot,
              "draw speed, i_q and v_q of seed 1 over time, a line for each drive (.png or .svg)");
}

std::vector<OutputFile> files_of(const Options &o, const Comparison &comparison)
{
    std::vector<OutputFile> files;
    if (!o.plot.empty()) {
        files.push_back(
            {o.plot, comparison_picture(comparison, "compared drives, seed 1", o.plot)});
    }
    if (!o.csv.empty()) {
        files.push_back({o.csv, compare_csv(comparison)});
    }
    if (!o.json.empty()) {
        files.push_back({o.json, compare_json(comparison)});
    }
    if (!o.markdown.empty()) {
        files.push_back({o.markdown, compare_markdown(comparison)});
    }
    return files;
}

int run(const Options &o)
{
    if (o.noise_V > 0 && !o.equal_noise) {
        throw InputError("--noise: needs --equal-noise");
    }
    if (!o.plot.empty()) {
        require_plot(o.plot);
    }
    CompareRequest request{{o.scenarios.begin(), o.scenarios.end()},
                           {o.drives.begin(), o.drives.end()},
                           o.orders,
                           o.metrics,
                           o.seeds,
                           o.equal_noise,
                           {}};
    if (o.noise_V > 0) {
        request.noise_V = o.noise_V;
    }
    const Comparison comparison = compare(request);
    write_files(files_of(o, comparison));
    fmt::print("{}", compare_markdown(comparison));
    const bool faulted = std::any_of(comparison.runs.begin(), comparison.runs.end(),
                                     [](const CompareRun &r) { return r.faulted > 0; });
    return faulted ? exit_fault : comparison.missed.empty() ? exit_ok : exit_design_failed;
}

} // namespace

Command compare_command()
{
    return command<Options>(
        "compare",
        "run several drives on the same scenarios and print one table; exit "
        "code 4 when one faults",
        declare, run,
        "sdre-sil compare load_step.toml --drive my_motor.toml --drive other.toml --seeds 5");
}

} // namespace sdre
