// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/file_output.hpp"
#include "design/design.hpp"
#include "emit/report.hpp"
#include "emit/report_loops.hpp"
#include "gains/commands.hpp"
#include "tune/prediction.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string loops;
    bool        json = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.flag("--json", o.json, "one JSON object");
    list.text(
        "--loops", o.loops,
        "write the matrices of the sampled loop over speed and current (law noc, encoder form)");
}

int run(const Options &o)
{
    const Design design = design_drive(read_drive_file(o.drive));
    if (!o.loops.empty()) {
        write_files({{o.loops, loops_json(design)}});
    }
    const auto prediction = predicted(design.drive);
    fmt::print("{}", o.json ? report_json(design, prediction) : report_text(design, prediction));
    return design.certificate.passed() ? exit_ok : exit_design_failed;
}

} // namespace

Command report_command()
{
    return command<Options>(
        "report", "print gains, poles and the certificate; exit code 2 when that is refused",
        declare, run, "sdre-gains report my_motor.toml");
}

} // namespace sdre
