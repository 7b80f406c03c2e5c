// SPDX-License-Identifier: MIT
#include <cstdio>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/board/identity.hpp"
#include "design/certificate.hpp"
#include "design/design.hpp"
#include "drive/pwm_frequency.hpp"
#include "emit/emit_tables.hpp"
#include "gains/commands.hpp"

namespace sdre {
namespace {

constexpr int exit_check_mismatch = 3;

struct Options {
    std::string drive;
    std::string out;
    std::string check;
    bool        uncertified = false;
};

void declare(OptionList &list, Options &o)
{
    list.required("DRIVE", o.drive, "drive file (TOML)");
    list.text("--out", o.out, "directory to write to");
    list.text("--check", o.check, "directory to compare with; exit code 3 on a mismatch");
    list.flag("--uncertified", o.uncertified,
              "write even what is not certified, with the reasons in the file");
}

int run(const Options &o)
{
    if (o.out.empty() == o.check.empty()) {
        throw InputError("generate: give either --out DIR or --check DIR");
    }
    const Drive drive = read_drive_file(o.drive);
    require_board(drive, o.drive);
    const Design design    = design_drive(drive, Precision::extended);
    const bool   certified = design.certificate.passed();
    if (!certified && !o.uncertified) {
        throw DesignError(fmt::format("{}: {}: {}; --uncertified writes it all the same", o.drive,
                                      verdict_words(design),
                                      fmt::join(design.certificate.failures, "; ")));
    }
    const TableText text = table_text(design);
    fmt::print("{}{}", pwm_note(design.drive.inverter), cycles_note(design.drive));
    if (!o.out.empty()) {
        write_tables(text, o.out);
        fmt::print("{}: {}; wrote gain_tables.h, gain_tables.c and board_config.c to {}\n",
                   design.drive.name, verdict_words(design), o.out);
        return exit_ok;
    }
    const std::string difference = compare_tables(text, o.check);
    if (!difference.empty()) {
        fmt::print(stderr, "sdre-gains: {}\n", difference);
        return exit_check_mismatch;
    }
    fmt::print("{}: {}; {} matches\n", design.drive.name, verdict_words(design), o.check);
    return exit_ok;
}

} // namespace

Command generate_command()
{
    return command<Options>(
        "generate",
        "write gain_tables.h and .c and board_config.c, or compare them with the drive file",
        declare, run, "sdre-gains generate my_motor.toml --out tables");
}

} // namespace sdre
