// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/file_output.hpp"
#include "sil/commands/commands.hpp"
#include "sil/eval/random_motors.hpp"

namespace sdre {
namespace {

struct Options {
    std::string scenario;
    std::string drive;
    std::string csv;
    std::string json;
    std::string failures;
    int         count = 1000;
};

void declare(OptionList &list, Options &o)
{
    list.required("SCENARIO", o.scenario, "scenario file with a [motor_ranges] table");
    list.text("--drive", o.drive, "drive file instead of the scenario's");
    list.number("--count", o.count, {1, 1000000}, "number of motors (default 1000)");
    list.text("--csv", o.csv, "write every motor and whether it failed, one row each");
    list.text("--json", o.json, "write the share and every failed motor");
    list.text("--failures", o.failures,
              "write every failed motor as a scenario into this directory");
}

int run(const Options &o)
{
    const Scenario          scenario = read_scenario_file(o.scenario, o.drive);
    const RandomMotors      runs     = run_random_motors(scenario, o.count);
    std::vector<OutputFile> files;
    if (!o.failures.empty()) {
        files = failed_motor_files(o.scenario, o.drive, runs, o.failures);
    }
    if (!o.csv.empty()) {
        files.push_back({o.csv, random_motors_csv(runs)});
    }
    if (!o.json.empty()) {
        files.push_back({o.json, random_motors_json(scenario, runs)});
    }
    write_files(files);
    fmt::print("{}", random_motors_text(scenario, runs));
    return runs.failures.empty() ? exit_ok : exit_fault;
}

} // namespace

Command motors_command()
{
    return command<Options>("motors",
                            "run one scenario with random motors that the controller does not "
                            "know; exit code 4 when one of them fails",
                            declare, run, "sdre-sil motors random_motors.toml --csv motors.csv");
}

} // namespace sdre
