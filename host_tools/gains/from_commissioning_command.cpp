// SPDX-License-Identifier: MIT
#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "drive/drive_file.hpp"
#include "facts/commissioned_text.hpp"
#include "facts/found_file.hpp"
#include "gains/commands.hpp"

namespace sdre {
namespace {

struct Options {
    std::string found;
    std::string drive;
    std::string out;
};

void declare(OptionList &list, Options &o)
{
    list.required("FOUND", o.found, "what `sdre-drive commission` wrote (TOML)");
    list.text("--drive", o.drive, "drive file (TOML) with inverter, sensors, board and ratings");
    list.text("--out", o.out, "drive file to write");
}

int run(const Options &o)
{
    if (o.drive.empty() || o.out.empty()) {
        throw InputError("from-commissioning: give --drive DRIVE and --out FILE");
    }
    const Found       found  = read_found_file(o.found);
    const Drive       before = read_drive_file(o.drive);
    const std::string text =
        commissioned_text(read_text_file(o.drive), found, before.motor.max_current_A,
                          std::filesystem::path(o.found).filename().string());
    (void)read_drive_text(text, o.out);
    write_files({{o.out, text}});
    if (const std::string words = iron_words(found, before.motor.max_current_A); !words.empty()) {
        fmt::print("{}\n", words);
    }
    fmt::print("{}: written; weights for it: sdre-gains tune {}\n", o.out, o.out);
    return exit_ok;
}

} // namespace

Command from_commissioning_command()
{
    return command<Options>(
        "from-commissioning",
        "a drive file with the motor values that a drive's commissioning found", declare, run,
        "sdre-gains from-commissioning found.toml --drive my_motor.toml --out true_motor.toml");
}

} // namespace sdre
