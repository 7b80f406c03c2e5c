// SPDX-License-Identifier: MIT
#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "sil/board/board_run.hpp"
#include "sil/commands/commands.hpp"
#include "sil/commands/image_program.hpp"
#include "sil/eval/plot.hpp"
#include "sil/eval/results.hpp"
#include "sil/eval/seeds.hpp"
#include "sil/eval/spectrum.hpp"

namespace sdre {
namespace {

struct Options {
    std::string scenario;
    std::string drive;
    std::string csv;
    std::string json;
    std::string plot;
    std::string spectrum;
    int         seed  = 0; ///< 0: the scenario's
    int         seeds = 0; ///< 0: one run
    BoardOption board;
};

void declare(OptionList &list, Options &o)
{
    list.required("SCENARIO", o.scenario, "scenario file (TOML)");
    list.text("--drive", o.drive, "drive file instead of the scenario's");
    list.text("--csv", o.csv, "write the trace, one row per control period");
    list.text("--json", o.json, "write the metrics");
    list.text("--plot", o.plot, "draw the trace (.png or .svg)");
    list.text("--spectrum", o.spectrum,
              "write (.csv) or draw (.png, .svg) the speed error's spectrum in the steady part of "
              "every measure");
    list.number("--seed", o.seed, {1, 2147483647}, "seed of the noise");
    list.number("--seeds", o.seeds, {1, 100000},
                "run seeds 1 .. N and report worst and mean; CSV and plot are of seed 1");
    list.exclude("--seeds", "--seed");
    declare_board(
        list, o.board, {"api", "f28335", board_with_image},
        "run the application too: api (on board.h), f28335 (with the drivers, on a "
        "virtual device) or stm32g431 (its image on a simulator, by the program sdre-iss)");
}

/// A spectrum is a table or a picture, depending on its name.
bool is_table(const std::string &spectrum)
{
    return std::filesystem::path(spectrum).extension() == ".csv";
}

void require_outputs(const Options &o)
{
    if (!o.plot.empty()) {
        require_plot(o.plot);
    }
    if (!o.spectrum.empty() && !is_table(o.spectrum)) {
        require_plot(o.spectrum);
    }
}

/// The requested files, all or none; `json` is already text.
void write_outputs(const Options &o, const Scenario &scenario, const Trace &trace,
                   const std::string &json)
{
    const std::string title =
        o.drive.empty() ? scenario.name : scenario.name + ", " + scenario.drive.name;
    std::vector<OutputFile> files;
    if (!o.csv.empty()) {
        files.push_back(trace_file(o.csv, trace));
    }
    if (!o.json.empty()) {
        files.push_back({o.json, json});
    }
    if (!o.plot.empty()) {
        files.push_back({o.plot, trace_picture(scenario, trace, title, o.plot)});
    }
    if (!o.spectrum.empty()) {
        const std::string spectrum = spectrum_csv(scenario, trace);
        files.push_back({o.spectrum, is_table(o.spectrum)
                                         ? spectrum
                                         : spectrum_picture(spectrum, title, o.spectrum)});
    }
    write_files(files);
}

BoardKind kind_of(const Options &o)
{
    return o.board.name == "api" ? BoardKind::api : BoardKind::f28335;
}

/// Output of a run on a board, beside its metrics.
std::string board_text(const Options &o, const BoardResult &run)
{
    std::string s = fmt::format("board: {}\n", o.board.name);
    for (const std::string &note : run.notes) {
        s += fmt::format("note: {}\n", note);
    }
    for (const std::string &finding : run.findings) {
        s += fmt::format("device: {}\n", finding);
    }
    return s;
}

int run_many_seeds(const Options &o, const Scenario &scenario)
{
    // A process has one set of firmware variables: on a board the seeds run one after the other.
    BoardResult    board; // of seed 1, with the findings of all
    const SeedRuns runs =
        o.board.name.empty()
            ? run_seeds(scenario, o.seeds)
            : run_seeds_in_turn(scenario, o.seeds, [&](const Scenario &s, const Controller &c) {
                  BoardResult one = simulate_on_board(s, kind_of(o), c);
                  if (s.seed == 1) {
                      board.notes = one.notes;
                  }
                  for (const std::string &finding : one.findings) {
                      board.findings.push_back(fmt::format("seed {}: {}", s.seed, finding));
                  }
                  return one.result;
              });
    write_outputs(o, scenario, runs.first.trace, seeds_json(scenario, runs));
    fmt::print("{}{}", o.board.name.empty() ? "" : board_text(o, board),
               seeds_text(scenario, runs));
    return runs.faults == 0 && board.findings.empty() ? exit_ok : exit_fault;
}

int run_once(const Options &o, const Scenario &scenario)
{
    BoardResult run;
    if (o.board.name.empty()) {
        run.result = simulate(scenario);
    } else {
        run = simulate_on_board(scenario, kind_of(o));
    }
    const std::vector<Metrics> metrics = measure(scenario, run.result.trace);
    write_outputs(o, scenario, run.result.trace, result_json(scenario, run.result, metrics));
    fmt::print("{}{}", o.board.name.empty() ? "" : board_text(o, run),
               result_text(scenario, run.result, metrics));
    return run.result.fault == 0 && run.findings.empty() ? exit_ok : exit_fault;
}

int run(const Options &o)
{
    if (o.board.name == board_with_image) {
        run_image_program("run", o.board.others());
    }
    require_no_image(o.board);
    require_outputs(o);
    Scenario scenario = read_scenario_file(o.scenario, o.drive);
    if (o.seeds > 0) {
        return run_many_seeds(o, scenario);
    }
    if (o.seed > 0) {
        scenario.seed = static_cast<std::uint64_t>(o.seed);
    }
    return run_once(o, scenario);
}

} // namespace

Command run_command()
{
    return command<Options>(
        "run", "run one scenario and print its metrics; exit code 4 when the drive faults", declare,
        run, "sdre-sil run load_step.toml --drive my_motor.toml --seeds 20 --plot load_step.png");
}

} // namespace sdre
