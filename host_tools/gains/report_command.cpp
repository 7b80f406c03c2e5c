// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "design/design.hpp"
#include "emit/report.hpp"
#include "gains/commands.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    bool        json = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.flag("--json", o.json, "one JSON object");
}

int run(const Options &o)
{
    const Design design = design_drive(read_drive_file(o.drive));
    fmt::print("{}", o.json ? report_json(design) : report_text(design));
    return design.certificate.passed() ? exit_ok : exit_design_failed;
}

} // namespace

Command report_command()
{
    return command<Options>(
        "report", "print gains, poles and the certificate; exit code 2 when that is refused",
        declare, run);
}

} // namespace sdre
