// SPDX-License-Identifier: MIT
/// sdre-sil: the control core in closed loop with a simulated motor.
#include <cstdio>
#include <exception>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "common/version.hpp"
#include "sil/board/board_run.hpp"
#include "sil/eval/bench.hpp"
#include "sil/eval/compare.hpp"
#include "sil/eval/plot.hpp"
#include "sil/eval/random_motors.hpp"
#include "sil/eval/results.hpp"
#include "sil/eval/seeds.hpp"
#include "sil/eval/spectrum.hpp"

namespace {

enum ExitCode { exit_ok = 0, exit_bad_input = 1, exit_design_failed = 2, exit_fault = 4 };

struct Options {
    std::string scenario;
    std::string drive;
    std::string csv;
    std::string json;
    std::string plot;
    std::string spectrum;
    std::string board;
    int         seed   = 0;
    int         seeds  = 0;
    int         motors = 1000;
    std::string failures;
    std::string markdown;
};

/// A spectrum is a table or a picture, as its name says.
bool is_table(const std::string &spectrum)
{
    return std::filesystem::path(spectrum).extension() == ".csv";
}

void require_outputs(const Options &options)
{
    if (!options.plot.empty()) {
        sdre::require_plot(options.plot);
    }
    if (!options.spectrum.empty() && !is_table(options.spectrum)) {
        sdre::require_plot(options.spectrum);
    }
}

/// The files that were asked for; `json` is already text.
void write_outputs(const Options &options, const sdre::Scenario &scenario,
                   const std::vector<sdre::TraceRow> &trace, const std::string &json)
{
    const std::string title =
        options.drive.empty() ? scenario.name : scenario.name + ", " + scenario.drive.name;
    const std::string spectrum =
        options.spectrum.empty() ? "" : sdre::spectrum_csv(scenario, trace);
    std::vector<sdre::OutputFile> files;
    if (!options.csv.empty()) {
        files.push_back({options.csv, sdre::trace_csv(trace)});
    }
    if (!options.json.empty()) {
        files.push_back({options.json, json});
    }
    if (is_table(options.spectrum)) {
        files.push_back({options.spectrum, spectrum});
    }
    sdre::write_files(files);
    if (!options.plot.empty()) {
        sdre::plot_trace(sdre::trace_csv(trace), title, options.plot);
    }
    if (!options.spectrum.empty() && !is_table(options.spectrum)) {
        sdre::plot_spectrum(spectrum, title, options.spectrum);
    }
}

int run_many_seeds(const sdre::Scenario &scenario, const Options &options)
{
    const sdre::SeedRuns runs = sdre::run_seeds(scenario, options.seeds);
    write_outputs(options, scenario, runs.first.trace, sdre::seeds_json(scenario, runs));
    fmt::print("{}", sdre::seeds_text(scenario, runs));
    return runs.faults == 0 ? exit_ok : exit_fault;
}

/// What a run on a board has to say beside its metrics.
std::string board_text(const Options &options, const sdre::BoardResult &run)
{
    std::string s = fmt::format("board: {}\n", options.board);
    for (const std::string &note : run.notes) {
        s += fmt::format("note: {}\n", note);
    }
    for (const std::string &finding : run.findings) {
        s += fmt::format("device: {}\n", finding);
    }
    return s;
}

int run_on_board(const sdre::Scenario &scenario, const Options &options)
{
    const auto kind = options.board == "api" ? sdre::BoardKind::api : sdre::BoardKind::f28335;
    const sdre::BoardResult          run     = sdre::simulate_on_board(scenario, kind);
    const std::vector<sdre::Metrics> metrics = sdre::measure(scenario, run.result.trace);
    write_outputs(options, scenario, run.result.trace,
                  sdre::result_json(scenario, run.result, metrics));
    fmt::print("{}{}", board_text(options, run), sdre::result_text(scenario, run.result, metrics));
    return run.result.fault == 0 && run.findings.empty() ? exit_ok : exit_fault;
}

int run_scenario(const Options &options)
{
    require_outputs(options);
    sdre::Scenario scenario = sdre::read_scenario_file(options.scenario, options.drive);
    if (options.seeds > 0) {
        return run_many_seeds(scenario, options);
    }
    if (options.seed > 0) {
        scenario.seed = static_cast<std::uint64_t>(options.seed);
    }
    if (!options.board.empty()) {
        return run_on_board(scenario, options);
    }
    const sdre::SimulationResult     result  = sdre::simulate(scenario);
    const std::vector<sdre::Metrics> metrics = sdre::measure(scenario, result.trace);
    write_outputs(options, scenario, result.trace, sdre::result_json(scenario, result, metrics));
    fmt::print("{}", sdre::result_text(scenario, result, metrics));
    return result.fault == 0 ? exit_ok : exit_fault;
}

int run_compare(const sdre::CompareRequest &request, const Options &options)
{
    const sdre::Comparison        comparison = sdre::compare(request);
    std::vector<sdre::OutputFile> files;
    if (!options.csv.empty()) {
        files.push_back({options.csv, sdre::compare_csv(comparison)});
    }
    if (!options.json.empty()) {
        files.push_back({options.json, sdre::compare_json(comparison)});
    }
    if (!options.markdown.empty()) {
        files.push_back({options.markdown, sdre::compare_markdown(comparison)});
    }
    sdre::write_files(files);
    fmt::print("{}", sdre::compare_markdown(comparison));
    for (const sdre::CompareRun &r : comparison.runs) {
        if (r.faulted > 0) {
            return exit_fault;
        }
    }
    return exit_ok;
}

int run_motors(const Options &options)
{
    const sdre::Scenario     scenario = sdre::read_scenario_file(options.scenario, options.drive);
    const sdre::RandomMotors runs     = sdre::run_random_motors(scenario, options.motors);
    if (!options.failures.empty()) {
        sdre::write_failed_motors(options.scenario, options.drive, runs, options.failures);
    }
    fmt::print("{}", sdre::random_motors_text(scenario, runs));
    return exit_ok;
}

int run(int argc, char **argv)
{
    Options  options;
    CLI::App app{"Closed-loop simulation of the sdre-drive control core."};
    app.require_subcommand(1);
    app.set_version_flag("--version", fmt::format("sdre-sil {}", sdre::tool_version));

    CLI::App *run_command = app.add_subcommand(
        "run", "run one scenario and print its metrics; exit code 4 when the drive faults");
    run_command->add_option("SCENARIO", options.scenario, "scenario file (TOML)")->required();
    run_command->add_option("--drive", options.drive, "drive file instead of the scenario's");
    run_command->add_option("--csv", options.csv, "write the trace, one row per control period");
    run_command->add_option("--json", options.json, "write the metrics");
    run_command->add_option("--plot", options.plot, "draw the trace (.png or .svg)");
    run_command->add_option("--spectrum", options.spectrum,
                            "write (.csv) or draw (.png, .svg) the speed error's spectrum in the "
                            "steady part of every measure");
    CLI::Option *seed = run_command->add_option("--seed", options.seed, "seed of the noise")
                            ->check(CLI::Range(1, 2147483647));
    run_command
        ->add_option("--seeds", options.seeds,
                     "run seeds 1 .. N and report worst and mean; CSV and plot are of seed 1")
        ->check(CLI::Range(1, 100000))
        ->excludes(seed);
    run_command
        ->add_option("--board", options.board,
                     "run the application too: api (on board.h) or f28335 (with the drivers, on a "
                     "virtual device)")
        ->check(CLI::IsMember({"api", "f28335"}))
        ->excludes("--seeds");

    sdre::CompareRequest request;
    CLI::App            *compare_command = app.add_subcommand(
                   "compare", "run several drives on the same scenarios and print one table; exit code 4 when "
                                         "one faults");
    compare_command->add_option("SCENARIO", request.scenarios, "scenario files (TOML)")->required();
    compare_command
        ->add_option("--drive", request.drives,
                     "a column of its own; again for more (default: the scenario's)")
        ->allow_extra_args(false);
    compare_command
        ->add_option("--order", request.orders,
                     "order of both series, a column of its own; again for more")
        ->allow_extra_args(false)
        ->check(CLI::Range(0, 8));
    compare_command
        ->add_option("--metric", request.metrics, "a metric by its JSON name; again for more")
        ->allow_extra_args(false);
    compare_command->add_option("--seeds", request.seeds, "worst of the seeds 1 .. N (default 1)")
        ->check(CLI::Range(1, 100000));
    compare_command->add_option("--csv", options.csv, "write the values, one row each");
    compare_command->add_option("--json", options.json, "write the values");
    compare_command->add_option("--markdown", options.markdown, "write the printed table");

    CLI::App *motors_command = app.add_subcommand(
        "motors", "run one scenario with random motors that the controller does not know");
    motors_command
        ->add_option("SCENARIO", options.scenario, "scenario file with a [motor_ranges] table")
        ->required();
    motors_command->add_option("--drive", options.drive, "drive file instead of the scenario's");
    motors_command->add_option("--count", options.motors, "number of motors (default 1000)")
        ->check(CLI::Range(1, 1000000));
    motors_command->add_option("--failures", options.failures,
                               "write every failed motor as a scenario into this directory");

    CLI::App *bench_command = app.add_subcommand("bench", "print the speed of the simulation");
    bench_command->add_option("SCENARIO", options.scenario, "scenario file (default: Fig. 5)");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &e) {
        if (e.get_exit_code() == 0) {
            return app.exit(e); // --help, --version
        }
        throw sdre::InputError(e.what());
    }
    if (compare_command->parsed()) {
        return run_compare(request, options);
    }
    if (bench_command->parsed()) {
        fmt::print("{}", sdre::bench_text(options.scenario.empty()
                                              ? sdre::default_bench_scenario()
                                              : std::filesystem::path(options.scenario)));
        return exit_ok;
    }
    return motors_command->parsed() ? run_motors(options) : run_scenario(options);
}

} // namespace

int main(int argc, char **argv)
{
    try {
        return run(argc, argv);
    } catch (const sdre::DesignError &e) {
        fmt::print(stderr, "sdre-sil: {}\n", e.what());
        return exit_design_failed;
    } catch (const std::exception &e) {
        fmt::print(stderr, "sdre-sil: {}\n", e.what());
        return exit_bad_input;
    }
}
