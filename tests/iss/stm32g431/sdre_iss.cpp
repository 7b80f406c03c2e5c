// SPDX-License-Identifier: MIT
// sdre-iss: a scenario with the image that is flashed, instruction by instruction. A program of the tests: it links Unicorn,
// which is under the GPL.
#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "sil/commands/commands.hpp"
#include "sil/eval/results.hpp"
#include "stm32g431/cycle_meter.hpp"
#include "stm32g431/image_scenario.hpp"

namespace {

using namespace iss::stm32g431;

struct Options {
    std::string scenario;
    std::string drive;
    std::string image;
    std::string csv;
    std::string json;
    int         seed      = 0; ///< 0: the scenario's
    bool        functions = false;
};

void declare(sdre::OptionList &list, Options &o)
{
    list.required("SCENARIO", o.scenario, "scenario file (TOML)");
    list.text("--drive", o.drive, "drive file instead of the scenario's");
    list.required("--image", o.image, "program (ELF) with the constants of that drive");
    list.text("--csv", o.csv, "write the trace, one row per control period");
    list.text("--json", o.json, "write the metrics");
    list.number("--seed", o.seed, {1, 2147483647}, "seed of the noise");
    list.flag("--functions", o.functions, "print where the control interrupt spends its cycles");
}

int run(const Options &o)
{
    sdre::Scenario scenario = sdre::read_scenario_file(o.scenario, o.drive);
    if (o.seed > 0) {
        scenario.seed = static_cast<std::uint64_t>(o.seed);
    }
    const Program            program = read_program(o.image);
    const ImageResult        done    = simulate_image(scenario, program);
    const sdre::BoardResult &board   = done.board;
    const auto               metrics = sdre::measure(scenario, board.result.trace);

    std::vector<sdre::OutputFile> files;
    if (!o.csv.empty()) {
        files.push_back(sdre::trace_file(o.csv, board.result.trace));
    }
    if (!o.json.empty()) {
        files.push_back({o.json, sdre::result_json(scenario, board.result, metrics)});
    }
    sdre::write_files(files);
    fmt::print("board: stm32g431, the image\n");
    for (const std::string &note : board.notes) {
        fmt::print("note: {}\n", note);
    }
    for (const std::string &finding : board.findings) {
        fmt::print("device: {}\n", finding);
    }
    fmt::print("{}\n{}", sdre::result_text(scenario, board.result, metrics), cycles_text(done));
    for (const auto &[cycles, name] : done.functions) {
        if (o.functions && cycles >= 1.0) {
            fmt::print("{:8.0f}  {}\n", cycles, name);
        }
    }
    return board.result.fault == 0 && board.findings.empty() ? sdre::exit_ok : sdre::exit_fault;
}

} // namespace

int main(int argc, char **argv)
{
    return sdre::run_tool(
        {"sdre-iss",
         "The image of the B-G431B-ESC1 with a simulated motor.",
         {sdre::command<Options>(
             "run", "run one scenario and print its metrics; exit code 4 when the drive faults",
             declare, run, "sdre-iss run speed_step.toml --image sdre_stm32g431.elf")}},
        argc, argv);
}
