// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "design/design.hpp"
#include "emit/describe.hpp"
#include "gains/commands.hpp"
#include "tune/prediction.hpp"

namespace sdre {
namespace {

struct Options {
    std::string drive;
    std::string out;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.text("--out", o.out, "page to write (Markdown)");
}

int run(const Options &o)
{
    if (o.out.empty()) {
        throw InputError("describe: give --out FILE");
    }
    const Design design = design_drive(read_drive_file(o.drive));
    write_files({{o.out, description(design, predicted(design.drive))}});
    fmt::print("{}: {} written\n", design.drive.name, o.out);
    return design.certificate.passed() ? exit_ok : exit_design_failed;
}

} // namespace

Command describe_command()
{
    return command<Options>("describe",
                            "write a page about a drive: what it is, can do and trips at; exit "
                            "code 2 when its certificate is refused",
                            declare, run, "sdre-gains describe my_motor.toml --out my_motor.md");
}

} // namespace sdre
