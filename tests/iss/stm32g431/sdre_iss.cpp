// SPDX-License-Identifier: MIT
// sdre-iss: the image that is flashed, instruction by instruction, with a simulated motor. A program of the tests: it links
// Unicorn, which is under the GPL.
#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/data_files.hpp"
#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "sil/commands/commands.hpp"
#include "sil/eval/plot.hpp"
#include "sil/eval/results.hpp"
#include "sil/serve/serve_arguments.hpp"
#include "stm32g431/cycle_meter.hpp"
#include "stm32g431/image_scenario.hpp"
#include "stm32g431/served_image.hpp"

namespace {

using namespace iss::stm32g431;

constexpr const char *shipped = "m2310p_24v";

void declare_image(sdre::OptionList &list, std::string &image)
{
    list.text("--image", image,
              "program (ELF) with the constants of the drive (default: as the preset "
              "stm32g431-release builds it)");
}

/// The named image, or the one beside the build tree of this program.
Program program_of(const std::string &named)
{
    const std::filesystem::path file =
        named.empty() ? (sdre::program_directory() / "../../stm32g431/bin/sdre_stm32g431.elf")
                            .lexically_normal()
                      : std::filesystem::path(named);
    if (!std::filesystem::exists(file)) {
        throw sdre::InputError(fmt::format(
            "--image: there is no {}; \"cmake --preset stm32g431-release && cmake --build --preset "
            "stm32g431-release\" builds build/stm32g431/bin/sdre_stm32g431.elf",
            file.string()));
    }
    return read_program(file);
}

struct RunOptions {
    std::string scenario;
    std::string drive;
    std::string image;
    std::string csv;
    std::string json;
    std::string plot;
    int         seed      = 0; ///< 0: the scenario's
    bool        functions = false;
};

void declare_run(sdre::OptionList &list, RunOptions &o)
{
    list.required("SCENARIO", o.scenario, "scenario file (TOML)");
    list.text("--drive", o.drive, "drive file instead of the scenario's");
    declare_image(list, o.image);
    list.text("--csv", o.csv, "write the trace, one row per control period");
    list.text("--json", o.json, "write the metrics");
    list.text("--plot", o.plot, "draw the trace (.png or .svg)");
    list.number("--seed", o.seed, {1, 2147483647}, "seed of the noise");
    list.flag("--functions", o.functions, "print where the control interrupt spends its cycles");
}

int run(const RunOptions &o)
{
    if (!o.plot.empty()) {
        sdre::require_plot(o.plot);
    }
    sdre::Scenario scenario = sdre::read_scenario_file(o.scenario, o.drive);
    if (o.seed > 0) {
        scenario.seed = static_cast<std::uint64_t>(o.seed);
    }
    const Program            program = program_of(o.image);
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
    if (!o.plot.empty()) {
        files.push_back(
            {o.plot, sdre::trace_picture(scenario, board.result.trace, scenario.name, o.plot)});
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

struct ServeOptions {
    sdre::ServeArguments common;
    std::string          image;
};

void declare_serve(sdre::OptionList &list, ServeOptions &o)
{
    sdre::declare_serve(list, o.common, shipped);
    declare_image(list, o.image);
}

int serve(const ServeOptions &o)
{
    const sdre::ServeOptions s       = sdre::serve_options(o.common);
    const sdre::Drive        drive   = sdre::served_drive(o.common, shipped);
    const sdre::Drive        machine = s.machine.value_or(drive);
    const Program            program = program_of(o.image);
    sdre::Server             server(
                    std::make_unique<ServedImage>(drive, sdre::Machine{machine, s.cogging_share},
                                      static_cast<std::uint64_t>(o.common.seed), program),
                    s);
    sdre::serve(server, machine);
    return sdre::exit_ok;
}

} // namespace

int main(int argc, char **argv)
{
    return sdre::run_tool(
        {"sdre-iss",
         "The image of the B-G431B-ESC1 with a simulated motor.",
         {sdre::command<RunOptions>(
              "run", "run one scenario and print its metrics; exit code 4 when the drive faults",
              declare_run, run, "sdre-iss run speed_step.toml --image sdre_stm32g431.elf"),
          sdre::command<ServeOptions>(
              "serve", "a drive to connect to: the image and a motor, in real time if it can",
              declare_serve, serve, "sdre-iss serve --tcp 1502")}},
        argc, argv);
}
