// SPDX-License-Identifier: MIT
/// sdre-sil: the control core in closed loop with a simulated motor.
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "errors.hpp"
#include "file_output.hpp"
#include "plot.hpp"
#include "results.hpp"
#include "version.hpp"

namespace {

enum ExitCode { exit_ok = 0, exit_bad_input = 1, exit_design_failed = 2, exit_fault = 4 };

struct Options {
    std::string scenario;
    std::string csv;
    std::string json;
    std::string plot;
};

int run_scenario(const Options &options)
{
    const sdre::Scenario             scenario = sdre::read_scenario_file(options.scenario);
    const sdre::SimulationResult     result   = sdre::simulate(scenario);
    const std::vector<sdre::Metrics> metrics  = sdre::measure(scenario, result.trace);

    std::vector<sdre::OutputFile> files;
    if (!options.csv.empty()) {
        files.push_back({options.csv, sdre::trace_csv(result.trace)});
    }
    if (!options.json.empty()) {
        files.push_back({options.json, sdre::result_json(scenario, result, metrics)});
    }
    sdre::write_files(files);
    if (!options.plot.empty()) {
        sdre::plot_trace(sdre::trace_csv(result.trace), scenario.name, options.plot);
    }
    fmt::print("{}", sdre::result_text(scenario, result, metrics));
    return result.fault == 0 ? exit_ok : exit_fault;
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
    run_command->add_option("--csv", options.csv, "write the trace, one row per control period");
    run_command->add_option("--json", options.json, "write the metrics");
    run_command->add_option("--plot", options.plot, "draw the trace (.png or .svg)");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &e) {
        if (e.get_exit_code() == 0) {
            return app.exit(e); // --help, --version
        }
        throw sdre::InputError(e.what());
    }
    return run_scenario(options);
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
