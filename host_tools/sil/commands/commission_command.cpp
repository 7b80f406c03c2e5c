// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/file_output.hpp"
#include "drive/drive_file.hpp"
#include "facts/commissioned_text.hpp"
#include "sil/commands/commands.hpp"
#include "sil/commission/board_bench.hpp"
#include "sil/commission/faults.hpp"
#include "sil/commission/report.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string out;
    std::string json;
    std::string csv;
    std::string board;
    int         seed          = 1;
    int         coulomb       = 10;
    int         cogging       = 0;
    int         bound         = 100;
    int         faults        = 0;
    bool        unknown_lines = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML): the motor that is simulated");
    list.text("--out", o.out, "drive file with the values that were found");
    list.text("--json", o.json, "write the table");
    list.text("--csv", o.csv, "write currents, speed and angle over the time");
    list.choice(
        "--board", o.board, {"api", "f28335"},
        "with the application: on board.h, or with drivers and Modbus on the virtual device");
    list.number("--seed", o.seed, {1, 1e9}, "of noise, disc and rotor angle (default 1)");
    list.number(
        "--coulomb", o.coulomb, {0, 200},
        "dry friction of the simulated shaft, thousandths of the rated torque (default 10)");
    list.number("--cogging", o.cogging, {0, 200},
                "amplitude of its cogging, thousandths of the rated torque (default 0)");
    list.number("--bound", o.bound, {5, 100},
                "current that the drive may use, hundredths of its limit (default 100)");
    list.number("--faults", o.faults, {1, 8},
                "instead: faults of sensors, motor wires and encoder, at N times of each stage; "
                "prints the largest true currents");
    for (const char *other : {"--board", "--out", "--json", "--csv"}) {
        list.exclude("--faults", other);
    }
    list.flag("--unknown-lines", o.unknown_lines, "count the encoder's lines with its index");
}

int run_faults(const Drive &d, const CommissionOptions &c, int times)
{
    const auto cases = commission_with_faults(d, c, commission_faults(d), times);
    fmt::print("{}: commissioning with faults, bound {:g} A, {} runs\n{}", d.name,
               c.current_share * d.motor.max_current_A, cases.size(),
               commission_fault_table(cases));
    for (int stage = COMMISSION_WATCH; stage <= COMMISSION_RING; stage++) {
        if (const CommissionCase *worst = worst_case(cases, stage)) {
            fmt::print("  largest: {}\n", case_text(*worst));
        }
    }
    return exit_ok;
}

int run(const Options &o)
{
    const Drive       truth = read_drive_file(o.drive);
    CommissionOptions c;
    c.seed          = static_cast<std::uint64_t>(o.seed);
    c.coulomb_share = 1e-3 * o.coulomb;
    c.cogging_share = 1e-3 * o.cogging;
    c.current_share = 1e-2 * o.bound;
    c.lines_known   = !o.unknown_lines;
    c.trace_every   = o.csv.empty() ? 0 : 10;
    if (o.faults > 0) {
        return run_faults(truth, c, o.faults);
    }
    const CommissionRun result =
        o.board.empty()
            ? commission(truth, c)
            : commission_on_board(truth, c, o.board == "api" ? BoardKind::api : BoardKind::f28335);
    std::vector<OutputFile> files;
    if (!o.json.empty()) {
        files.push_back({o.json, commission_json(truth, result)});
    }
    if (!o.csv.empty()) {
        files.push_back({o.csv, commission_csv(result)});
    }
    if (!o.out.empty() && result.finished()) {
        files.push_back(
            {o.out, commissioned_text(read_text_file(o.drive),
                                      {result.found, found_map(result.map, result.found)},
                                      truth.motor.max_current_A,
                                      fmt::format("simulated, seed {}", o.seed))});
    }
    write_files(files);
    fmt::print("{}", commission_text(truth, result));
    return result.finished() ? exit_ok : exit_fault;
}

} // namespace

Command commission_command()
{
    return command<Options>(
        "commission",
        "let the firmware find the motor of a drive file by itself; exit code 4 "
        "when it cannot",
        declare, run, "sdre-sil commission my_motor.toml --out found.toml");
}

} // namespace sdre
